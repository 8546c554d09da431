// Turns a mesh into what chunks are gathered from.
#include "surface/source_mesh.h"

#include <algorithm>
#include <limits>

namespace tessera {
namespace {

constexpr std::size_t rationalFloats = 4 * 16 + 4 * 3;  // homogeneous points, then the corners

void append(std::vector<float>& floats, const glm::vec3& p) { floats.insert(floats.end(), {p.x, p.y, p.z}); }

void appendHomogeneous(std::vector<float>& floats, const glm::vec3& p, float w) {
    append(floats, w * p);
    floats.push_back(w);
}

std::vector<float> floatsOf(const Mesh& mesh, std::size_t floatsEach) {
    std::vector<float> floats;
    floats.reserve(mesh.patchCount() * floatsEach);
    if (mesh.kind != PatchKind::rational) {
        for (const glm::vec3& point : mesh.points) append(floats, point);
        return floats;
    }
    for (std::size_t patch = 0; patch < mesh.patchCount(); ++patch) {
        for (std::size_t k = 16 * patch; k < 16 * patch + 16; ++k) appendHomogeneous(floats, mesh.points[k], mesh.weights[k]);
        for (const std::size_t corner : {0U, 3U, 12U, 15U}) append(floats, mesh.points[16 * patch + corner]);
    }
    return floats;
}

std::uint32_t degenerateSides(const Mesh& mesh, const std::array<BorderPoints, 4>& borders, std::size_t patch) {
    const glm::vec3* const points = mesh.points.data() + patch * pointsPerPatch(mesh.kind);
    std::uint32_t flags = 0;
    for (std::size_t side = 0; side < 4; ++side) {
        if (mesh.kind == PatchKind::pn && side == 2) continue;
        const BorderPoints& b = borders[side];
        const bool onePoint = std::all_of(b.begin(), b.end(), [&](std::size_t k) { return points[k] == points[b[0]]; });
        if (onePoint) flags |= SIDE_DEGENERATE << side;
    }
    return flags;
}

edge_info infoOf(const EdgeRecord& edge) {
    const bool rational = std::any_of(edge.weights.begin(), edge.weights.end(), [](float w) { return w != 1.0F; });
    return {0, 0, edge.level, edge.index, edge.reversed ? 1U : 0U, rational ? 1U : 0U, edge.cuts};
}

void include(ObjectBox& box, const glm::vec3& p) {
    for (std::size_t c = 0; c < 3; ++c) {
        const float at = p[static_cast<glm::length_t>(c)];
        box.lower[c] = std::min(box.lower[c], at);
        box.upper[c] = std::max(box.upper[c], at);
    }
}

std::vector<ObjectBox> boxesOf(const Mesh& mesh) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr ObjectBox nothing{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    std::vector<ObjectBox> boxes((mesh.patchCount() + SourceMesh::boxPatches - 1) / SourceMesh::boxPatches, nothing);
    const std::size_t each = pointsPerPatch(mesh.kind), positions = positionsPerPatch(mesh.kind);
    for (std::size_t patch = 0; patch < mesh.patchCount(); ++patch)
        for (std::size_t k = 0; k < positions; ++k) include(boxes[patch / SourceMesh::boxPatches], mesh.points[patch * each + k]);
    for (const EdgeRecord& edge : mesh.edges)
        for (const glm::vec3& point : edge.points) include(boxes[edge.patch / SourceMesh::boxPatches], point);
    return boxes;
}

}  // namespace

std::array<BorderPoints, 4> bordersOf(PatchKind kind) {
    if (kind == PatchKind::gregory) return {{{0, 4, 9, 1}, {1, 5, 10, 2}, {3, 11, 6, 2}, {0, 8, 7, 3}}};
    if (kind == PatchKind::pn) return {{{0, 1, 2, 3}, {3, 6, 8, 9}, {9, 9, 9, 9}, {0, 4, 7, 9}}};
    return {{{0, 1, 2, 3}, {3, 7, 11, 15}, {12, 13, 14, 15}, {0, 4, 8, 12}}};
}

SourceMesh::SourceMesh(const Mesh& mesh)
    : kind(mesh.kind),
      patches(static_cast<std::uint32_t>(mesh.patchCount())),
      floatsEach(static_cast<std::uint32_t>(mesh.kind == PatchKind::rational ? rationalFloats : 3 * pointsPerPatch(mesh.kind))),
      floats(floatsOf(mesh, floatsEach)),
      boxes(boxesOf(mesh)) {
    const std::array<BorderPoints, 4> borders = bordersOf(kind);
    flags.reserve(patches);
    for (std::size_t patch = 0; patch < patches; ++patch) flags.push_back(static_cast<std::uint8_t>(degenerateSides(mesh, borders, patch)));
    if (mesh.edges.empty()) return;
    firstRecord.assign(std::size_t{patches} + 1, 0);
    recordFloats.reserve(RECORD_FLOATS * mesh.edges.size());
    for (const EdgeRecord& edge : mesh.edges) {
        flags[edge.patch] = static_cast<std::uint8_t>(flags[edge.patch] | (SIDE_RECORDED << edge.side));
        ++firstRecord[edge.patch + 1];
        records.push_back(infoOf(edge));
        for (std::size_t k = 0; k < 4; ++k) appendHomogeneous(recordFloats, edge.points[k], edge.weights[k]);
    }
    for (std::size_t patch = 0; patch < patches; ++patch) firstRecord[patch + 1] += firstRecord[patch];
}

std::uint32_t SourceMesh::eyeFloatsEach() const {
    switch (kind) {
        case PatchKind::bezier:
            return BEZIER_FLOATS;
        case PatchKind::gregory:
            return GREGORY_FLOATS;
        case PatchKind::rational:
            return RATIONAL_FLOATS;
        case PatchKind::pn:
            break;
    }
    return PN_FLOATS;
}

}  // namespace tessera
