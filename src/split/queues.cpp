#include "split/queues.h"

#include <algorithm>
#include <utility>

namespace tessera {
namespace {

constexpr std::uint64_t chunks(std::uint64_t ranges) { return (ranges + SPLIT_CHUNK - 1) / SPLIT_CHUNK; }

}  // namespace

std::uint64_t SplitQueues::bytes(const split_limits& limits, std::uint64_t stackRanges, DiceMode mode) {
    const std::uint64_t range = rangeBytes(mode);
    const std::uint64_t buffers[] = {stackRanges * range,
                                     limits.batch * range,
                                     limits.ready_capacity * range,
                                     limits.batch,
                                     chunks(limits.batch) * sizeof(chunk_sum),
                                     sizeof(split_state),
                                     sizeof(split_state),
                                     0};
    std::uint64_t sum = mode == DiceMode::watertight ? DeviceMemory::bytesFor(limits.batch * sizeof(quad_cut)) : 0;
    for (const std::uint64_t buffer : buffers) sum += DeviceMemory::bytesFor(buffer);
    return sum;
}

void SplitQueues::reserve(const split_limits& limits, std::uint64_t stackRanges) {
    DeviceMemory& memory = session_.memory;
    const std::uint64_t range = rangeBytes(mode_);
    memory.ensure(stack_, Purpose::queues, "the stack of ranges", stackRanges * range);
    memory.ensure(batch_, Purpose::queues, "the batch of ranges", limits.batch * range);
    memory.ensure(actions_, Purpose::queues, "the batch's actions", limits.batch);
    if (mode_ == DiceMode::watertight) memory.ensure(cuts_, Purpose::queues, "the batch's cuts", limits.batch * sizeof(quad_cut));
    memory.ensure(chunkSums_, Purpose::queues, "the batch's sums", chunks(limits.batch) * sizeof(chunk_sum));
    memory.ensure(ready_, Purpose::queues, "the diceable ranges", limits.ready_capacity * range);
    for (DeviceBuffer& state : states_) memory.ensure(state, Purpose::queues, "the split stage's counts", sizeof(split_state));
    memory.ensure(spare_, Purpose::queues, "a stand-in", 0);
}

void SplitQueues::growStack(std::uint64_t stackRanges, std::uint64_t used) {
    const std::uint64_t range = rangeBytes(mode_);
    if (stack_.bytes() >= stackRanges * range) return;
    DeviceBuffer larger = session_.memory.allocate(Purpose::queues, "the stack of ranges", stackRanges * range);
    if (used > 0) session_.timeline.copy(stack_.cl(), larger.cl(), used * range);
    session_.timeline.finish();
    stack_ = std::move(larger);
}

void SplitQueues::release() {
    for (DeviceBuffer* const buffer : {&stack_, &batch_, &actions_, &cuts_, &chunkSums_, &ready_, &states_[0], &states_[1], &spare_}) {
        *buffer = DeviceBuffer();
    }
}

void SplitQueues::restart() { session_.timeline.fill(state(), 0, sizeof(split_state)); }

void SplitQueues::enqueueFeed(const frame_params& frame, const PatchSet& patches) {
    session_.launch(session_.kernels.with("feed_patches", frame, patches.boxes.cl(), patches.feed.cl(), state(), stateAfter()),
                    "feed_patches", 1);
    passState();
}

std::size_t SplitQueues::groupsFor(const split_limits& limits) const {
    return static_cast<std::size_t>(std::min<std::uint64_t>(session_.device.shape.groups, chunks(limits.batch)));
}

void SplitQueues::enqueueIteration(const frame_params& frame, const split_limits& limits, const PatchSet& patches,
                                   const cl::Buffer& coarse) {
    if (mode_ == DiceMode::watertight)
        enqueueWatertight(frame, limits, patches, coarse);
    else
        enqueueClassical(frame, limits, patches);
    passState();
}

void SplitQueues::scanChunks(const split_limits& limits) {
    session_.launch(session_.kernels.with("split_scan", limits, chunkSums_.cl(), state(), stateAfter()), "split_scan", 1);
}

void SplitQueues::enqueueClassical(const frame_params& frame, const split_limits& limits, const PatchSet& patches) {
    Kernels& kernels = session_.kernels;
    const std::size_t groups = groupsFor(limits);
    session_.launch(kernels.with("split_bound", frame, limits, patches.eyePoints.cl(), patches.feed.cl(), stack_.cl(), batch_.cl(),
                                 actions_.cl(), chunkSums_.cl(), state()),
                    "split_bound", groups);
    scanChunks(limits);
    session_.launch(kernels.with("split_scatter", limits, batch_.cl(), actions_.cl(), chunkSums_.cl(), state(), stack_.cl(), ready_.cl()),
                    "split_scatter", groups);
}

void SplitQueues::enqueueWatertight(const frame_params& frame, const split_limits& limits, const PatchSet& patches,
                                    const cl::Buffer& coarse) {
    Kernels& kernels = session_.kernels;
    const std::size_t groups = groupsFor(limits);
    session_.launch(kernels.with("quad_bound", frame, limits, patches.eyePoints.cl(), patches.dicingPoints.cl(), patches.placed.cl(),
                                 patches.records.cl(), patches.feed.cl(), coarse, stack_.cl(), batch_.cl(), actions_.cl(), cuts_.cl(),
                                 chunkSums_.cl(), state()),
                    "quad_bound", groups);
    scanChunks(limits);
    session_.launch(
        kernels.with("quad_scatter", limits, batch_.cl(), actions_.cl(), cuts_.cl(), chunkSums_.cl(), state(), stack_.cl(), ready_.cl()),
        "quad_scatter", groups);
}

split_state SplitQueues::readState() {
    split_state state{};
    session_.timeline.read(this->state(), &state, sizeof state);
    return state;
}

cl::Event SplitQueues::readStateLater(split_state& state) { return session_.timeline.readLater(this->state(), &state, sizeof state); }

void SplitQueues::writeState(const split_state& state) { session_.timeline.write(this->state(), &state, sizeof state); }

}  // namespace tessera
