// PN triangles with texture coordinates.
#include "subdivision/pn_cage.h"

#include <algorithm>
#include <cstddef>

namespace tessera::subdivision {

namespace {

std::array<glm::vec3, 3> cornersOf(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
    return {mesh.positions[triangle[0]], mesh.positions[triangle[1]], mesh.positions[triangle[2]]};
}

bool hasArea(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
    const auto [a, b, c] = cornersOf(mesh, triangle);
    return glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a)) != glm::dvec3(0.0);
}

// pnMesh() leaves triangles out but keeps the order of the others: each patch is of the next triangle with its corners.
void findSources(const TriangleMesh& triangles, PnCage& made) {
    std::uint32_t source = 0;
    for (std::size_t patch = 0; patch < made.mesh.patchCount(); ++patch, ++source) {
        const glm::vec3* points = &made.mesh.points[patch * pointsPerPatch(PatchKind::pn)];
        for (;; ++source) {
            const auto [a, b, c] = cornersOf(triangles, triangles.triangles[source]);
            if (a != points[0] || !((b == points[3] && c == points[9]) || (b == points[9] && c == points[3]))) continue;
            made.turned.push_back(b != points[3]);
            break;
        }
        made.sources.push_back(source);
    }
}

// Linear over the triangle.
void addNet(const std::array<glm::vec2, 3>& values, bool turned, std::vector<glm::vec2>& nets) {
    const glm::dvec2 a(values[0]), b(values[turned ? 2 : 1]), c(values[turned ? 1 : 2]);
    for (int v = 0; v < 4; ++v) {
        for (int u = 0; u < 4; ++u) nets.emplace_back((static_cast<double>(3 - u - v) * a + double(u) * b + double(v) * c) / 3.0);
    }
}

}  // namespace

std::optional<PnCage> pnCage(const CageTriangles& triangles) {
    const TriangleMesh& mesh = triangles.mesh;
    if (std::none_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) { return hasArea(mesh, triangle); })) {
        return std::nullopt;
    }
    PnCage made;
    made.mesh = pnMesh(mesh, false);
    findSources(mesh, made);
    if (!triangles.textures.empty()) {
        for (std::size_t p = 0; p < made.sources.size(); ++p)
            addNet(triangles.textures[made.sources[p]], made.turned[p], made.mesh.textureNets);
    }
    return made;
}

}  // namespace tessera::subdivision
