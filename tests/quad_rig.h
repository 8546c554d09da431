// Runs the split stage of the watertight mode alone, by each method, and shows what dicing makes of its ranges' borders.
#pragma once

#include "split_rig.h"

#include "split/quad_host.h"
#include "split/quad_shared.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tessera::splitting {

// A byte of quad_range's rates or sizes.
[[nodiscard]] constexpr std::uint32_t byteOf(std::uint32_t bytes, std::uint32_t k) { return (bytes >> (8U * (k & 3U))) & 0xffU; }

// Cuts from the patch to the range.
[[nodiscard]] constexpr std::uint32_t cutsOf(const quad_range& range) { return byteOf(range.sizes, 0) + byteOf(range.sizes, 1); }

// In an order of their own: to compare multisets.
[[nodiscard]] std::vector<quad_range> sorted(std::vector<quad_range> ranges);
[[nodiscard]] bool same(const std::vector<quad_range>& a, const std::vector<quad_range>& b);

// A vertex of the walk around a diced range, as dicing computes it.
struct BorderVertex {
    std::uint32_t u = 0;  // units of 2^-24
    std::uint32_t v = 0;
    std::uint32_t place = 0;                  // in the grid
    std::array<std::uint32_t, 3> position{};  // bits of the eye-space coordinates, -0 as +0
};
using Border = std::vector<BorderVertex>;  // edge after edge, each without its last vertex; vertices may follow each other twice

// A device with the kernels of place and split and one that dumps borders, and a scene placed before a camera on it.
class QuadRig {
public:
    // `lanes`: 16, 8 or 1, or 0 for the device's own.
    explicit QuadRig(KernelSources sources, Shape shape = Shape::native, int lanes = 0);

    // `options` must be of the watertight mode.
    void place(const Scene& scene, const Camera& camera, const RenderOptions& options);
    // Cuts in one direction from here on until the next place().
    void setLevelMost(std::uint32_t level) { frame_.level_most = level; }

    [[nodiscard]] DeviceSession& session() { return session_; }
    [[nodiscard]] const frame_params& frame() const { return frame_; }
    [[nodiscard]] const PatchSet& patches() const { return patches_; }
    [[nodiscard]] const HostPatches& host() const { return host_; }

    // What quad_border_vertices() and patch_vertex() make of diced ranges.
    [[nodiscard]] std::vector<Border> borders(const std::vector<quad_range>& diced);

private:
    [[nodiscard]] std::vector<float> placeFor(const Scene& scene, const Camera& camera, const cl::Buffer& to);
    void dump(const quad_range* diced, std::size_t count, std::vector<Border>& borders);

    DeviceSession session_;
    PatchSet patches_;
    frame_params frame_{};
    HostPatches host_;
};

// The queues of one pass over the scene, p ranges at a time.
class QuadPass {
public:
    // Room for exactly the (2 L + 1) p ranges of the bound, and `spare` behind them that no iteration may touch.
    QuadPass(QuadRig& rig, split_limits limits, std::uint64_t spare);

    void step();
    // The breadth method's: all that waits at once, in queues that grow.
    void stepBreadth();
    [[nodiscard]] std::vector<quad_range> takeReady();

    [[nodiscard]] const split_state& state() const { return state_; }
    [[nodiscard]] std::uint64_t processed() const { return wide(state_.processed_low, state_.processed_high); }
    [[nodiscard]] std::uint64_t diced() const { return wide(state_.diced_low, state_.diced_high); }
    [[nodiscard]] std::uint64_t culled() const { return wide(state_.culled_low, state_.culled_high); }
    [[nodiscard]] bool over() const { return splitOver(state_); }
    [[nodiscard]] std::vector<quad_range> stack() { return queues_.readStack<quad_range>(state_.stack_count); }
    [[nodiscard]] bool spareUntouched() { return same(readSpare(), spareAtFirst_); }
    [[nodiscard]] std::uint64_t bound() const { return bound_; }

private:
    [[nodiscard]] std::vector<quad_range> readSpare();

    QuadRig& rig_;
    split_limits limits_;
    std::uint64_t bound_;
    std::uint64_t spare_;
    SplitQueues queues_;
    split_state state_{};
    std::vector<quad_range> spareAtFirst_;
};

// What a method finds of the scene that is placed.
struct QuadsFound {
    std::vector<quad_range> diced;
    std::uint64_t processed = 0;
    std::uint64_t culled = 0;
};

[[nodiscard]] QuadsFound findBounded(QuadRig& rig, std::uint32_t p);
[[nodiscard]] QuadsFound findBreadth(QuadRig& rig);
[[nodiscard]] QuadsFound findOnHost(const QuadRig& rig, unsigned threads);

}  // namespace tessera::splitting
