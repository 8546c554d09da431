// Cuts a chunk's units into pieces that a buffer holds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh_shared.h"
#include "tessera/mesh_sink.h"

namespace tessera {

struct PieceUnits {
    std::uint64_t firstUnit = 0;    // of the chunk
    std::uint64_t firstVertex = 0;  // of the first unit, in the chunk
    std::uint64_t firstTriangle = 0;
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
    std::vector<MeshUnit> units;  // patches count from the chunk's first
};

// Walks over the units of a chunk's patterns, piece by piece.
class PieceCutter {
public:
    // `offsets` has one more than `patterns`; both stay until the end.
    PieceCutter(std::span<const mesh_pattern> patterns, std::span<const mesh_offset> offsets) : patterns_(patterns), offsets_(offsets) {}

    // The next units of `roomVertices` vertices at most, or a single one. Returns false where there are no more.
    [[nodiscard]] bool next(std::uint64_t roomVertices, PieceUnits& piece);

private:
    std::span<const mesh_pattern> patterns_;
    std::span<const mesh_offset> offsets_;
    std::uint32_t patch_ = 0;
    std::uint32_t unit_ = 0;  // of the patch
};

}  // namespace tessera
