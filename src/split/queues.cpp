#include "split/queues.h"

#include <algorithm>
#include <utility>

namespace tessera {
namespace {

constexpr std::uint64_t chunks(std::uint64_t ranges) { return (ranges + SPLIT_CHUNK - 1) / SPLIT_CHUNK; }

}  // namespace

std::uint64_t SplitQueues::bytes(const split_limits& limits, std::uint64_t stackRanges) {
    const std::uint64_t buffers[] = {stackRanges * sizeof(range_t),
                                     limits.batch * sizeof(range_t),
                                     limits.ready_capacity * sizeof(range_t),
                                     limits.batch,
                                     chunks(limits.batch) * sizeof(chunk_sum),
                                     sizeof(split_state)};
    std::uint64_t sum = 0;
    for (const std::uint64_t buffer : buffers) sum += DeviceMemory::bytesFor(buffer);
    return sum;
}

void SplitQueues::reserve(const split_limits& limits, std::uint64_t stackRanges) {
    DeviceMemory& memory = session_.memory;
    memory.ensure(stack_, "the stack of ranges", stackRanges * sizeof(range_t));
    memory.ensure(batch_, "the batch of ranges", std::uint64_t{limits.batch} * sizeof(range_t));
    memory.ensure(actions_, "the batch's actions", limits.batch);
    memory.ensure(chunkSums_, "the batch's sums", chunks(limits.batch) * sizeof(chunk_sum));
    memory.ensure(ready_, "the diceable ranges", std::uint64_t{limits.ready_capacity} * sizeof(range_t));
    memory.ensure(state_, "the split stage's counts", sizeof(split_state));
}

void SplitQueues::growStack(std::uint64_t stackRanges, std::uint64_t used) {
    if (stack_.bytes() >= stackRanges * sizeof(range_t)) return;
    DeviceBuffer larger = session_.memory.allocate("the stack of ranges", stackRanges * sizeof(range_t));
    if (used > 0) session_.timeline.copy(stack_.cl(), larger.cl(), used * sizeof(range_t));
    session_.timeline.finish();
    stack_ = std::move(larger);
}

void SplitQueues::release() {
    for (DeviceBuffer* const buffer : {&stack_, &batch_, &actions_, &chunkSums_, &ready_, &state_}) *buffer = DeviceBuffer();
}

void SplitQueues::restart() { session_.timeline.fill(state_.cl(), 0, sizeof(split_state)); }

void SplitQueues::enqueueIteration(const frame_params& frame, const split_limits& limits, const PatchSet& patches) {
    Kernels& kernels = session_.kernels;
    const auto groups = static_cast<std::size_t>(std::min<std::uint64_t>(session_.device.shape.groups, chunks(limits.batch)));
    session_.launch(kernels.with("split_bound", frame, limits, patches.eyePoints.cl(), stack_.cl(), batch_.cl(), actions_.cl(),
                                 chunkSums_.cl(), state_.cl()),
                    "split_bound", groups);
    session_.launch(kernels.with("split_scan", frame, limits, chunkSums_.cl(), state_.cl()), "split_scan", 1);
    session_.launch(kernels.with("split_scatter", batch_.cl(), actions_.cl(), chunkSums_.cl(), state_.cl(), stack_.cl(), ready_.cl()),
                    "split_scatter", groups);
}

split_state SplitQueues::readState() {
    split_state state{};
    session_.timeline.read(state_.cl(), &state, sizeof state);
    return state;
}

cl::Event SplitQueues::readStateLater(split_state& state) { return session_.timeline.readLater(state_.cl(), &state, sizeof state); }

void SplitQueues::writeState(const split_state& state) { session_.timeline.write(state_.cl(), &state, sizeof state); }

void SplitQueues::writeReady(const std::vector<range_t>& ranges) {
    if (!ranges.empty()) session_.timeline.write(ready_.cl(), ranges.data(), ranges.size() * sizeof(range_t));
}

std::vector<range_t> SplitQueues::readStack(std::size_t count) {
    std::vector<range_t> ranges(count);
    if (count > 0) session_.timeline.read(stack_.cl(), ranges.data(), count * sizeof(range_t));
    return ranges;
}

}  // namespace tessera
