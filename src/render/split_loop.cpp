#include "render/split_loop.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "dice/dice.h"
#include "render/frame_setup.h"
#include "split/host_split.h"
#include "tessera/error.h"

namespace tessera {
namespace {

// Limits under which the device finds `ready` full whatever it holds, so that all of it is hidden and resolved.
constexpr split_limits hideWhatIsReady{std::numeric_limits<std::uint32_t>::max(), std::numeric_limits<std::uint32_t>::max() - 1, 0};

void requireIds(const SplitLoop& loop, std::uint64_t ranges) {
    if (ranges <= mostNumbered(loop.frame.rate_bits)) return;
    throw Error("breadth has " + std::to_string(ranges) +
                " ranges at once, more than 32 bits can number when they are diced; use --method bounded");
}

// Names what breadth's growth would have taken.
void growQueues(const SplitLoop& loop, std::uint64_t ranges, std::uint64_t kept, SplitReport& report) {
    const auto all = static_cast<std::uint32_t>(ranges);
    const std::uint64_t before = loop.session.memory.bytes();
    try {
        loop.queues.growStack(2 * ranges, kept);
        loop.queues.reserve({all, all, 0}, 0);
    } catch (const Error& error) {
        throw Error("breadth needs room for " + std::to_string(ranges) + " ranges at once: " + error.what() +
                    ", or --method bounded, whose memory is fixed");
    }
    if (loop.session.memory.bytes() != before) ++report.stackGrowths;
}

}  // namespace

void enqueueHide(const SplitLoop& loop, const split_limits& limits) {
    enqueueDiceHide(loop.session, loop.frame, limits, loop.queues, loop.patches, loop.film, loop.options.emulateAtomics);
    loop.film.enqueueAfterHiding(loop.frame, limits, loop.queues);
}

SplitReport runBreadth(const SplitLoop& loop) {
    SplitReport report;
    split_state state = loop.queues.readState();
    ++report.hostWaits;
    while (!splitOver(state)) {
        const std::uint64_t count = state.stack_count + (state.feed_count - state.next_input);
        requireIds(loop, count);
        const auto all = static_cast<std::uint32_t>(count);
        growQueues(loop, count, state.stack_count, report);
        loop.queues.enqueueIteration(loop.frame, {all, all, 0}, loop.patches, loop.film.coarse());
        enqueueHide(loop, hideWhatIsReady);
        state = loop.queues.readState();
        ++report.hostWaits;
        if (loop.report) loop.report(std::min(1.0, static_cast<double>(state.area_done) / loop.patches.patches));
    }
    if (loop.finish) {
        loop.finish();
        ++report.hostWaits;
    }
    return report;
}

namespace {

template <typename T>
std::vector<T> readAll(Timeline& timeline, const cl::Buffer& buffer, std::size_t count) {
    std::vector<T> values(count);
    if (count > 0) timeline.read(buffer, values.data(), count * sizeof(T));
    return values;
}

HostPatches readPatches(const SplitLoop& loop) {
    Timeline& timeline = loop.session.timeline;
    const PatchSet& patches = loop.patches;
    const std::size_t floats = patches.eyeBytes() / sizeof(float);
    HostPatches host;
    host.eyePoints = readAll<float>(timeline, patches.eyePoints.cl(), floats);
    if (loop.frame.dicing_apart != 0) host.dicingPoints = readAll<float>(timeline, patches.dicingPoints.cl(), floats);
    host.placed = readAll<placed_patch>(timeline, patches.placed.cl(), patches.patches);
    host.records = readAll<edge_info>(timeline, patches.records.cl(), patches.recordCount);
    return host;
}

void addCounts(split_state& state, const HostSplitCounts& counts) {
    const auto add = [](std::uint32_t& low, std::uint32_t& high, std::uint64_t count) {
        const std::uint64_t sum = wide(low, high) + count;
        low = static_cast<std::uint32_t>(sum);
        high = static_cast<std::uint32_t>(sum >> 32);
    };
    add(state.processed_low, state.processed_high, counts.processed);
    add(state.diced_low, state.diced_high, counts.diced);
    add(state.culled_low, state.culled_high, counts.culled);
    add(state.micropolygons_low, state.micropolygons_high, counts.micropolygons);
    state.stack_peak = std::max(state.stack_peak, static_cast<std::uint32_t>(counts.stackPeak));
}

template <typename Rule>
SplitReport runOnHost(const SplitLoop& loop, Rule rule) {
    using Clock = std::chrono::steady_clock;
    SplitReport report;
    HostSplit<Rule> split(std::move(rule), loop.options.threads);
    split_state state = loop.queues.readState();
    ++report.hostWaits;
    // The device must take no batch for the last one: the state says that patches are left.
    state.next_input = 0;
    state.feed_count = 1;
    while (true) {
        const auto start = Clock::now();
        const std::vector<typename Rule::Range> ranges = split.next(loop.limits.batch);
        report.hostMs += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        if (ranges.empty()) break;
        state.ready_count = static_cast<std::uint32_t>(ranges.size());
        // These wait for the batch before, which the device has drawn meanwhile.
        loop.queues.writeReady(ranges);
        loop.queues.writeState(state);
        ++report.hostWaits;
        enqueueHide(loop, hideWhatIsReady);
        loop.session.timeline.flush();
        ++state.batches;
        if (loop.report) loop.report(split.fractionFed());
    }
    state.ready_count = 0;
    state.feed_count = 0;
    addCounts(state, split.counts());
    loop.queues.writeState(state);
    if (loop.finish) loop.finish();
    ++report.hostWaits;
    return report;
}

}  // namespace

SplitReport runCpu(const SplitLoop& loop) {
    HostPatches patches = readPatches(loop);
    if (loop.frame.watertight != 0) return runOnHost(loop, WatertightRule(loop.frame, std::move(patches)));
    return runOnHost(loop, ClassicalRule(loop.frame, std::move(patches.eyePoints)));
}

}  // namespace tessera
