// A patch's tessellation on the host, drawn from its pattern's numbering, and how far it is from the surface.
#pragma once

#include "mesh/mesh_shared.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace tessera::test {

// Vertices in (u, v), triangles counter-clockwise there.
struct PatternDrawing {
    std::vector<glm::dvec2> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<int> onPoint;  // a vertex's side that is a point, all of which it stands for; -1: none
};

[[nodiscard]] PatternDrawing drawPattern(const mesh_pattern& pattern);

// A plain grid of m x n cells, or of m along each side of a triangle.
[[nodiscard]] PatternDrawing drawGrid(std::uint32_t m, std::uint32_t n);
[[nodiscard]] PatternDrawing drawTriangleGrid(std::uint32_t m);

// Of a point to a triangle.
[[nodiscard]] double distanceTo(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& point);

using Surface = std::function<glm::dvec3(double u, double v)>;

// What a place of the surface, at (u, v), is off by: the surface's point and the triangle it is drawn by.
using Measure = std::function<double(const glm::dvec3& point, const std::array<glm::dvec3, 3>& triangle)>;

// The greatest measure over a lattice of `steps` a triangle; ends where one is above `enough`.
[[nodiscard]] double greatest(const PatternDrawing& drawing, const Surface& surface, const Measure& measure, int steps, double enough);

// The same of the distances between points of the surface and of triangles at equal (u, v): the error of Zheng and Sederberg (2000) and of
// Filip et al. (1986), which holds what points move along the surface, too.
[[nodiscard]] double farthestAtEqualPlaces(const PatternDrawing& drawing, const Surface& surface, int steps, double enough = 1e300);

// The same of the distances from the surface to the nearest triangle.
[[nodiscard]] double farthest(const PatternDrawing& drawing, const Surface& surface, int steps, double enough = 1e300);

}  // namespace tessera::test
