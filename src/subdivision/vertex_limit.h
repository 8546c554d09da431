// Where a vertex of a cage goes in the limit, by refining around it until it stands still.
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/cage.h"

namespace tessera::subdivision {

// The coefficients of the cage's vertices. OpenSubdiv's own are not exact where an infinitely sharp crease ends.
[[nodiscard]] std::vector<double> vertexLimit(const Cage& cage, std::uint32_t vertex);

}  // namespace tessera::subdivision
