// Triangles to PN patches: the control points of an edge are computed once, for all triangles that share it.
#include "scene/triangle_normals.h"
#include "scene/triangle_repair.h"
#include "tessera/triangles.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace tessera {

namespace {

constexpr std::size_t kPoints = pointsPerPatch(PatchKind::pn);
constexpr double kLargestCoordinate = 1e9;

// Where a patch keeps what belongs to its corners and sides (PatchKind::pn, scene.h).
constexpr std::array<std::size_t, 3> kCorner{0, 3, 9};
constexpr std::array<std::size_t, 3> kCornerNormal{10, 12, 15};
constexpr std::array<std::array<std::size_t, 2>, 3> kSide{{{1, 2}, {6, 8}, {7, 4}}};  // side k: nearer its corner k, nearer the next
constexpr std::array<std::size_t, 3> kSideNormal{11, 14, 13};
constexpr std::size_t kCentre = 5;

// Single precision, inside what a scene may hold, and no negative zeros: equal points are equal to the bit.
glm::vec3 rounded(const glm::dvec3& point) {
    return glm::vec3(glm::clamp(point, glm::dvec3(-kLargestCoordinate), glm::dvec3(kLargestCoordinate))) + 0.0F;
}

// The inner control point next to `end` of the edge to `other`: the edge's third, in the plane square to `normal` at `end`.
glm::dvec3 innerPoint(const glm::dvec3& end, const glm::dvec3& other, const glm::dvec3& normal) {
    return (2.0 * end + other - glm::dot(other - end, normal) * normal) / 3.0;
}

// The mean of both normals, mirrored in the plane that halves the edge, so that the normal follows the curve's bends.
glm::dvec3 middleNormal(const glm::dvec3& along, const glm::dvec3& first, const glm::dvec3& second, const glm::dvec3& face) {
    const glm::dvec3 sum = first + second;
    const glm::dvec3 mirrored = sum - (2.0 * glm::dot(along, sum) / glm::dot(along, along)) * along;
    const double length = glm::length(mirrored);
    return length > 1e-9 ? mirrored / length : face;
}

// Writes the patches of one mesh.
class PatchWriter {
public:
    PatchWriter(const RepairedTriangles& triangles, const TriangleNormals& normals, bool flat, std::span<glm::vec3> points)
        : triangles_(triangles), normals_(normals), flat_(flat), points_(points) {}

    void writeCorners(std::size_t t) const {
        for (std::size_t k = 0; k < 3; ++k) {
            points_[t * kPoints + kCorner[k]] = triangles_.positions[triangles_.corners[t][k]];
            points_[t * kPoints + kCornerNormal[k]] = rounded(normals_.corners[t][k]);
        }
    }

    // The inner points of one edge for all its users, the mean of theirs where normals differ.
    void writeEdge(std::span<const HalfEdge> users) const {
        const glm::dvec3 low(triangles_.positions[users.front().low]);
        const glm::dvec3 high(triangles_.positions[users.front().high]);
        glm::dvec3 nearLow(0.0);
        glm::dvec3 nearHigh(0.0);
        for (const HalfEdge& user : users) {
            nearLow += innerPoint(low, high, flat_ ? glm::dvec3(0.0) : normalAt(user, user.low));
            nearHigh += innerPoint(high, low, flat_ ? glm::dvec3(0.0) : normalAt(user, user.high));
        }
        const auto count = static_cast<double>(users.size());
        const std::array<glm::vec3, 2> inner{rounded(nearLow / count), rounded(nearHigh / count)};
        for (const HalfEdge& user : users) {
            const std::size_t first = triangles_.corners[user.triangle][user.side] == user.low ? 0 : 1;
            glm::vec3* patch = &points_[user.triangle * kPoints];
            patch[kSide[user.side][0]] = inner[first];
            patch[kSide[user.side][1]] = inner[1 - first];
            patch[kSideNormal[user.side]] =
                rounded(middleNormal(high - low, normalAt(user, user.low), normalAt(user, user.high), normals_.face[user.triangle]));
        }
    }

    // The centre lies beyond the edges' points by half of what they lie beyond the corners.
    void writeCentre(std::size_t t) const {
        const std::span<glm::vec3> patch = points_.subspan(t * kPoints, kPoints);
        glm::dvec3 corners(0.0);
        glm::dvec3 edges(0.0);
        for (std::size_t k = 0; k < 3; ++k) {
            corners += glm::dvec3(patch[kCorner[k]]);
            edges += glm::dvec3(patch[kSide[k][0]]) + glm::dvec3(patch[kSide[k][1]]);
        }
        patch[kCentre] = rounded(edges / 6.0 + (edges / 6.0 - corners / 3.0) / 2.0);
    }

private:
    [[nodiscard]] glm::dvec3 normalAt(const HalfEdge& user, std::uint32_t end) const {
        const std::size_t atStart = triangles_.corners[user.triangle][user.side] == end ? 0 : 1;
        return normals_.corners[user.triangle][(user.side + atStart) % 3];
    }

    const RepairedTriangles& triangles_;
    const TriangleNormals& normals_;
    bool flat_;
    std::span<glm::vec3> points_;
};

}  // namespace

Mesh pnMesh(const TriangleMesh& triangles, bool flat, TriangleRepairs* repairs) {
    TriangleRepairs counted;
    const RepairedTriangles repaired = repairTriangles(triangles, counted);
    const TriangleNormals normals = triangleNormals(repaired, flat);
    counted.computedNormals = normals.computed;
    Mesh mesh;
    mesh.name = triangles.name;
    mesh.kind = PatchKind::pn;
    mesh.points.resize(repaired.corners.size() * kPoints);
    const PatchWriter writer(repaired, normals, flat, mesh.points);
    for (std::size_t t = 0; t < repaired.corners.size(); ++t) writer.writeCorners(t);
    forEachEdge(repaired.halfEdges, [&](std::span<const HalfEdge> users) { writer.writeEdge(users); });
    for (std::size_t t = 0; t < repaired.corners.size(); ++t) writer.writeCentre(t);
    if (repairs != nullptr) *repairs = counted;
    return mesh;
}

}  // namespace tessera
