// Texture coordinates of cells: the limit of face-varying coordinates as bicubic nets.
#pragma once

#include <glm/glm.hpp>

#include <span>
#include <vector>

#include "subdivision/cells.h"
#include "subdivision/quad_domains.h"
#include "subdivision/refiner.h"

namespace tessera::subdivision {

// Sets Cell::texture from `values`, those of face-varying channel 0: the bicubic net with the limit's values at thirds of both
// parameters. That is the limit itself wherever it is bicubic across the cell, and two cells with a border in common have the same net
// along it. Face-varying coordinates may be irregular where the vertices are not (a seam's end, say): Bezier cells whose net is found
// farther than `tolerance` from the limit, relative to the values' box's diagonal, are quartered, at most until their level is 10 (those,
// at an irregular vertex, may be farther); their surface stays the same. With an infinite tolerance none are. Gregory cells cannot be cut.
// Requires a channel with as many values; `refiner` is unrefined. New cells stand where the cut one stood.
void addTexture(const Refiner& refiner, std::span<const glm::vec2> values, const QuadDomains& domains, std::vector<Cell>& cells,
                double tolerance = 1e-5);

}  // namespace tessera::subdivision
