// Small triangle meshes that tests start from, and the borders of what is made of them.
#pragma once

#include "tessera/error.h"
#include "tessera/triangles.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace tessera {

// A cube around the origin, corners at +-1, twelve triangles that face outward. Its diagonals leave the corners with three, four, five
// or six triangles.
inline TriangleMesh cube() {
    TriangleMesh mesh;
    mesh.name = "cube";
    for (unsigned i = 0; i < 8; ++i) {
        mesh.positions.emplace_back((i & 1U) != 0 ? 1.0F : -1.0F, (i & 2U) != 0 ? 1.0F : -1.0F, (i & 4U) != 0 ? 1.0F : -1.0F);
    }
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

// A torus of `rings` by `sides` quadrilaterals, cut into triangles; positions moved at random by up to `noise`.
inline TriangleMesh ring(std::uint32_t rings, std::uint32_t sides, float noise, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> moved(-noise, noise);
    TriangleMesh mesh;
    mesh.name = "ring";
    for (std::uint32_t i = 0; i < rings; ++i) {
        for (std::uint32_t j = 0; j < sides; ++j) {
            const double a = 6.283185307179586 * i / rings, b = 6.283185307179586 * j / sides, r = 2.0 + 0.7 * std::cos(b);
            const glm::vec3 place(r * std::cos(a), r * std::sin(a), 0.7 * std::sin(b));
            mesh.positions.push_back(place + glm::vec3(moved(random), moved(random), moved(random)));
            const std::uint32_t here = i * sides, next = (i + 1) % rings * sides, k = (j + 1) % sides;
            mesh.triangles.push_back({here + j, next + j, next + k});
            mesh.triangles.push_back({here + j, next + k, here + k});
        }
    }
    return mesh;
}

// Each triangle with three positions of its own, and turned to begin at any corner.
inline TriangleMesh unwelded(const TriangleMesh& mesh, std::mt19937& random) {
    TriangleMesh loose;
    loose.name = mesh.name;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::size_t first = random() % 3;
        const auto index = static_cast<std::uint32_t>(loose.positions.size());
        loose.triangles.push_back({index, index + 1, index + 2});
        if (!mesh.normals.empty()) loose.normals.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            loose.positions.push_back(mesh.positions[mesh.triangles[t][(first + k) % 3]]);
            if (!mesh.normals.empty()) loose.normals.back()[k] = mesh.normals[t][(first + k) % 3];
        }
    }
    return loose;
}

// A random unit normal for every corner: creases all over.
inline void addRandomNormals(TriangleMesh& mesh, std::mt19937& random) {
    std::normal_distribution<float> any;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        std::array<glm::vec3, 3>& normals = mesh.normals.emplace_back();
        for (glm::vec3& normal : normals) normal = glm::normalize(glm::vec3(any(random), any(random), any(random)));
    }
}

using Bits = std::array<std::uint32_t, 3>;
using CurveBits = std::array<Bits, 4>;

inline Bits bits(const glm::vec3& p) {
    return {std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y), std::bit_cast<std::uint32_t>(p.z)};
}

// The four control points of each border of a pn patch: A to B, B to C, C to A.
inline std::array<std::array<glm::vec3, 4>, 3> borders(const Mesh& mesh, std::size_t patch) {
    const glm::vec3* p = &mesh.points[16 * patch];
    return {{{p[0], p[1], p[2], p[3]}, {p[3], p[6], p[8], p[9]}, {p[9], p[7], p[4], p[0]}}};
}

// How often each border curve is there, either way along being the same; a border that differs in a bit is one of its own.
inline std::map<CurveBits, int> countCurves(const Mesh& mesh) {
    std::map<CurveBits, int> counts;
    for (std::size_t patch = 0; patch < mesh.patchCount(); ++patch) {
        for (const std::array<glm::vec3, 4>& border : borders(mesh, patch)) {
            const CurveBits there{bits(border[0]), bits(border[1]), bits(border[2]), bits(border[3])};
            const CurveBits back{there[3], there[2], there[1], there[0]};
            ++counts[std::min(there, back)];
        }
    }
    return counts;
}

// Whether every border is another's too.
inline bool isClosed(const Mesh& mesh) {
    const std::map<CurveBits, int> counts = countCurves(mesh);
    return std::all_of(counts.begin(), counts.end(), [](const auto& curve) { return curve.second == 2; });
}

// Six times the volume that the corners' triangles enclose.
inline double signedVolume(const Mesh& mesh) {
    double volume = 0.0;
    for (std::size_t patch = 0; patch < mesh.patchCount(); ++patch) {
        const glm::vec3* p = &mesh.points[16 * patch];
        volume += glm::dot(glm::dvec3(p[0]), glm::cross(glm::dvec3(p[3]), glm::dvec3(p[9])));
    }
    return volume;
}

}  // namespace tessera
