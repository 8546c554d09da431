// How far a tessellated sheet lies from its surface, by the measure that other programs' meshes are held to as well.
#pragma once

#include "tessera/tessellator.h"

#include <glm/glm.hpp>

#include <span>

namespace tessera::bench {

// The greatest distance over all triangles, at their middles and their sides', to the surface at the same (u, v): no less than the distance
// to the surface there. `points`: of the one mesh of Bezier patches that was tessellated, unmoved, with vertices in full. Throws Error
// where the mesh cannot be read from the device.
[[nodiscard]] double greatestDistance(const DeviceMesh& mesh, std::span<const glm::vec3> points);

}  // namespace tessera::bench
