// A hint for those who look for a crack: how near two borders without neighbours come to being the same.
#pragma once

#include <cstdint>
#include <span>

#include "scene/weld_group.h"

namespace tessera::welding {

// The least distance of two of `borders` whose ends are within 100 tolerances of each other and whose curves differ; 0 where there are
// none. In places where very many borders meet some pairs go unseen.
[[nodiscard]] double nearestMiss(const Group& group, std::span<const std::uint32_t> borders);

}  // namespace tessera::welding
