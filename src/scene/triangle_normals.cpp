// The normals that PN triangles are built on.
#include "scene/triangle_normals.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace tessera {

namespace {

// Nothing where `v` has no direction.
std::optional<glm::dvec3> unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    if (!std::isfinite(length) || length == 0.0) return std::nullopt;
    return v / length;
}

glm::dvec3 corner(const RepairedTriangles& triangles, std::size_t triangle, std::size_t k) {
    return {triangles.positions[triangles.corners[triangle][k]]};
}

// Square to `axis`, of unit length.
glm::dvec3 anySquareTo(const glm::dvec3& axis) {
    const glm::dvec3 size = glm::abs(axis);
    glm::dvec3 other(0.0, 0.0, 1.0);  // along the axis' least coordinate, so that the two are never parallel
    if (size.x <= size.y && size.x <= size.z) {
        other = {1.0, 0.0, 0.0};
    } else if (size.y <= size.z) {
        other = {0.0, 1.0, 0.0};
    }
    return glm::normalize(glm::cross(axis, other));
}

// Around each position, the normals of its triangles, weighted by the angles that they have there.
std::vector<glm::dvec3> sumsByAngle(const RepairedTriangles& triangles) {
    std::vector<glm::dvec3> sums(triangles.positions.size(), glm::dvec3(0.0));
    for (std::size_t t = 0; t < triangles.corners.size(); ++t) {
        const glm::dvec3 area = areaVector(triangles, t);
        const double twiceArea = glm::length(area);
        if (twiceArea == 0.0) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 here = corner(triangles, t, k);
            const double dot = glm::dot(corner(triangles, t, (k + 1) % 3) - here, corner(triangles, t, (k + 2) % 3) - here);
            sums[triangles.corners[t][k]] += area * (std::atan2(twiceArea, dot) / twiceArea);
        }
    }
    return sums;
}

// Sums that are rounding errors of normals that cancel have no direction either: angles come to some units.
std::optional<glm::dvec3> directionOfSum(const glm::dvec3& sum) { return glm::length(sum) > 1e-9 ? unit(sum) : std::nullopt; }

// For three corners on a line: square to it, towards what is around.
glm::dvec3 lineNormal(const RepairedTriangles& triangles, std::size_t triangle, const std::vector<glm::dvec3>& sums) {
    // Positions rise along the line, so the least and the greatest are its ends.
    const auto [low, high] = std::minmax_element(triangles.corners[triangle].begin(), triangles.corners[triangle].end());
    const glm::dvec3 axis = glm::normalize(glm::dvec3(triangles.positions[*high]) - glm::dvec3(triangles.positions[*low]));
    glm::dvec3 around(0.0);
    for (const std::uint32_t position : triangles.corners[triangle]) around += sums[position];
    return directionOfSum(around - glm::dot(around, axis) * axis).value_or(anySquareTo(axis));
}

}  // namespace

TriangleNormals triangleNormals(const RepairedTriangles& triangles, bool flat) {
    const std::vector<glm::dvec3> sums = sumsByAngle(triangles);
    TriangleNormals normals;
    normals.face.reserve(triangles.corners.size());
    normals.corners.reserve(triangles.corners.size());
    for (std::size_t t = 0; t < triangles.corners.size(); ++t) {
        const std::optional<glm::dvec3> plane = unit(areaVector(triangles, t));
        const glm::dvec3 face = plane.has_value() ? *plane : lineNormal(triangles, t, sums);
        normals.face.push_back(face);
        std::array<glm::dvec3, 3>& corners = normals.corners.emplace_back(std::array<glm::dvec3, 3>{face, face, face});
        if (flat) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            std::optional<glm::dvec3> given;
            if (!triangles.normals.empty()) given = unit(glm::dvec3(triangles.normals[t][k]));
            normals.computed += given.has_value() ? 0U : 1U;
            corners[k] = given.has_value() ? *given : directionOfSum(sums[triangles.corners[t][k]]).value_or(face);
        }
    }
    return normals;
}

}  // namespace tessera
