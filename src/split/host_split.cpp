#include "split/host_split.h"

#include <algorithm>
#include <future>
#include <string>
#include <system_error>
#include <thread>

#include "split/bound_host.h"
#include "tessera/error.h"

namespace tessera {
namespace {

unsigned threadCount(unsigned wanted, std::uint32_t patches) {
    const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
    return std::max(1U, std::min(wanted == 0 ? cores : wanted, std::max(1U, patches)));
}

std::uint32_t halfSide(std::uint32_t side, std::uint32_t which) {
    const std::uint32_t level = (side >> SIDE_LEVEL_SHIFT) + 1;
    return (level << SIDE_LEVEL_SHIFT) | (((side & SIDE_INDEX_MASK) << 1) + which);
}

}  // namespace

void ClassicalRule::step(const Range& range, std::vector<Range>& stack, std::vector<Range>& ready, HostSplitCounts& counts) const {
    const bool gregory = range.patch_index >= frame_.bezier_patches;
    const std::size_t bezier = std::min(range.patch_index, frame_.bezier_patches);
    const std::size_t offset = bezier * BEZIER_FLOATS + (range.patch_index - bezier) * GREGORY_FLOATS;
    const int action = boundOnHost(frame_, eyePoints_.data() + offset, gregory ? GREGORY_POINTS : BEZIER_POINTS, range);
    if (action == ACTION_CULL) {
        ++counts.culled;
    } else if (action == ACTION_DICE) {
        ++counts.diced;
        ready.push_back(range);
    } else {
        // The second half waits below the first: ranges come out in the order of the parameter.
        for (const std::uint32_t which : {1U, 0U}) {
            range_t child = range;
            std::uint32_t& side = action == ACTION_SPLIT_U ? child.u_side : child.v_side;
            side = halfSide(side, which);
            stack.push_back(child);
        }
    }
}

void WatertightRule::step(const Range& range, std::vector<Range>& stack, std::vector<Range>& ready, HostSplitCounts& counts) const {
    const QuadStep step = splitOnHost(frame_, patches_, range);
    if (step.action == 0) {
        ++counts.culled;
    } else if (step.action == 1) {
        ++counts.diced;
        counts.micropolygons += std::uint64_t{1} << (((step.diced.sizes >> 16U) & 0xffU) + (step.diced.sizes >> 24U));
        ready.push_back(step.diced);
    } else {
        stack.push_back(step.children[1]);
        stack.push_back(step.children[0]);
    }
}

template <typename Rule>
HostSplit<Rule>::HostSplit(Rule rule, unsigned threads) : rule_(std::move(rule)), workers_(threadCount(threads, rule_.frame().patches)) {
    for (std::size_t k = 0; k < workers_.size(); ++k) workers_[k].nextPatch = static_cast<std::uint32_t>(k);
}

template <typename Rule>
void HostSplit<Rule>::run(Worker& worker, std::size_t limit) const {
    worker.ready.clear();
    const auto stride = static_cast<std::uint32_t>(workers_.size());
    while (worker.ready.size() < limit) {
        if (worker.stack.empty()) {
            if (worker.nextPatch >= rule_.frame().patches) return;
            worker.stack.push_back(rule_.whole(worker.nextPatch));
            worker.nextPatch += stride;
        }
        worker.counts.stackPeak = std::max<std::uint64_t>(worker.counts.stackPeak, worker.stack.size());
        const Range range = worker.stack.back();
        worker.stack.pop_back();
        ++worker.counts.processed;
        rule_.step(range, worker.stack, worker.ready, worker.counts);
    }
}

template <typename Rule>
void HostSplit<Rule>::runAll(std::size_t limit) {
    std::vector<std::future<void>> others;
    try {
        for (std::size_t k = 1; k < workers_.size(); ++k) {
            others.push_back(std::async(std::launch::async, [this, k, limit] { run(workers_[k], limit); }));
        }
        run(workers_[0], limit);
        for (std::future<void>& other : others) other.get();
    } catch (const std::system_error&) {
        throw Error("no " + std::to_string(workers_.size()) + " threads can be had for the cpu method; use fewer --threads");
    }
}

template <typename Rule>
auto HostSplit<Rule>::next(std::size_t limit) -> std::vector<Range> {
    const std::size_t share = std::max<std::size_t>(1, limit / workers_.size());
    runAll(share);
    std::vector<Range> ranges;
    for (const Worker& worker : workers_) ranges.insert(ranges.end(), worker.ready.begin(), worker.ready.end());
    return ranges;
}

template <typename Rule>
HostSplitCounts HostSplit<Rule>::counts() const {
    HostSplitCounts sum;
    for (const Worker& worker : workers_) {
        sum.processed += worker.counts.processed;
        sum.diced += worker.counts.diced;
        sum.culled += worker.counts.culled;
        sum.micropolygons += worker.counts.micropolygons;
        sum.stackPeak = std::max(sum.stackPeak, worker.counts.stackPeak);
    }
    return sum;
}

template <typename Rule>
double HostSplit<Rule>::fractionFed() const {
    const std::uint32_t patches = rule_.frame().patches;
    std::uint64_t fed = 0;
    for (std::size_t k = 0; k < workers_.size(); ++k) fed += (workers_[k].nextPatch - k) / workers_.size();
    return patches == 0 ? 1.0 : static_cast<double>(fed) / patches;
}

template class HostSplit<ClassicalRule>;
template class HostSplit<WatertightRule>;

}  // namespace tessera
