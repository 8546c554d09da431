// A cage's limit surface cut into bicubic patches.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "subdivision/cells.h"
#include "subdivision/refiner.h"
#include "tessera/progress.h"

namespace tessera::subdivision {

struct LimitOptions {
    double tolerance = 0;  // scene units, above 0: how far cells at irregular corners may lie from the limit surface
    Progress progress{};   // told from 0 to 1, where it is set
};

struct LimitCounts {
    std::size_t regularDomains = 0;  // that are one patch
    std::size_t cappedCorners = 0;   // of domains, where the last cell is no piece of the limit surface but near it
    std::size_t deepestLevel = 0;
};

// Cells are the limit surface but for rounding, except those at irregular corners: these interpolate the limit's corners and middles and
// lie within the tolerance and a twelfth of a degree of it (as samples tell; after 15 halvings of a face's edges at the latest, and only
// positions count in cells narrower than 1e-4 of the cage's size), and all domains around such a corner have cells of the same size there.
// At vertices of so many faces that 15 halvings do not do, and at tips (concave corners, ends of creases), heights stay below ten times the
// tolerance. Along semi-sharp edges cells are strips, halved across the edge alone.
[[nodiscard]] std::vector<Cell> limitCells(const Refiner& refiner, std::span<const glm::vec3> points, const QuadDomains& domains,
                                           const LimitOptions& options, LimitCounts* counts = nullptr);

}  // namespace tessera::subdivision
