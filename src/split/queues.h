// The split stage's buffers on the device, and one iteration of bound and split over them (split.cl).
#pragma once

#include <cstdint>

#include "core/frame_shared.h"
#include "device/session.h"
#include "split/range_shared.h"
#include "surface/patch_set.h"

namespace tessera {

class SplitQueues {
public:
    explicit SplitQueues(DeviceSession& session) : session_(session) {}

    // The bytes that reserve() takes.
    [[nodiscard]] static std::uint64_t bytes(const split_limits& limits, std::uint64_t stackRanges);

    // Makes room for iterations within `limits` on a stack of `stackRanges`. Contents are lost.
    void reserve(const split_limits& limits, std::uint64_t stackRanges);
    // Makes the stack larger and keeps the `used` ranges on it (the breadth method's growth).
    void growStack(std::uint64_t stackRanges, std::uint64_t used);

    // Lets go of all buffers.
    void release();

    // Empties the queues for a new frame.
    void restart();
    // One iteration; a no-op on the device where nothing is left or too little room is in `ready`.
    void enqueueIteration(const frame_params& frame, const split_limits& limits, const PatchSet& patches);

    [[nodiscard]] split_state readState();
    [[nodiscard]] cl::Event readStateLater(split_state& state);
    void writeState(const split_state& state);
    void writeReady(const std::vector<range_t>& ranges);
    [[nodiscard]] std::vector<range_t> readStack(std::size_t count);  // for tests

    [[nodiscard]] const cl::Buffer& ready() const { return ready_.cl(); }
    [[nodiscard]] const cl::Buffer& state() const { return state_.cl(); }

private:
    DeviceSession& session_;
    DeviceBuffer stack_;
    DeviceBuffer batch_;
    DeviceBuffer actions_;
    DeviceBuffer chunkSums_;
    DeviceBuffer ready_;
    DeviceBuffer state_;
};

// Sums of a frame's counts.
[[nodiscard]] constexpr std::uint64_t wide(std::uint32_t low, std::uint32_t high) { return (std::uint64_t{high} << 32) | low; }

// Whether nothing is left to split.
[[nodiscard]] inline bool splitOver(const split_state& state, const PatchSet& patches) {
    return state.stack_count == 0 && state.next_input >= patches.patches;
}

}  // namespace tessera
