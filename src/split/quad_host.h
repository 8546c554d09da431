// A step of the watertight split on the host: the kernels' headers (quad_measure.clh) compiled as C++, with the same bits.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/frame_shared.h"
#include "split/quad_shared.h"
#include "surface/patch_shared.h"

namespace tessera {

// What the kernels read, copied from the device.
struct HostPatches {
    std::vector<float> eyePoints;     // as place_patches and place_records write them
    std::vector<float> dicingPoints;  // the same for the dicing camera; empty where it is the frame's own
    std::vector<placed_patch> placed;
    std::vector<edge_info> records;
};

// A patch as it is fed.
[[nodiscard]] quad_range wholePatch(const frame_params& frame, std::uint32_t patchIndex);

struct QuadStep {
    int action = 0;                        // 0 culled, 1 to be diced, 2 or 3 split
    quad_range diced{};                    // with its grid's size, where it is to be diced
    std::array<quad_range, 2> children{};  // where it is split
};

[[nodiscard]] QuadStep splitOnHost(const frame_params& frame, const HostPatches& patches, const quad_range& range);

// The vertices of one of a diced range's edges in units of 2^-24, in the order of its corners, both ends included, and their places in the
// space of `patches.eyePoints` as dicing computes them: for tests.
struct HostVertex {
    std::uint32_t u = 0;
    std::uint32_t v = 0;
    std::array<float, 3> position{};
};
[[nodiscard]] std::vector<HostVertex> edgeVerticesOnHost(const frame_params& frame, const HostPatches& patches, const quad_range& range,
                                                         int edge);

}  // namespace tessera
