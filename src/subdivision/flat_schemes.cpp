// Bilinear surfaces, and polygons drawn as triangles.
#include "subdivision/flat_schemes.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "subdivision/clean_cage_parts.h"
#include "subdivision/corner_sets.h"
#include "subdivision/triangulate.h"

namespace tessera::subdivision {

namespace {

// What a domain's corners have, of what a face's corners have: `at` tells it of one of `size`.
template <typename Value, typename At>
std::array<Value, 4> domainCorners(const QuadDomain& domain, int size, At at) {
    if (domain.subFace < 0) return {at(0), at(1), at(2), at(3)};
    const int corner = domain.subFace;
    const Value here = at(corner), next = at((corner + 1) % size), last = at((corner + size - 1) % size);
    Value middle(0.0);
    for (int k = 0; k < size; ++k) middle += at(k);
    return {here, (here + next) / 2.0, middle / static_cast<double>(size), (here + last) / 2.0};
}

// The bicubic net of a bilinear quadrilateral of corners (0, 0), (1, 0), (1, 1), (0, 1). A third of a way is one rounding of a sum that is
// the same from either end.
template <typename Value, typename Net>
void writeNet(const std::array<Value, 4>& corners, Net& net) {
    const auto between = [](const Value& a, const Value& b, std::size_t thirds) {
        if (thirds == 0) return a;
        if (thirds == 3) return b;
        return (static_cast<double>(3 - thirds) * a + static_cast<double>(thirds) * b) / 3.0;
    };
    for (std::size_t v = 0; v < 4; ++v) {
        const Value start = between(corners[0], corners[3], v), end = between(corners[1], corners[2], v);
        for (std::size_t u = 0; u < 4; ++u) net[4 * v + u] = between(start, end, u);
    }
}

double angleAt(const glm::dvec3& here, const glm::dvec3& next, const glm::dvec3& last) {
    return std::atan2(glm::length(glm::cross(next - here, last - here)), glm::dot(next - here, last - here));
}

// Corners that share a normal.
CornerSets smoothFans(const Cage& cage, const CageFaces& faces) {
    CornerSets fans(faces.vertices.size());
    std::vector<bool> sharp(cage.points.size());
    for (const Corner& corner : cage.corners) sharp[corner.vertex] = true;
    const std::vector<CageSide> sides = cageSides(faces);
    auto crease = cage.creases.begin();  // sorted as sides are
    forEachCageEdge(sides, [&](std::span<const CageSide> edge) {
        const auto place = std::pair(edge[0].low, edge[0].high);
        while (crease != cage.creases.end() && std::pair(crease->a, crease->b) < place) ++crease;
        const bool creased = crease != cage.creases.end() && std::pair(crease->a, crease->b) == place;
        if (creased || edge.size() != 2) return;
        for (std::size_t one = 0; one < 2; ++one) {
            const std::uint32_t start = edge[one].corner, end = faces.next(edge[1 - one].face, edge[1 - one].corner);
            if (!sharp[faces.vertices[start]]) fans.join(start, end);
        }
    });
    return fans;
}

std::vector<glm::vec3> cornerNormals(const Cage& cage, const CageFaces& faces) {
    CornerSets fans = smoothFans(cage, faces);
    std::vector<glm::dvec3> sums(faces.vertices.size(), glm::dvec3(0.0));
    const auto place = [&](std::uint32_t corner) { return glm::dvec3(cage.points[faces.vertices[corner]]); };
    for (std::size_t face = 0; face < faces.count(); ++face) {
        const glm::dvec3 normal = newellNormal(cage, faces.starts[face], faces.size(face));
        const double length = glm::length(normal);
        if (length == 0.0) continue;
        std::uint32_t last = faces.starts[face + 1] - 1;
        for (std::uint32_t corner = faces.starts[face]; corner < faces.starts[face + 1]; last = corner++) {
            sums[fans.find(corner)] += normal * (angleAt(place(corner), place(faces.next(face, corner)), place(last)) / length);
        }
    }
    std::vector<glm::vec3> normals;
    for (std::uint32_t corner = 0; corner < faces.vertices.size(); ++corner) {
        const glm::dvec3& sum = sums[fans.find(corner)];
        const double length = glm::length(sum);
        // Sums that are rounding errors of normals that cancel have no direction; pnMesh() finds one.
        normals.push_back(length > 1e-9 ? glm::vec3(sum / length) + 0.0F : glm::vec3(0.0F));
    }
    return normals;
}

}  // namespace

std::vector<Cell> bilinearCells(const Refiner& refiner, std::span<const glm::vec3> points, std::span<const glm::vec2> textures,
                                const QuadDomains& domains) {
    const auto& level = refiner.GetLevel(0);
    std::vector<Cell> cells;
    cells.reserve(domains.domains.size());
    for (std::uint32_t d = 0; d < domains.domains.size(); ++d) {
        const QuadDomain& domain = domains.domains[d];
        const auto vertices = level.GetFaceVertices(static_cast<int>(domain.face));
        Cell& cell = cells.emplace_back();
        cell.domain = d;
        writeNet(domainCorners<glm::dvec3>(domain, vertices.size(),
                                           [&](int k) { return glm::dvec3(points[static_cast<std::size_t>(vertices[k])]); }),
                 cell.points);
        if (textures.empty()) continue;
        const auto values = level.GetFaceFVarValues(static_cast<int>(domain.face));
        writeNet(domainCorners<glm::dvec2>(domain, values.size(),
                                           [&](int k) { return glm::dvec2(textures[static_cast<std::size_t>(values[k])]); }),
                 cell.texture);
    }
    return cells;
}

CageTriangles polygonTriangles(const Cage& cage, CageReport& report) {
    const CageFaces faces = facesOf(cage);
    const std::vector<glm::vec3> normals = cornerNormals(cage, faces);
    std::vector<bool> isHole(cage.faceCount());
    for (const std::uint32_t hole : cage.holes) isHole[hole] = true;
    CageTriangles made;
    made.mesh.name = cage.name;
    made.mesh.positions = cage.points;
    for (const CornerTriangle& triangle : cornerTriangles(cage, report)) {
        if (isHole[triangle.face]) continue;
        const auto [a, b, c] = triangle.corners;
        made.mesh.triangles.push_back({cage.faceVertices[a], cage.faceVertices[b], cage.faceVertices[c]});
        made.mesh.normals.push_back({normals[a], normals[b], normals[c]});
        if (cage.texturePoints.empty()) continue;
        const auto texture = [&](std::uint32_t corner) { return cage.texturePoints[cage.faceTexturePoints[corner]]; };
        made.textures.push_back({texture(a), texture(b), texture(c)});
    }
    return made;
}

}  // namespace tessera::subdivision
