// All patches of a scene, resident on the device: what the split stage feeds from.
#pragma once

#include <cstdint>

#include "device/memory.h"
#include "device/timeline.h"
#include "surface/patch_shared.h"
#include "tessera/scene.h"

namespace tessera {

struct PatchSet {
    std::uint32_t patches = 0;  // placed patches of all objects; Bezier first
    std::uint32_t bezierPatches = 0;
    DeviceBuffer points;     // object space, file order, 12 bytes a point; meshes shared by objects stand once
    DeviceBuffer placed;     // placed_patch
    DeviceBuffer eyePoints;  // written by place_patches every frame

    [[nodiscard]] static std::uint64_t eyeBytes(std::uint32_t bezierPatches, std::uint32_t gregoryPatches) {
        return std::uint64_t{bezierPatches} * 3 * 4 * BEZIER_POINTS + std::uint64_t{gregoryPatches} * 3 * 4 * GREGORY_POINTS;
    }
};

// Uploads a validated scene's patches. Throws Error when they don't fit or are more than 2^31 - 1.
[[nodiscard]] PatchSet uploadPatches(const Scene& scene, DeviceMemory& memory, Timeline& timeline);

}  // namespace tessera
