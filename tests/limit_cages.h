// Cages without faults, made by hand, for tests of what is made of them.
#pragma once

#include "tessera/cage.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tessera::test {

struct NamedCage {
    std::string name;
    Cage cage;
};

[[nodiscard]] Cage cubeCage();
// Quads all round; every vertex has four.
[[nodiscard]] Cage torusCage(std::uint32_t around, std::uint32_t across);
// Flat, `width` times `height` unit squares at z = 0, with boundaries all around.
[[nodiscard]] Cage gridCage(std::uint32_t width, std::uint32_t height);
// Two rings of quads around a vertex that has `valence`: 3 and above.
[[nodiscard]] Cage fanCage(std::uint32_t valence);
// Closed, with two faces of `sides` corners.
[[nodiscard]] Cage prismCage(std::uint32_t sides);
// The cube with the faces of a cross as texture coordinates, a seam along seven of its edges.
[[nodiscard]] Cage unfoldedCube();

// A torus with random creases and corners of any sharpness, holes, and pairs of faces made one of six corners.
[[nodiscard]] Cage randomCage(std::uint32_t seed);

// Smooth ones, creased ones (for ever and for 0.5 to 10 levels), with boundaries, corners, faces of any size and holes.
[[nodiscard]] std::vector<NamedCage> limitCages();

}  // namespace tessera::test
