// Triangle soup made a mesh: positions welded, bad triangles left out, neighbours found and turned the same way.
#pragma once

#include "tessera/triangles.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tessera {

// One triangle's side `side`, from its corner `side` to the next.
struct HalfEdge {
    std::uint32_t low = 0;  // the ends, low < high
    std::uint32_t high = 0;
    std::uint32_t triangle = 0;
    std::uint32_t side = 0;

    // Whether two of them are of the same edge.
    [[nodiscard]] bool sameEdge(const HalfEdge& other) const { return low == other.low && high == other.high; }
};

struct RepairedTriangles {
    // All different, rising by x, then y, then z: an edge's direction from low to high is the same in every mesh that has it.
    std::vector<glm::vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> corners;  // three different positions a triangle
    std::vector<std::array<glm::vec3, 3>> normals;      // as given, where any are
    std::vector<HalfEdge> halfEdges;                    // those of an edge follow each other, by triangle
};

// Drops what cannot be drawn, counts it in `repairs`, and turns triangles so that neighbours agree: the greater part of each connected
// piece keeps its side. Normals of turned triangles that point to the old front are turned too. Throws Error naming the mesh when no
// triangle with an area is left, there are more than 2^31 - 1, or normals do not go with the triangles.
[[nodiscard]] RepairedTriangles repairTriangles(const TriangleMesh& mesh, TriangleRepairs& repairs);

// Calls visit(span of half-edges) for every edge.
template <typename Visit>
void forEachEdge(std::span<const HalfEdge> halfEdges, Visit visit) {
    for (std::size_t first = 0; first < halfEdges.size();) {
        std::size_t end = first + 1;
        while (end < halfEdges.size() && halfEdges[end].sameEdge(halfEdges[first])) ++end;
        visit(halfEdges.subspan(first, end - first));
        first = end;
    }
}

// Normal to a triangle in double precision, of twice its area's length; zero where the corners lie on a line.
[[nodiscard]] glm::dvec3 areaVector(const RepairedTriangles& triangles, std::size_t triangle);

}  // namespace tessera
