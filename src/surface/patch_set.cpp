#include "surface/patch_set.h"

#include <algorithm>

#include "surface/patch_source.h"

namespace tessera {
namespace {

// The caller's objects are those of the scene, in its order.
void indexByScene(PatchChunk& chunk) {
    for (placed_patch& patch : chunk.placed) patch.object = chunk.objects[patch.object];
    for (edge_info& record : chunk.records) record.object = chunk.objects[record.object];
}

template <typename T>
DeviceBuffer uploaded(DeviceMemory& memory, Timeline& timeline, const char* name, const std::vector<T>& values) {
    const std::size_t bytes = values.size() * sizeof(T);
    DeviceBuffer buffer = memory.allocate(Purpose::scene, name, bytes, CL_MEM_READ_ONLY);
    if (bytes > 0) timeline.write(buffer.cl(), values.data(), bytes);
    return buffer;
}

}  // namespace

std::uint64_t PatchSet::eyeBytes() const {
    const std::uint64_t floats = std::uint64_t{bezierPatches} * BEZIER_FLOATS + std::uint64_t{gregoryEnd - bezierPatches} * GREGORY_FLOATS +
                                 std::uint64_t{rationalEnd - gregoryEnd} * RATIONAL_FLOATS +
                                 std::uint64_t{patches - rationalEnd} * PN_FLOATS + std::uint64_t{recordCount} * RECORD_FLOATS;
    return floats * sizeof(float);
}

void setCounts(PatchSet& set, const PatchChunk& chunk) {
    set.first = chunk.first;
    set.patches = chunk.patches;
    set.bezierPatches = chunk.bezierPatches;
    set.gregoryEnd = chunk.gregoryEnd;
    set.rationalEnd = chunk.rationalEnd;
    set.recordCount = static_cast<std::uint32_t>(chunk.records.size());
}

void setPatches(frame_params& frame, const PatchSet& patches) {
    frame.bezier_patches = patches.bezierPatches;
    frame.gregory_end = patches.gregoryEnd;
    frame.rational_end = patches.rationalEnd;
    frame.patches = patches.patches;
    frame.first_patch = patches.first;
    frame.streamed = patches.streamed ? 1 : 0;
}

PatchSet uploadPatches(const Scene& scene, DeviceMemory& memory, Timeline& timeline) {
    const PatchSource source(scene);
    PatchChunk chunk;
    source.gather(0, source.patches(), chunk);
    indexByScene(chunk);
    PatchSet set;
    setCounts(set, chunk);
    set.points = uploaded(memory, timeline, "the scene's control points", chunk.floats);
    set.placed = uploaded(memory, timeline, "the scene's patches", chunk.placed);
    set.records = uploaded(memory, timeline, "the scene's edge records", chunk.records);
    set.eyePoints = memory.allocate(Purpose::scene, "the patches in eye space", set.eyeBytes());
    set.dicingPoints = set.eyePoints;
    set.boxes = memory.allocate(Purpose::scene, "the patches' boxes", set.patches * sizeof(patch_box));
    set.feed = memory.allocate(Purpose::scene, "the patches to be fed", set.patches * sizeof(std::uint32_t));
    return set;
}

void enqueuePlace(DeviceSession& session, const frame_params& frame, const PatchSet& patches, const cl::Buffer& objects,
                  const cl::Buffer& eyePoints, bool boxes) {
    // A work-item a patch in turn; 64 a group on every device.
    const auto groups = [&](std::uint32_t items) { return std::min<std::size_t>((items + 63) / 64, session.device.shape.groups); };
    Kernels& kernels = session.kernels;
    if (patches.patches == 0) return;
    session.timeline.launch(kernels.with("place_patches", frame, patches.points.cl(), patches.placed.cl(), objects, eyePoints),
                            "place_patches", groups(patches.patches), 64);
    if (patches.recordCount > 0) {
        session.timeline.launch(
            kernels.with("place_records", frame, patches.recordCount, patches.points.cl(), patches.records.cl(), objects, eyePoints),
            "place_records", groups(patches.recordCount), 64);
    }
    if (!boxes || eyePoints() != patches.eyePoints.cl()()) return;
    session.timeline.launch(kernels.with("place_boxes", frame, eyePoints, patches.placed.cl(), patches.records.cl(), patches.boxes.cl()),
                            "place_boxes", groups(patches.patches), 64);
}

}  // namespace tessera
