// Runs the split stage alone, one iteration at a time, and looks at its queues in between.
#pragma once

#include "split_model.h"

#include "core/frame_shared.h"
#include "device/session.h"
#include "split/queues.h"
#include "surface/patch_set.h"
#include "tessera/options.h"
#include "tessera/scene.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace tessera::splitting {

// How the kernels are laid over the device: as the library chooses, or as it does on GPUs (64 work-items of one lane).
enum class Shape { native, gpu };

// Where compiled kernels are kept: $TESSERA_CACHE where it is set, for a run under another work-group method must not find the kernels
// of this one.
[[nodiscard]] std::filesystem::path kernelCache();

// A device with split kernels, and a scene placed before a camera on it.
class SplitRig {
public:
    explicit SplitRig(KernelSources sources, Shape shape = Shape::native);

    // The picture's size and the split bound and depth are taken from `options`.
    void place(const Scene& scene, const Camera& camera, const RenderOptions& options);

    [[nodiscard]] DeviceSession& session() { return session_; }
    [[nodiscard]] const frame_params& frame() const { return frame_; }
    [[nodiscard]] const PatchSet& patches() const { return patches_; }
    // The control points as place_patches left them on the device.
    [[nodiscard]] const std::vector<float>& eyePoints() const { return eyePoints_; }
    // What boundOnHost() says of a range of the scene that is placed. Valid until the next place().
    [[nodiscard]] Decide hostBound() const;

private:
    DeviceSession session_;
    PatchSet patches_;
    frame_params frame_{};
    std::vector<float> eyePoints_;
};

// The queues of one pass over the scene.
class SplitPass {
public:
    // Room for exactly the ranges that `limits` and the bound (K + 1) p allow, and `spare` ranges behind them that no iteration may touch.
    SplitPass(SplitRig& rig, split_limits limits, std::uint64_t spare);

    // One iteration, and what it left.
    void step();
    // The breadth method's: all that waits at once, in queues that grow.
    void stepBreadth();
    // Takes what is ready, as dicing does.
    [[nodiscard]] std::vector<range_t> takeReady();

    [[nodiscard]] const split_state& state() const { return state_; }
    [[nodiscard]] std::uint64_t processed() const { return wide(state_.processed_low, state_.processed_high); }
    [[nodiscard]] std::uint64_t diced() const { return wide(state_.diced_low, state_.diced_high); }
    [[nodiscard]] std::uint64_t culled() const { return wide(state_.culled_low, state_.culled_high); }
    [[nodiscard]] bool over() const { return splitOver(state_); }
    [[nodiscard]] std::vector<range_t> stack() { return queues_.readStack(state_.stack_count); }
    // Whether the spare ranges hold what they held at first.
    [[nodiscard]] bool spareUntouched() { return same(readSpare(), spareAtFirst_); }
    [[nodiscard]] const split_limits& limits() const { return limits_; }
    void growStack(std::uint64_t ranges) { queues_.growStack(ranges, state_.stack_count); }

private:
    [[nodiscard]] std::vector<range_t> readSpare();

    SplitRig& rig_;
    split_limits limits_;
    std::uint64_t bound_;
    std::uint64_t spare_;
    SplitQueues queues_;
    split_state state_{};
    std::vector<range_t> spareAtFirst_;
};

}  // namespace tessera::splitting
