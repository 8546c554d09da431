// What a tessellation's device memory goes to, before it starts: patches in chunks, tables of what becomes of them, and the mesh.
#pragma once

#include <cstdint>
#include <string>

#include "device/memory.h"
#include "surface/patch_source.h"

namespace tessera {

struct MeshPlan {
    std::uint64_t budget = 0;
    std::uint32_t patchesEach = 1;   // of a chunk
    std::uint64_t patchBytes = 0;    // of chunks and their tables
    std::uint64_t vertexBytes = 0;   // of one vertex
    std::uint64_t roomVertices = 0;  // that the mesh's buffers may hold beside them, with the triangles that they can have at most

    [[nodiscard]] std::uint64_t meshRoom() const { return budget - patchBytes; }
};

// Bytes of a vertex with the triangles that belong to it: fewer than two, for a pattern is a disc, and its parts are strips and discs.
[[nodiscard]] std::uint64_t bytesAVertex(bool positionsOnly);

// Vertices that a unit of any pattern has at most: two lines of a side.
[[nodiscard]] std::uint64_t mostUnitVertices();

// Chunks that leave the mesh half of the budget or more, where they can be so small. `largestBuffer`: what one buffer may have.
// Throws Error, naming the least budget that would do, where a chunk of one patch and a piece of one unit don't fit.
[[nodiscard]] MeshPlan planMesh(const PatchSource& source, const std::string& sceneName, std::uint64_t budget, std::uint64_t largestBuffer,
                                bool positionsOnly);

}  // namespace tessera
