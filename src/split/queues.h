// The split stage's buffers on the device, and one iteration of bound and split over them (split.cl).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/frame_shared.h"
#include "device/session.h"
#include "split/quad_shared.h"
#include "split/range_shared.h"
#include "surface/patch_set.h"
#include "tessera/options.h"

namespace tessera {

class SplitQueues {
public:
    explicit SplitQueues(DeviceSession& session) : session_(session) {}

    // The bytes that reserve() takes, for ranges of a mode.
    [[nodiscard]] static std::uint64_t bytes(const split_limits& limits, std::uint64_t stackRanges, DiceMode mode);
    [[nodiscard]] static std::uint64_t rangeBytes(DiceMode mode) {
        return mode == DiceMode::watertight ? sizeof(quad_range) : sizeof(range_t);
    }

    // Which ranges the queues hold from the next reserve() on.
    void setMode(DiceMode mode) { mode_ = mode; }

    // Makes room for iterations within `limits` on a stack of `stackRanges`. Contents are lost.
    void reserve(const split_limits& limits, std::uint64_t stackRanges);
    // Makes the stack larger and keeps the `used` ranges on it (the breadth method's growth).
    void growStack(std::uint64_t stackRanges, std::uint64_t used);

    // Lets go of all buffers.
    void release();

    // Empties the queues and all counts.
    void restart();
    // Feeds the patches that may be seen, in order (feed.cl). Requires that nothing is left of those fed before,
    // and that what is diceable of them is resolved or shaded.
    void enqueueFeed(const frame_params& frame, const PatchSet& patches);
    // One iteration; a no-op on the device where nothing is left or too little room is in `ready`. `coarse` is read where
    // frame.occlusion is set (film/coarse.cl).
    void enqueueIteration(const frame_params& frame, const split_limits& limits, const PatchSet& patches, const cl::Buffer& coarse);
    void enqueueIteration(const frame_params& frame, const split_limits& limits, const PatchSet& patches) {
        enqueueIteration(frame, limits, patches, spare_.cl());
    }

    [[nodiscard]] split_state readState();
    [[nodiscard]] cl::Event readStateLater(split_state& state);
    void writeState(const split_state& state);
    template <typename Range>
    void writeReady(const std::vector<Range>& ranges) {
        if (!ranges.empty()) session_.timeline.write(ready_.cl(), ranges.data(), ranges.size() * sizeof(Range));
    }
    // The first ranges on the stack, for tests.
    template <typename Range = range_t>
    [[nodiscard]] std::vector<Range> readStack(std::size_t count) {
        std::vector<Range> ranges(count);
        if (count > 0) session_.timeline.read(stack_.cl(), ranges.data(), count * sizeof(Range));
        return ranges;
    }

    [[nodiscard]] const cl::Buffer& ready() const { return ready_.cl(); }
    // The counts as the next kernel finds them.
    [[nodiscard]] const cl::Buffer& state() const { return states_[now_].cl(); }
    // Where a kernel writes them; afterwards passState() makes them state().
    [[nodiscard]] const cl::Buffer& stateAfter() const { return states_[1 - now_].cl(); }
    void passState() { now_ = 1 - now_; }

private:
    void enqueueClassical(const frame_params& frame, const split_limits& limits, const PatchSet& patches);
    void enqueueWatertight(const frame_params& frame, const split_limits& limits, const PatchSet& patches, const cl::Buffer& coarse);
    void scanChunks(const split_limits& limits);
    [[nodiscard]] std::size_t groupsFor(const split_limits& limits) const;

    DeviceSession& session_;
    DiceMode mode_ = DiceMode::classical;
    DeviceBuffer stack_;
    DeviceBuffer batch_;
    DeviceBuffer actions_;
    DeviceBuffer cuts_;  // watertight mode
    DeviceBuffer chunkSums_;
    DeviceBuffer ready_;
    std::array<DeviceBuffer, 2> states_;
    std::size_t now_ = 0;
    DeviceBuffer spare_;  // stands in for buffers that a launch does not read
};

// Sums of a frame's counts.
[[nodiscard]] constexpr std::uint64_t wide(std::uint32_t low, std::uint32_t high) { return (std::uint64_t{high} << 32) | low; }

// Whether nothing is left to split.
[[nodiscard]] inline bool splitOver(const split_state& state) { return state.stack_count == 0 && state.next_input >= state.feed_count; }

}  // namespace tessera
