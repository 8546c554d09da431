// Cages for tests of subdivision tables: small ones whose rings meet themselves, and larger ones with random tags.
#pragma once

#include <cstdint>

#include "tessera/cage.h"

namespace tessera::test {

[[nodiscard]] Cage cubeCage();
// columns x rows faces around a torus: with 3 x 3 each ring has vertices twice.
[[nodiscard]] Cage torusCage(std::uint32_t columns, std::uint32_t rows);
// `valence` faces around a vertex, with a ring of faces around them: a disc.
[[nodiscard]] Cage fanCage(std::uint32_t valence);
// Two such discs' inner faces back to back: a closed cage with two vertices of that valence and `valence` of valence 2.
[[nodiscard]] Cage lensCage(std::uint32_t valence);
// A prism over a polygon: faces of `sides` corners at its ends.
[[nodiscard]] Cage prismCage(std::uint32_t sides);
// Boxes pushed out of boxes, `steps` times: closed, valences 3 to 6 and now and then more.
[[nodiscard]] Cage extrudedCage(std::uint32_t steps, std::uint32_t seed);

// Moves points, opens some faces away where the rest stays manifold, and gives edges and vertices random sharpness, whole numbers, broken
// ones and infinite.
void tagAtRandom(Cage& cage, std::uint32_t seed, bool open);

}  // namespace tessera::test
