// The JSON of a GLB file: what its binary part holds.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tessera {

// What an object's vertices and triangles are in the file. Offsets count from the binary part's begin.
struct GlbMesh {
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
    std::uint64_t verticesAt = 0;
    std::uint64_t indicesAt = 0;
    std::array<float, 3> lower{};
    std::array<float, 3> upper{};
};

struct GlbNode {
    std::string name;
    GlbMesh mesh;  // with no triangles the node has none
};

// Bytes of a vertex: POSITION and, unless `positionsOnly`, NORMAL, TEXCOORD_0 and _PATCH_ID, all floats, in this order.
[[nodiscard]] constexpr std::uint64_t glbVertexBytes(bool positionsOnly) { return positionsOnly ? 12 : 36; }

// As long whatever the bounds are, so that it can be written again when they are known.
[[nodiscard]] std::string glbJson(std::span<const GlbNode> nodes, std::uint64_t binaryBytes, bool positionsOnly);

}  // namespace tessera
