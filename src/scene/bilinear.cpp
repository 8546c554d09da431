// Bilinear quadrilaterals, degree raised to bicubic.
#include "scene/surface_numbers.h"
#include "tessera/surfaces.h"

#include <cstddef>
#include <utility>

namespace tessera {

Mesh bilinearMesh(std::string name, std::span<const std::array<glm::vec3, 4>> quads) {
    Mesh mesh;
    mesh.name = std::move(name);
    mesh.points.reserve(16 * quads.size());
    // A third of the way between two points: one rounding of a sum that is the same from either end.
    const auto between = [](const glm::dvec3& a, const glm::dvec3& b, std::size_t thirds) {
        if (thirds == 0) return a;
        if (thirds == 3) return b;
        return (static_cast<double>(3 - thirds) * a + static_cast<double>(thirds) * b) / 3.0;
    };
    for (const std::array<glm::vec3, 4>& quad : quads) {
        for (std::size_t v = 0; v < 4; ++v) {
            const glm::dvec3 start = between(quad[0], quad[3], v), end = between(quad[1], quad[2], v);
            for (std::size_t u = 0; u < 4; ++u) mesh.points.push_back(rounded(between(start, end, u)));
        }
    }
    return mesh;
}

}  // namespace tessera
