// Polygons cut into triangles, for schemes that know no others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tessera/subdivision.h"

namespace tessera::subdivision {

struct CornerTriangle {
    std::uint32_t face = 0;
    std::array<std::uint32_t, 3> corners{};  // of the cage's faces: places in Cage::faceVertices
};

// Requires a clean cage. Quadrilaterals are cut along the shorter diagonal that lies inside, convex polygons in halves again and again, so
// that no vertex gains many edges, others of up to 64 corners by their ears; larger ones as if convex, with a note.
[[nodiscard]] std::vector<CornerTriangle> cornerTriangles(const Cage& cage, CageReport& report);

// The cage with its faces cut; to be cleaned again, as new edges may be ones that were there before.
[[nodiscard]] Cage triangulated(const Cage& cage, CageReport& report);

}  // namespace tessera::subdivision
