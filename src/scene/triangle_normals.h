// The normals that PN triangles are built on: those given, and those computed where none are.
#pragma once

#include "scene/triangle_repair.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace tessera {

// Three unit normals a triangle.
struct TriangleNormals {
    std::vector<glm::dvec3> face;                    // of the plane
    std::vector<std::array<glm::dvec3, 3>> corners;  // those given; else by angle (Thuermer and Wuethrich, 1998)
    std::size_t computed = 0;                        // corners of the latter kind
};

// Triangles without area take a direction square to them that is closest to the normals around. `flat`: corners have their face's normal.
[[nodiscard]] TriangleNormals triangleNormals(const RepairedTriangles& triangles, bool flat);

}  // namespace tessera
