// Patches on the device: what the split stage feeds from.
#pragma once

#include <cstdint>

#include "core/frame_shared.h"
#include "device/session.h"
#include "surface/patch_shared.h"
#include "tessera/scene.h"

namespace tessera {

struct PatchChunk;

// A run of a scene's patches on the device: all of them where they fit, else a chunk. Copies share their buffers.
struct PatchSet {
    std::uint32_t first = 0;    // index of the first patch among all placed patches of the scene
    std::uint32_t patches = 0;  // placed patches; Bezier first, then Gregory, rational, PN
    std::uint32_t bezierPatches = 0;
    std::uint32_t gregoryEnd = 0;   // index behind the last Gregory patch
    std::uint32_t rationalEnd = 0;  // index behind the last rational patch
    std::uint32_t recordCount = 0;  // edge records of all patches here
    bool streamed = false;          // whether it is a chunk: others come after it
    DeviceBuffer points;            // object space, file order; meshes shared by objects stand once
    DeviceBuffer placed;            // placed_patch
    DeviceBuffer records;           // edge_info
    DeviceBuffer objects;           // placed_object: what `placed` and `records` index
    DeviceBuffer dicingObjects;     // the same as the dicing camera sees them, where it is another
    DeviceBuffer eyePoints;         // written by enqueuePlace() every frame
    DeviceBuffer dicingPoints;      // the patches in the dicing camera's space; eyePoints itself where it is the frame's own camera
    DeviceBuffer boxes;             // patch_box: written by enqueuePlace()
    DeviceBuffer feed;              // uint: patches to be fed, in order; written by SplitQueues for every bucket

    [[nodiscard]] std::uint64_t eyeBytes() const;
};

// Takes the chunk's first patch and its counts. What the buffers hold is the caller's.
void setCounts(PatchSet& set, const PatchChunk& chunk);
// The frame's patches are those of the set.
void setPatches(frame_params& frame, const PatchSet& patches);

// Uploads all of a validated scene's patches; `objects` and `dicingObjects` are left to the caller, by index into Scene::objects. Throws
// Error when they don't fit or are more than 2^31 - 1.
[[nodiscard]] PatchSet uploadPatches(const Scene& scene, DeviceMemory& memory, Timeline& timeline);

// Enqueues place_patches and place_records: `objects` holds placed_object, `eyePoints` eyeBytes() bytes. `frame` needs its patch counts.
// Where `eyePoints` are the set's own and `boxes` is set, place_boxes follows, for which `frame` needs its camera too.
void enqueuePlace(DeviceSession& session, const frame_params& frame, const PatchSet& patches, const cl::Buffer& objects,
                  const cl::Buffer& eyePoints, bool boxes = true);

}  // namespace tessera
