// All patches of a scene, resident on the device: what the split stage feeds from.
#pragma once

#include <cstdint>

#include "core/frame_shared.h"
#include "device/session.h"
#include "surface/patch_shared.h"
#include "tessera/scene.h"

namespace tessera {

struct PatchSet {
    std::uint32_t patches = 0;  // placed patches of all objects; Bezier first, then Gregory, rational, PN
    std::uint32_t bezierPatches = 0;
    std::uint32_t gregoryEnd = 0;   // index behind the last Gregory patch
    std::uint32_t rationalEnd = 0;  // index behind the last rational patch
    std::uint32_t recordCount = 0;  // edge records of all placed patches
    DeviceBuffer points;            // object space, file order; meshes shared by objects stand once
    DeviceBuffer placed;            // placed_patch
    DeviceBuffer records;           // edge_info
    DeviceBuffer eyePoints;         // written by enqueuePlace() every frame

    [[nodiscard]] std::uint64_t eyeBytes() const;
    // Bytes of all buffers here.
    [[nodiscard]] std::uint64_t bytes() const { return points.bytes() + placed.bytes() + records.bytes() + eyePoints.bytes(); }
};

// Uploads a validated scene's patches. Throws Error when they don't fit or are more than 2^31 - 1.
[[nodiscard]] PatchSet uploadPatches(const Scene& scene, DeviceMemory& memory, Timeline& timeline);

// Enqueues place_patches and place_records: `objects` holds placed_object, `eyePoints` eyeBytes() bytes. `frame` needs its patch counts
// only.
void enqueuePlace(DeviceSession& session, const frame_params& frame, const PatchSet& patches, const cl::Buffer& objects,
                  const cl::Buffer& eyePoints);

}  // namespace tessera
