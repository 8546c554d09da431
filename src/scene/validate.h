// The check of a single camera, for those who take a camera without its scene.
#pragma once

#include "tessera/scene.h"

#include <string>

namespace tessera {

// Throws Error, which begins with `where`, on: a position that is not finite, a rotation of zero or
// infinite length, near <= 0, a far plane that is not finite, fovy outside (0, 180).
void validateCamera(const Camera& camera, const std::string& where);

}  // namespace tessera
