// The local method's buffers on the device, and a launch of it: a stack a work-group in local memory, and a pool from which all that is
// left between launches is dealt out anew (local.clh).
#pragma once

#include <cstdint>
#include <vector>

#include "core/frame_shared.h"
#include "device/session.h"
#include "split/local_shared.h"
#include "split/queues.h"
#include "surface/patch_set.h"
#include "tessera/device.h"
#include "tessera/options.h"

namespace tessera {

// How the local method is laid over a device.
struct LocalShape {
    std::uint32_t groups = 1;  // that share the work: as many as the device runs at once
    std::uint32_t width = 1;   // ranges that a group takes at a time

    // The `batch` of split_limits with which this method's ranges are hidden; room for so many diceable ranges is the least that works.
    [[nodiscard]] constexpr std::uint32_t batch() const { return groups * width; }
    // Ranges that all groups' stacks hold at most, whatever the scene.
    [[nodiscard]] constexpr std::uint64_t stackBound() const { return std::uint64_t{LOCAL_LEVELS} * groups * width; }
};

// The widest groups that the device's local memory holds. Throws Error where it holds none.
[[nodiscard]] LocalShape localShape(const DeviceInfo& device, DiceMode mode);

class LocalQueues {
public:
    explicit LocalQueues(DeviceSession& session) : session_(session) {}

    // The bytes that reserve() takes.
    [[nodiscard]] static std::uint64_t bytes(const LocalShape& shape, DiceMode mode);

    // Makes room. Contents are lost: restart() before the next launch. Throws Error where a group's stack would not fit the device's local
    // memory.
    void reserve(const LocalShape& shape, DiceMode mode);
    void release();

    // Empties the pool and the groups' counts, as SplitQueues::restart() does those of the frame.
    void restart();

    // One launch over what is fed: each group bounds ranges for at most `mostRounds` rounds (at least 1). A no-op on the device where
    // nothing is left, or where `ready` has no room for a round of all groups. Counts an iteration; afterwards queues.state() says what the
    // pool holds. Of `queues` only the room for diceable ranges and the counts are used. `limits.batch` must be the shape's batch().
    void enqueueLaunch(const frame_params& frame, const split_limits& limits, const PatchSet& patches, const cl::Buffer& coarse,
                       SplitQueues& queues, std::uint32_t mostRounds);

    // Ranges that each group has bounded since restart(). Waits for the device.
    [[nodiscard]] std::vector<std::uint64_t> groupRanges();
    // What each group did in the last launch that had work. Waits for the device.
    [[nodiscard]] std::vector<local_group> readGroups();

private:
    DeviceSession& session_;
    LocalShape shape_;
    DiceMode mode_ = DiceMode::classical;
    DeviceBuffer pool_;
    DeviceBuffer groups_;
    DeviceBuffer ranks_;
    DeviceBuffer run_;
};

}  // namespace tessera
