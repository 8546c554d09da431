// Texture coordinates of meshes.
#include "tessera/texture.h"

#include <array>

namespace tessera {

namespace {

std::array<double, 4> bernstein(double t) {
    const double s = 1.0 - t;
    return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

}  // namespace

glm::vec2 textureAt(const Mesh& mesh, std::size_t patch, float u, float v) {
    if (mesh.textureNets.empty()) return {u, v};
    const std::array<double, 4> across = bernstein(double{u}), up = bernstein(double{v});
    // In double precision neighbours, which may go along a border in opposite directions, agree to the last bit of a float or nearly.
    glm::dvec2 sum(0.0);
    for (std::size_t k = 0; k < 16; ++k) sum += across[k % 4] * up[k / 4] * glm::dvec2(mesh.textureNets[16 * patch + k]);
    return {static_cast<float>(sum.x), static_cast<float>(sum.y)};
}

}  // namespace tessera
