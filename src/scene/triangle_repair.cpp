// Triangle soup made a mesh. Sorting rather than hashing all through: no input, however made, is slow, and the outcome has one order.
#include "scene/triangle_repair.h"

#include "scene/text.h"
#include "tessera/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

namespace tessera {

namespace {

constexpr float kLargestCoordinate = 1e9F;
constexpr std::size_t kMostTriangles = std::numeric_limits<std::int32_t>::max();
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Written so that NaN fails.
bool isPosition(const glm::vec3& p) {
    return std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate && std::abs(p.z) <= kLargestCoordinate;
}

void checkSizes(const TriangleMesh& mesh) {
    const std::string where = "mesh " + quotedName(mesh.name) + ": ";
    if (mesh.triangles.size() > kMostTriangles) {
        throw Error(where + std::to_string(mesh.triangles.size()) + " triangles are more than the 2147483647 of a mesh; split it");
    }
    if (!mesh.normals.empty() && mesh.normals.size() != mesh.triangles.size()) {
        throw Error(where + std::to_string(mesh.normals.size()) + " triples of normals for " + std::to_string(mesh.triangles.size()) +
                    " triangles; give one a triangle, or none");
    }
}

// Triangles whose corners are there and finite, with their normals.
void keepUsable(const TriangleMesh& mesh, RepairedTriangles& kept, TriangleRepairs& repairs) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::array<std::uint32_t, 3>& corners = mesh.triangles[t];
        if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t corner) { return corner >= mesh.positions.size(); })) {
            ++repairs.droppedBadIndex;
            continue;
        }
        if (!std::all_of(corners.begin(), corners.end(), [&](std::uint32_t corner) { return isPosition(mesh.positions[corner]); })) {
            ++repairs.droppedNotFinite;
            continue;
        }
        kept.corners.push_back(corners);
        if (!mesh.normals.empty()) kept.normals.push_back(mesh.normals[t]);
    }
}

// Gives the triangles positions that are all different and in order; those that no triangle has are left out.
void weldPositions(const TriangleMesh& mesh, RepairedTriangles& kept, TriangleRepairs& repairs) {
    struct Placed {
        glm::vec3 position;
        std::uint32_t index;
    };
    std::vector<std::uint32_t> renumbered(mesh.positions.size(), kNone);
    std::vector<Placed> used;
    for (const std::array<std::uint32_t, 3>& corners : kept.corners) {
        for (const std::uint32_t corner : corners) {
            // Seen now, numbered below. Adding 0 makes negative zeros positive: equal positions are then equal to the bit.
            if (std::exchange(renumbered[corner], 0) == kNone) used.push_back({mesh.positions[corner] + 0.0F, corner});
        }
    }
    const auto key = [](const Placed& placed) { return std::tie(placed.position.x, placed.position.y, placed.position.z); };
    std::sort(used.begin(), used.end(), [&](const Placed& a, const Placed& b) { return key(a) < key(b); });
    for (const Placed& placed : used) {
        if (kept.positions.empty() || kept.positions.back() != placed.position) kept.positions.push_back(placed.position);
        renumbered[placed.index] = static_cast<std::uint32_t>(kept.positions.size() - 1);
    }
    repairs.weldedPositions += used.size() - kept.positions.size();
    for (std::array<std::uint32_t, 3>& corners : kept.corners) {
        for (std::uint32_t& corner : corners) corner = renumbered[corner];
    }
}

// Leaves out the triangles that `dropped` marks.
void removeMarked(RepairedTriangles& kept, const std::vector<bool>& dropped) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < kept.corners.size(); ++t) {
        if (dropped[t]) continue;
        kept.corners[count] = kept.corners[t];
        if (!kept.normals.empty()) kept.normals[count] = kept.normals[t];
        ++count;
    }
    kept.corners.resize(count);
    if (!kept.normals.empty()) kept.normals.resize(count);
}

// Without a triangle that has two corners in one place its neighbours meet along the edge that is left.
void dropDegenerate(RepairedTriangles& kept, TriangleRepairs& repairs) {
    std::vector<bool> dropped(kept.corners.size());
    for (std::size_t t = 0; t < kept.corners.size(); ++t) {
        const auto [a, b, c] = kept.corners[t];
        dropped[t] = a == b || b == c || c == a;
        repairs.droppedDegenerate += dropped[t] ? 1U : 0U;
    }
    removeMarked(kept, dropped);
}

// Of triangles with the same corners, whichever way round, the first is kept.
void dropDuplicates(RepairedTriangles& kept, TriangleRepairs& repairs) {
    std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> ordered;
    ordered.reserve(kept.corners.size());
    for (std::size_t t = 0; t < kept.corners.size(); ++t) {
        std::array<std::uint32_t, 3> corners = kept.corners[t];
        std::sort(corners.begin(), corners.end());
        ordered.emplace_back(corners, static_cast<std::uint32_t>(t));
    }
    std::sort(ordered.begin(), ordered.end());
    std::vector<bool> dropped(kept.corners.size());
    for (std::size_t i = 1; i < ordered.size(); ++i) {
        if (ordered[i].first != ordered[i - 1].first) continue;
        dropped[ordered[i].second] = true;
        ++repairs.droppedDuplicates;
    }
    removeMarked(kept, dropped);
}

void findEdges(RepairedTriangles& kept) {
    kept.halfEdges.reserve(kept.corners.size() * 3);
    for (std::size_t t = 0; t < kept.corners.size(); ++t) {
        for (std::uint32_t side = 0; side < 3; ++side) {
            const auto [low, high] = std::minmax(kept.corners[t][side], kept.corners[t][(side + 1) % 3]);
            kept.halfEdges.push_back({low, high, static_cast<std::uint32_t>(t), side});
        }
    }
    std::sort(kept.halfEdges.begin(), kept.halfEdges.end(), [](const HalfEdge& a, const HalfEdge& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
}

bool forward(const RepairedTriangles& triangles, const HalfEdge& half) { return triangles.corners[half.triangle][half.side] == half.low; }

// What lies across a triangle's side.
struct Neighbour {
    std::uint32_t triangle = kNone;
    bool disagrees = false;  // both go along the edge the same way
};

std::vector<std::array<Neighbour, 3>> findNeighbours(const RepairedTriangles& triangles) {
    std::vector<std::array<Neighbour, 3>> neighbours(triangles.corners.size());
    forEachEdge(triangles.halfEdges, [&](std::span<const HalfEdge> edge) {
        if (edge.size() != 2) return;
        const bool disagrees = forward(triangles, edge[0]) == forward(triangles, edge[1]);
        neighbours[edge[0].triangle][edge[0].side] = {edge[1].triangle, disagrees};
        neighbours[edge[1].triangle][edge[1].side] = {edge[0].triangle, disagrees};
    });
    return neighbours;
}

// Which triangles to turn, found by a flood over edges of two triangles.
std::vector<bool> chooseTurned(const std::vector<std::array<Neighbour, 3>>& neighbours) {
    std::vector<bool> turned(neighbours.size());
    std::vector<bool> reached(neighbours.size());
    std::vector<std::uint32_t> piece;  // the connected piece, and the flood's queue
    for (std::size_t seed = 0; seed < neighbours.size(); ++seed) {
        if (reached[seed]) continue;
        reached[seed] = true;
        piece.assign(1, static_cast<std::uint32_t>(seed));
        std::size_t turnedHere = 0;
        for (std::size_t next = 0; next < piece.size(); ++next) {
            const std::uint32_t here = piece[next];
            turnedHere += turned[here] ? 1U : 0U;
            for (const Neighbour& neighbour : neighbours[here]) {
                if (neighbour.triangle == kNone || reached[neighbour.triangle]) continue;
                reached[neighbour.triangle] = true;
                turned[neighbour.triangle] = turned[here] != neighbour.disagrees;
                piece.push_back(neighbour.triangle);
            }
        }
        if (turnedHere <= piece.size() / 2) continue;
        for (const std::uint32_t triangle : piece) turned[triangle] = !turned[triangle];
    }
    return turned;
}

void turn(RepairedTriangles& kept, std::size_t triangle) {
    std::swap(kept.corners[triangle][1], kept.corners[triangle][2]);
    if (kept.normals.empty()) return;
    std::array<glm::vec3, 3>& normals = kept.normals[triangle];
    std::swap(normals[1], normals[2]);
    const glm::dvec3 sum = glm::dvec3(normals[0]) + glm::dvec3(normals[1]) + glm::dvec3(normals[2]);
    if (glm::dot(sum, areaVector(kept, triangle)) >= 0.0) return;
    for (glm::vec3& normal : normals) normal = -normal;
}

void orient(RepairedTriangles& kept, TriangleRepairs& repairs) {
    const std::vector<bool> turned = chooseTurned(findNeighbours(kept));
    for (std::size_t t = 0; t < turned.size(); ++t) {
        if (!turned[t]) continue;
        turn(kept, t);
        ++repairs.flippedTriangles;
    }
    // The other way round, sides 0 and 2 have changed places.
    for (HalfEdge& half : kept.halfEdges) half.side = turned[half.triangle] ? 2 - half.side : half.side;
}

void countEdges(const RepairedTriangles& kept, TriangleRepairs& repairs) {
    forEachEdge(kept.halfEdges, [&](std::span<const HalfEdge> edge) {
        repairs.boundaryEdges += edge.size() == 1 ? 1U : 0U;
        repairs.nonManifoldEdges += edge.size() > 2 ? 1U : 0U;
        repairs.unorientedEdges += edge.size() == 2 && forward(kept, edge[0]) == forward(kept, edge[1]) ? 1U : 0U;
    });
}

void requireArea(const TriangleMesh& mesh, const RepairedTriangles& kept) {
    for (std::size_t t = 0; t < kept.corners.size(); ++t) {
        if (areaVector(kept, t) != glm::dvec3(0.0)) return;
    }
    throw Error("mesh " + quotedName(mesh.name) + ": none of its " + std::to_string(mesh.triangles.size()) +
                " triangles has three finite corners and an area; repair or remove it");
}

}  // namespace

glm::dvec3 areaVector(const RepairedTriangles& triangles, std::size_t triangle) {
    const auto [a, b, c] = triangles.corners[triangle];
    const glm::dvec3 origin(triangles.positions[a]);
    return glm::cross(glm::dvec3(triangles.positions[b]) - origin, glm::dvec3(triangles.positions[c]) - origin);
}

RepairedTriangles repairTriangles(const TriangleMesh& mesh, TriangleRepairs& repairs) {
    checkSizes(mesh);
    RepairedTriangles kept;
    keepUsable(mesh, kept, repairs);
    weldPositions(mesh, kept, repairs);
    dropDegenerate(kept, repairs);
    dropDuplicates(kept, repairs);
    requireArea(mesh, kept);
    findEdges(kept);
    orient(kept, repairs);
    countEdges(kept, repairs);
    return kept;
}

}  // namespace tessera
