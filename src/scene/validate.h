// The checks of a single camera and of a mesh's points, for those who take them without their scene.
#pragma once

#include "tessera/scene.h"

#include <string>

namespace tessera {

// Throws Error, which begins with `where`, on: a position that is not finite, a rotation of zero or
// infinite length, near <= 0, a far plane that is not finite, fovy outside (0, 180).
void validateCamera(const Camera& camera, const std::string& where);

// Throws Error, which begins with `where`, on points that are no multiple of a patch's, are not finite or lie beyond 1e9.
void validatePoints(const Mesh& mesh, const std::string& where);

// Throws Error, naming the first cage, where cages are left that subdivide() has not made meshes of. Requires a validated scene.
void requireMeshes(const Scene& scene);

}  // namespace tessera
