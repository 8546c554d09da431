// What tests of exact surfaces share: bicubic patches evaluated in double precision, and borders compared by their bits.
#pragma once

#include "tessera/scene.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <vector>

namespace tessera::test {

// Weights and derivatives of the cubic Bernstein polynomials.
inline std::array<double, 4> bernstein(double t) {
    const double s = 1.0 - t;
    return {s * s * s, 3.0 * t * s * s, 3.0 * t * t * s, t * t * t};
}
inline std::array<double, 4> bernsteinSlope(double t) {
    const double s = 1.0 - t;
    return {-3.0 * s * s, 3.0 * s * s - 6.0 * t * s, 6.0 * t * s - 3.0 * t * t, 3.0 * t * t};
}

struct SurfacePoint {
    glm::dvec3 position;
    glm::dvec3 du, dv;

    [[nodiscard]] glm::dvec3 normal() const { return glm::cross(du, dv); }  // not of unit length
};

// Of a bezier or rational mesh.
inline SurfacePoint patchPoint(const Mesh& mesh, std::size_t patch, double u, double v) {
    const auto sum = [&](const std::array<double, 4>& alongU, const std::array<double, 4>& alongV) {
        glm::dvec4 total(0.0);
        for (std::size_t i = 0; i < 16; ++i) {
            const std::size_t k = 16 * patch + i;
            const double weight = mesh.weights.empty() ? 1.0 : static_cast<double>(mesh.weights[k]);
            total += alongU[i % 4] * alongV[i / 4] * weight * glm::dvec4(glm::dvec3(mesh.points[k]), 1.0);
        }
        return total;
    };
    const glm::dvec4 at = sum(bernstein(u), bernstein(v)), slopeU = sum(bernsteinSlope(u), bernstein(v)),
                     slopeV = sum(bernstein(u), bernsteinSlope(v));
    const glm::dvec3 position = glm::dvec3(at) / at.w;
    const auto projected = [&](const glm::dvec4& slope) { return (glm::dvec3(slope) - position * slope.w) / at.w; };
    return {position, projected(slopeU), projected(slopeV)};
}

// The integral of `value` over all patches, by the midpoint rule on steps x steps cells a patch.
template <typename Value>
double integral(const Mesh& mesh, int steps, Value value) {
    double total = 0.0;
    for (std::size_t patch = 0; patch < mesh.patchCount(); ++patch) {
        for (int i = 0; i < steps * steps; ++i) {
            const int column = i % steps;
            const int row = i / steps;
            const double u = (column + 0.5) / steps;
            const double v = (row + 0.5) / steps;
            total += value(patchPoint(mesh, patch, u, v)) / steps / steps;
        }
    }
    return total;
}
inline double area(const Mesh& mesh, int steps) {
    return integral(mesh, steps, [](const SurfacePoint& p) { return glm::length(p.normal()); });
}
// Of a closed mesh; above 0 where du x dv points outward.
inline double volume(const Mesh& mesh, int steps) {
    return integral(mesh, steps, [](const SurfacePoint& p) { return glm::dot(p.position, p.normal()) / 3.0; });
}

using Bits = std::vector<std::uint32_t>;

// The bits of a border's four points and weights. Side as in EdgeRecord.
inline Bits borderBits(const Mesh& mesh, std::size_t patch, std::size_t side) {
    constexpr std::array<std::array<std::size_t, 2>, 4> kFirstAndStep{{{0, 1}, {3, 4}, {12, 1}, {0, 4}}};
    Bits bits;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t k = 16 * patch + kFirstAndStep[side][0] + i * kFirstAndStep[side][1];
        std::array<float, 4> values{mesh.points[k].x, mesh.points[k].y, mesh.points[k].z, mesh.weights.empty() ? 1.0F : mesh.weights[k]};
        std::array<std::uint32_t, 4> words{};
        std::memcpy(words.data(), values.data(), sizeof(values));
        bits.insert(bits.end(), words.begin(), words.end());
    }
    return bits;
}

// The same border from its other end.
inline Bits reversed(const Bits& border) {
    Bits result;
    for (std::size_t i = 4; i-- > 0;)
        result.insert(result.end(), border.begin() + static_cast<int>(4 * i), border.begin() + static_cast<int>(4 * i + 4));
    return result;
}

inline bool isPoint(const Bits& border) {
    for (std::size_t i = 1; i < 4; ++i)
        if (!std::equal(border.begin(), border.begin() + 3, border.begin() + static_cast<int>(4 * i))) return false;
    return true;
}

struct Borders {
    std::size_t points = 0;   // borders that are one point
    std::size_t open = 0;     // that no other has the bits of
    std::size_t crowded = 0;  // that two others or more have the bits of
};

inline Borders countBorders(const Mesh& mesh) {
    Borders result;
    std::map<Bits, std::size_t> users;
    for (std::size_t patch = 0; patch < mesh.patchCount(); ++patch) {
        for (std::size_t side = 0; side < 4; ++side) {
            const Bits border = borderBits(mesh, patch, side);
            if (isPoint(border)) {
                ++result.points;
            } else {
                ++users[std::min(border, reversed(border))];
            }
        }
    }
    for (const auto& [border, count] : users) {
        if (count == 1) ++result.open;
        if (count > 2) ++result.crowded;
    }
    return result;
}

// Meshes of the same kind as one.
inline Mesh joined(const std::vector<Mesh>& parts) {
    Mesh whole = parts.front();
    for (std::size_t i = 1; i < parts.size(); ++i) {
        whole.points.insert(whole.points.end(), parts[i].points.begin(), parts[i].points.end());
        whole.weights.insert(whole.weights.end(), parts[i].weights.begin(), parts[i].weights.end());
    }
    return whole;
}

}  // namespace tessera::test
