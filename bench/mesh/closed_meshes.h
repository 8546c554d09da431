// Closed triangle meshes by rule. Triangles are counter-clockwise seen from outside; there are no normals, so that PN patches are smooth.
#pragma once

#include "tessera/triangles.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <string>

namespace tessera::bench {

// A point of a tube: `along` of 0 to rings - 1, `around` of 0 to sides - 1, which turns clockwise seen along the tube.
using TubePoint = std::function<glm::dvec3(std::uint32_t along, std::uint32_t around)>;

// A tube that meets itself: 2 rings sides triangles.
[[nodiscard]] TriangleMesh ringTube(std::string name, std::uint32_t rings, std::uint32_t sides, const TubePoint& point);

// A tube between two tips: 2 rings sides triangles as well, since the tips' two fans make up for the row that is not there.
[[nodiscard]] TriangleMesh tippedTube(std::string name, std::uint32_t rings, std::uint32_t sides, const TubePoint& point,
                                      const glm::dvec3& first, const glm::dvec3& last);

// An icosahedron whose triangles are cut in four `cuts` times, 20 * 4^cuts of them; `place` takes unit vectors to points, the right way
// out.
[[nodiscard]] TriangleMesh ball(std::string name, std::uint32_t cuts, const std::function<glm::dvec3(const glm::dvec3&)>& place);

}  // namespace tessera::bench
