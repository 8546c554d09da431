// Tessellation patterns drawn the slow way: what src/mesh/pattern.clh promises, from lists of vertices and the order of exact middles.
#pragma once

#include "mesh/mesh_shared.h"

#include <array>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace tessera::reference {

// A vertex where a triangle sees it: of a side that is a point, in the side's middle.
struct PatternCorner {
    std::uint64_t number = 0;
    double u = 0;
    double v = 0;
};

struct PatternTriangle {
    std::array<PatternCorner, 3> corners;
    int region = 4;  // the side whose transition region it lies in; 4: none
};

struct PatternDrawing {
    std::vector<PatternTriangle> triangles;
    double gaps = 0;  // area in (u, v) of triangles that are left out, for two of their corners are one vertex
};

[[nodiscard]] double areaOf(const std::array<PatternCorner, 3>& corners);

// All triangles of a pattern in order.
[[nodiscard]] PatternDrawing draw(const mesh_pattern& pattern);

// Where the ends of the inner line beside a side lie along it, in units of 2^-25; in a triangle at the feet of their perpendiculars.
[[nodiscard]] std::pair<std::int64_t, std::int64_t> endsBeside(const mesh_pattern& pattern, int side);

// Inner lines that lie as cells of equal size would, or anywhere where `random` is given.
void placeLines(mesh_pattern& pattern, std::mt19937* random = nullptr);

// A pattern of any form and no more than `most` segments and cells a side, of MESH_TRIANGLE_GRID no more than MESH_GRID_MOST.
[[nodiscard]] mesh_pattern randomPattern(std::mt19937& random, std::uint32_t most);

}  // namespace tessera::reference
