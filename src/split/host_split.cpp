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

HostSplit::HostSplit(const frame_params& frame, std::vector<float> eyePoints, unsigned threads)
    : frame_(frame), eyePoints_(std::move(eyePoints)), workers_(threadCount(threads, frame.patches)) {
    for (std::size_t k = 0; k < workers_.size(); ++k) workers_[k].nextPatch = static_cast<std::uint32_t>(k);
}

void HostSplit::step(Worker& worker, const range_t& range) const {
    const bool gregory = range.patch_index >= frame_.bezier_patches;
    const std::size_t bezier = std::min(range.patch_index, frame_.bezier_patches);
    const std::size_t offset = bezier * 3 * BEZIER_POINTS + (range.patch_index - bezier) * 3 * GREGORY_POINTS;
    const int action = boundOnHost(frame_, eyePoints_.data() + offset, gregory ? GREGORY_POINTS : BEZIER_POINTS, range);
    ++worker.counts.processed;
    if (action == ACTION_CULL) {
        ++worker.counts.culled;
    } else if (action == ACTION_DICE) {
        ++worker.counts.diced;
        worker.ready.push_back(range);
    } else {
        // The second half waits below the first: ranges come out in the order of the parameter.
        for (const std::uint32_t which : {1U, 0U}) {
            range_t child = range;
            std::uint32_t& side = action == ACTION_SPLIT_U ? child.u_side : child.v_side;
            side = halfSide(side, which);
            worker.stack.push_back(child);
        }
    }
}

void HostSplit::run(Worker& worker, std::size_t limit) const {
    worker.ready.clear();
    const auto stride = static_cast<std::uint32_t>(workers_.size());
    while (worker.ready.size() < limit) {
        if (worker.stack.empty()) {
            if (worker.nextPatch >= frame_.patches) return;
            worker.stack.push_back({worker.nextPatch, 0, 0});
            worker.nextPatch += stride;
        }
        worker.counts.stackPeak = std::max<std::uint64_t>(worker.counts.stackPeak, worker.stack.size());
        const range_t range = worker.stack.back();
        worker.stack.pop_back();
        step(worker, range);
    }
}

void HostSplit::runAll(std::size_t limit) {
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

std::vector<range_t> HostSplit::next(std::size_t limit) {
    const std::size_t share = std::max<std::size_t>(1, limit / workers_.size());
    runAll(share);
    std::vector<range_t> ranges;
    for (const Worker& worker : workers_) ranges.insert(ranges.end(), worker.ready.begin(), worker.ready.end());
    return ranges;
}

HostSplitCounts HostSplit::counts() const {
    HostSplitCounts sum;
    for (const Worker& worker : workers_) {
        sum.processed += worker.counts.processed;
        sum.diced += worker.counts.diced;
        sum.culled += worker.counts.culled;
        sum.stackPeak = std::max(sum.stackPeak, worker.counts.stackPeak);
    }
    return sum;
}

double HostSplit::fractionFed() const {
    std::uint64_t fed = 0;
    for (std::size_t k = 0; k < workers_.size(); ++k) fed += (workers_[k].nextPatch - k) / workers_.size();
    return frame_.patches == 0 ? 1.0 : static_cast<double>(fed) / frame_.patches;
}

}  // namespace tessera
