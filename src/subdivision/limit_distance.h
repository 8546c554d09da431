// How far patches lie from the limit surface, measured.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

#include "subdivision/cells.h"
#include "subdivision/quad_domains.h"
#include "subdivision/refiner.h"

namespace tessera::subdivision {

struct LimitDistance {
    double greatest = 0;   // scene units; a lower bound of the greatest there is
    std::size_t cell = 0;  // where it was found, and at which of the cell's parameters
    double u = 0, v = 0;
    std::size_t cellsMeasured = 0;
    std::size_t evaluations = 0;  // of the limit surface
};

// Measures at `samples` times `samples` parameters of cells (2 at least), borders included: the distance from the patch's point to the
// limit surface of its domain, to the nearest point that a Newton iteration from the same parameters finds, so that a surface that only
// slides along itself counts as none. `cells` stand domain after domain. Ends after some 200,000 evaluations or domains with as many
// control points (10,000 domains, say): those in more than one patch, or in a Gregory patch, come first, in an order that spreads them over
// the cage. `refiner` is unrefined.
[[nodiscard]] LimitDistance limitDistance(const Refiner& refiner, std::span<const glm::vec3> points, const QuadDomains& domains,
                                          std::span<const Cell> cells, int samples);

}  // namespace tessera::subdivision
