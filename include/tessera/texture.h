// Texture coordinates of meshes that have their own (Mesh::textureNets).
#pragma once

#include <glm/glm.hpp>

#include <cstddef>

#include "tessera/scene.h"

namespace tessera {

// The texture coordinates at a patch's (u, v), 0 to 1: the value of its net, v upwards as in OBJ; (u, v) themselves where the mesh has no
// nets. At the corners it is the net's corner point, to the bit. Requires a patch of the mesh.
[[nodiscard]] glm::vec2 textureAt(const Mesh& mesh, std::size_t patch, float u, float v);

}  // namespace tessera
