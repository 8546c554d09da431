// Assimp's meshes as cages.
#pragma once

#include <assimp/mesh.h>
#include <glm/glm.hpp>

#include "tessera/cage.h"

namespace tessera {

// The polygons of a checked mesh (mesh_scene.h), as many corners as they have: points equal to the bit become one, texture points equal to
// the bit become one where their vertex is one; lines and points are left out. Triangles of one n-gon (FB_ngon_encoding) become it
// again where `ngons` or Assimp says that they are such.
// `tags` may have a scheme and a boundary rule; creases and corners of the mesh's vertices; holes; and instead of the mesh's faces, faces
// of its vertices. Numbers must exist.
[[nodiscard]] Cage cageOf(const aiMesh& source, Cage tags, bool ngons);

// Works `m` into the points. Faces turn round where it mirrors.
void bakeCage(const glm::dmat4& m, Cage& cage);

}  // namespace tessera
