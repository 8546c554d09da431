// Pieces end between units, of which the host knows the sizes by pattern.h.
#include "mesh/mesh_pieces.h"

#include "mesh/pattern.h"

namespace tessera {

bool PieceCutter::next(std::uint64_t roomVertices, PieceUnits& piece) {
    piece.units.clear();
    piece.vertices = 0;
    piece.triangles = 0;
    for (; patch_ < patterns_.size(); ++patch_, unit_ = 0) {
        const mesh_pattern& pattern = patterns_[patch_];
        const mesh_offset& first = offsets_[patch_];
        const std::uint32_t units = patternUnits(pattern);
        mesh_offset before = unitsBefore(pattern, unit_);
        for (; unit_ < units; ++unit_) {
            const mesh_offset behind = unitsBefore(pattern, unit_ + 1);
            const std::uint64_t vertices = behind.vertices - before.vertices, triangles = behind.triangles - before.triangles;
            if (!piece.units.empty() && piece.vertices + vertices > roomVertices) return true;
            if (piece.units.empty()) {
                piece.firstUnit = first.units + unit_;
                piece.firstVertex = first.vertices + before.vertices;
                piece.firstTriangle = first.triangles + before.triangles;
            }
            piece.units.push_back({patch_, unit_, piece.vertices, vertices, piece.triangles, triangles});
            piece.vertices += vertices;
            piece.triangles += triangles;
            before = behind;
        }
    }
    return !piece.units.empty();
}

}  // namespace tessera
