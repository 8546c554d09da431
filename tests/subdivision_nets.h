// Plain nets that subdivision_shapes.h tags: points and faces.
#pragma once

#include "tessera/cage.h"

#include <cstdint>
#include <vector>

namespace tessera::test {

// A box of eight corners of which none is where symmetry would have it. Vertex k has x in its lowest bit, y and z above.
[[nodiscard]] Cage boxNet();

// `columns` x `rows` quadrilaterals over a hilly square.
[[nodiscard]] Cage gridNet(int columns, int rows);

// The same around a torus, at least 3 each way.
[[nodiscard]] Cage torusNet(int columns, int rows);

// `sides` quadrilaterals around a point; open.
[[nodiscard]] Cage fanNet(int sides);

// Two such fans and a band between them; closed.
[[nodiscard]] Cage drumNet(int sides);

// Two faces of `sides` corners and a band of quadrilaterals.
[[nodiscard]] Cage prismNet(int sides);

// A face of `sides` corners and as many triangles.
[[nodiscard]] Cage pyramidNet(int sides);

[[nodiscard]] Cage dodecahedronNet();
[[nodiscard]] Cage icosahedronNet();

// A box with one corner cut off: a triangle, pentagons and quadrilaterals.
[[nodiscard]] Cage cutBoxNet();

// A box with a vertex of two faces inside one of its faces.
[[nodiscard]] Cage valenceTwoNet();

// Three quarters of a grid: around its middle vertex stand faces of three quarters of it, and a boundary goes through it.
[[nodiscard]] Cage cornerNet(int along);

// One after the other, side by side along x.
[[nodiscard]] Cage together(const std::vector<Cage>& cages);

// Moves every point by up to `distance` each way.
void shake(Cage& cage, float distance, std::uint32_t seed);

void addFace(Cage& cage, const std::vector<std::uint32_t>& vertices);

}  // namespace tessera::test
