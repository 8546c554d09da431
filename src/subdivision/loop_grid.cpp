// Points of a triangle cage's faces.
#include "subdivision/loop_grid.h"

namespace tessera::subdivision {

LoopGrid::LoopGrid(const Refiner& refiner, std::uint32_t level)
    : level_(&refiner.GetLevel(0)),
      size_(1U << level),
      fans_(static_cast<std::size_t>(3 * level_->GetNumFaces())),
      torn_(static_cast<std::size_t>(level_->GetNumVertices())) {
    for (int vertex = 0; vertex < level_->GetNumVertices(); ++vertex) {
        int sharpEdges = 0;
        for (const int edge : level_->GetVertexEdges(vertex)) sharpEdges += isSharp(edge) ? 1 : 0;
        torn_[static_cast<std::size_t>(vertex)] = level_->IsVertexInfSharp(vertex) || sharpEdges > 2;
    }
    for (int edge = 0; edge < level_->GetNumEdges(); ++edge) {
        const auto faces = level_->GetEdgeFaces(edge);
        if (isSharp(edge) || faces.size() != 2) continue;
        const auto sides = level_->GetEdgeFaceLocalIndices(edge);
        for (int one = 0; one < 2; ++one) {
            // The one's start is the other's end.
            fans_.join(static_cast<std::uint32_t>(3 * faces[one] + sides[one]),
                       static_cast<std::uint32_t>(3 * faces[1 - one] + (sides[1 - one] + 1) % 3));
        }
    }
}

bool LoopGrid::isSharp(int edge) const { return level_->IsEdgeInfSharp(edge) || level_->IsEdgeBoundary(edge); }

std::uint32_t LoopGrid::points() const {
    const auto vertices = static_cast<std::uint32_t>(level_->GetNumVertices()), edges = static_cast<std::uint32_t>(level_->GetNumEdges());
    return vertices + edges * (size_ - 1) + static_cast<std::uint32_t>(level_->GetNumFaces()) * ((size_ - 1) * (size_ - 2) / 2);
}

LoopGrid::Border LoopGrid::border(std::uint32_t i, std::uint32_t j) const {
    if (i + j == 0) return {0, -1, 0};
    if (i == size_) return {1, -1, 0};
    if (j == size_) return {2, -1, 0};
    if (j == 0) return {-1, 0, i};
    if (i + j == size_) return {-1, 1, j};
    if (i == 0) return {-1, 2, size_ - j};
    return {};
}

std::uint32_t LoopGrid::point(int face, std::uint32_t i, std::uint32_t j) const {
    const Border at = border(i, j);
    const auto vertices = level_->GetFaceVertices(face);
    if (at.corner >= 0) return static_cast<std::uint32_t>(vertices[at.corner]);
    const auto numbers = static_cast<std::uint32_t>(level_->GetNumVertices());
    if (at.side >= 0) {
        const int edge = level_->GetFaceEdges(face)[at.side];
        const bool along = level_->GetEdgeVertices(edge)[0] == vertices[at.side];
        return numbers + static_cast<std::uint32_t>(edge) * (size_ - 1) + (along ? at.step : size_ - at.step) - 1;
    }
    // Row after row: row j has size - 1 - j inner points.
    const std::uint32_t inner = (j - 1) * (size_ - 1) - (j - 1) * j / 2 + i - 1;
    return numbers + static_cast<std::uint32_t>(level_->GetNumEdges()) * (size_ - 1) +
           static_cast<std::uint32_t>(face) * ((size_ - 1) * (size_ - 2) / 2) + inner;
}

bool LoopGrid::ownsNormal(int face, std::uint32_t i, std::uint32_t j) const {
    const Border at = border(i, j);
    if (at.corner >= 0) return torn_[static_cast<std::size_t>(level_->GetFaceVertices(face)[at.corner])];
    return at.side >= 0 && isSharp(level_->GetFaceEdges(face)[at.side]);
}

std::uint32_t LoopGrid::normalSlot(int face, std::uint32_t i, std::uint32_t j) {
    const Border at = border(i, j);
    if (at.corner < 0) return point(face, i, j);
    return points() + fans_.find(static_cast<std::uint32_t>(3 * face + at.corner));
}

}  // namespace tessera::subdivision
