// Refining a cage around one of its points, one level after the other: all that the surface around the point depends on are the faces that
// touch a face at the point. Points are what OpenSubdiv's refiners take: with Clear() and AddWithWeight(point, weight).
#pragma once

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyLevel.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "subdivision/refiner.h"

namespace tessera::subdivision {

// A piece of a refined cage, and the faces of it that are looked at.
template <typename Point>
struct Neighbourhood {
    Cage cage;  // its points are only counted
    std::vector<Point> points;
    std::vector<int> faces;
    int vertex = -1;  // that all of the faces have; none at first, around a face's middle
};

template <typename Point>
class Gatherer {
public:
    Gatherer(const OpenSubdiv::Far::TopologyLevel& level, std::span<const Point> points) : level_(level), points_(points) {
        // What is sharp at boundaries is so by its own tags from the first level on.
        made_.cage.boundary = BoundaryRule::edgeOnly;
    }

    // The faces that touch one of `faces`, these first. `vertex` is of one of them, or -1.
    Neighbourhood<Point> gather(std::span<const int> faces, int vertex) {
        for (const int face : faces) made_.faces.push_back(addFace(face));
        for (const int face : faces) {
            for (const int corner : list(level_.GetFaceVertices(face))) {
                for (const int other : list(level_.GetVertexFaces(corner))) addFace(other);
            }
        }
        addTags();
        if (vertex >= 0) made_.vertex = static_cast<int>(vertices_.at(vertex));
        return std::move(made_);
    }

private:
    static std::span<const int> list(const OpenSubdiv::Far::ConstIndexArray& array) {
        return {array.begin(), static_cast<std::size_t>(array.size())};
    }

    int addFace(int face) {
        const auto [known, isNew] = faces_.try_emplace(face, static_cast<int>(made_.cage.faceSizes.size()));
        if (!isNew) return known->second;
        const std::span<const int> corners = list(level_.GetFaceVertices(face));
        made_.cage.faceSizes.push_back(static_cast<std::uint32_t>(corners.size()));
        for (const int vertex : corners) made_.cage.faceVertices.push_back(addVertex(vertex));
        for (const int edge : list(level_.GetFaceEdges(face))) edges_.push_back(edge);
        return known->second;
    }

    std::uint32_t addVertex(int vertex) {
        const auto [known, isNew] = vertices_.try_emplace(vertex, static_cast<std::uint32_t>(made_.points.size()));
        if (!isNew) return known->second;
        made_.points.push_back(points_[static_cast<std::size_t>(vertex)]);
        made_.cage.points.emplace_back(0.0F);
        if (const float sharpness = level_.GetVertexSharpness(vertex); sharpness > 0.0F) {
            made_.cage.corners.push_back({known->second, sharpness});
        }
        return known->second;
    }

    void addTags() {
        std::sort(edges_.begin(), edges_.end());
        edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
        for (const int edge : edges_) {
            const std::span<const int> ends = list(level_.GetEdgeVertices(edge));
            const float sharpness = level_.GetEdgeSharpness(edge);
            if (sharpness > 0.0F) made_.cage.creases.push_back({vertices_.at(ends[0]), vertices_.at(ends[1]), sharpness});
        }
    }

    const OpenSubdiv::Far::TopologyLevel& level_;
    std::span<const Point> points_;
    Neighbourhood<Point> made_;
    std::unordered_map<int, int> faces_;
    std::unordered_map<int, std::uint32_t> vertices_;
    std::vector<int> edges_;
};

// Refines once. Of each face the child in its corner `childOf` is kept, and the vertex that these have in common.
template <typename Point>
Neighbourhood<Point> refined(const Neighbourhood<Point>& from, std::span<const int> childOf) {
    const std::unique_ptr<Refiner> refiner = makeRefiner(from.cage);
    Refiner::UniformOptions once(1);
    once.fullTopologyInLastLevel = true;
    refiner->RefineUniform(once);
    const OpenSubdiv::Far::TopologyLevel& base = refiner->GetLevel(0);
    const OpenSubdiv::Far::TopologyLevel& level = refiner->GetLevel(1);
    std::vector<Point> points(static_cast<std::size_t>(level.GetNumVertices()), from.points[0]);
    const Point* const source = from.points.data();
    Point* const target = points.data();
    OpenSubdiv::Far::PrimvarRefinerReal<double>(*refiner).Interpolate(1, source, target);
    std::vector<int> children;
    children.reserve(childOf.size());
    for (std::size_t k = 0; k < childOf.size(); ++k) {
        children.push_back(base.GetFaceChildFaces(from.faces[std::min(k, from.faces.size() - 1)])[childOf[k]]);
    }
    const int vertex = from.vertex >= 0 ? base.GetVertexChildVertex(from.vertex) : base.GetFaceChildVertex(from.faces[0]);
    return Gatherer<Point>(level, points).gather(children, vertex);
}

// The number of the common vertex among the corners of the k-th face.
template <typename Point>
int cornerOf(const Neighbourhood<Point>& piece, std::size_t k) {
    std::size_t first = 0;
    const auto face = static_cast<std::size_t>(piece.faces[k]);
    for (std::size_t before = 0; before < face; ++before) first += piece.cage.faceSizes[before];
    int corner = 0;
    while (piece.cage.faceVertices[first + static_cast<std::size_t>(corner)] != static_cast<std::uint32_t>(piece.vertex)) ++corner;
    return corner;
}

}  // namespace tessera::subdivision
