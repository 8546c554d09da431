// What a chunk's patches come to: a pattern each, where its vertices and triangles go, and the sums.
#pragma once

#include <cstdint>

#include "device/session.h"
#include "mesh/mesh_shared.h"
#include "surface/patch_set.h"

namespace tessera {

class MeshTables {
public:
    explicit MeshTables(DeviceSession& session) : session_(session) {}

    // Device bytes that reserve() takes.
    [[nodiscard]] static std::uint64_t bytes(std::uint32_t patches);
    // Makes room for chunks of `patches`. Throws Error where memory is short.
    void reserve(std::uint32_t patches);
    void release();

    // Enqueues the first two stages, for patches whose nets are in place: what follows on the main queue finds patterns and offsets.
    // `turned`: turnedPatches() of the scene.
    void enqueue(const frame_params& frame, const mesh_view& view, const PatchSet& patches, const cl::Buffer& turned);
    // Waits for them.
    [[nodiscard]] mesh_totals totals();
    // The chunk's `patches` patterns, and one offset more. Both wait.
    void readPatterns(std::uint32_t patches, mesh_pattern* patterns);
    void readOffsets(std::uint32_t patches, mesh_offset* offsets);

    [[nodiscard]] const cl::Buffer& patterns() const { return patterns_.cl(); }
    [[nodiscard]] const cl::Buffer& offsets() const { return offsets_.cl(); }

private:
    DeviceSession& session_;
    DeviceBuffer patterns_;
    DeviceBuffer sums_;
    DeviceBuffer offsets_;
    DeviceBuffer totals_;
};

}  // namespace tessera
