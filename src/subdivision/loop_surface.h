// Loop's surfaces as PN triangles: corners and normals are the limit surface's.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "subdivision/pn_cage.h"
#include "subdivision/refiner.h"

namespace tessera::subdivision {

struct LoopSurface {
    std::optional<Mesh> mesh;  // nothing where no face has a limit surface with an area
    std::size_t level = 0;     // times that each triangle was cut into four
    double limitDistance = 0;  // the greatest found at the middles of triangles and their sides, scene units
};

// Each triangle of the cage becomes 4^level patches: level 2 where they lie within `tolerance` (scene units) of the limit surface, else as
// deep as that takes, but no deeper than level 5 and no more than 2^20 patches. Neighbours share positions and borders to the bit; normals
// part along creases that are sharp for ever, at corners that are, and where three and more such creases meet.
[[nodiscard]] LoopSurface loopSurface(const Refiner& refiner, std::span<const glm::vec3> points, std::span<const glm::vec2> textures,
                                      double tolerance, const std::string& name);

}  // namespace tessera::subdivision
