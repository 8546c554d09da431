// Tessellation patterns on the host: pattern.clh, which says how vertices, triangles and units of a pattern are numbered, compiled as C++.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh_shared.h"

namespace tessera {

// Of all of a pattern. Vertices are distinct ones.
[[nodiscard]] std::uint64_t patternVertices(const mesh_pattern& pattern);
[[nodiscard]] std::uint64_t patternTriangles(const mesh_pattern& pattern);
[[nodiscard]] std::uint32_t patternLoop(const mesh_pattern& pattern);  // of the vertices, those around the patch
[[nodiscard]] std::uint32_t patternUnits(const mesh_pattern& pattern);

// Vertices, those that units share counted for each, and triangles of the pattern's units before `unit`, which may be patternUnits().
[[nodiscard]] mesh_offset unitsBefore(const mesh_pattern& pattern, std::uint32_t unit);

// The pattern's numbers of a unit's vertices, in order. `numbers` is used again.
void unitVertexNumbers(const mesh_pattern& pattern, std::uint32_t unit, std::vector<std::uint64_t>& numbers);

// The first of a unit's triangles from which on they come in pairs (a, b, c), (a, c, d), each pair a cell of four corners; the number of
// its triangles where none do.
[[nodiscard]] std::uint64_t firstCellTriangle(const mesh_pattern& pattern, std::uint32_t unit);

// The pattern's number of vertex i of 0 to pattern.side[side], counted from (0, 0), (1, 0), (0, 1) or (0, 0) of sides 0 to 3.
[[nodiscard]] std::uint32_t loopVertex(const mesh_pattern& pattern, int side, std::uint32_t i);

}  // namespace tessera
