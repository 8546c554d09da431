// Cameras between cameras: the path through a scene.
#pragma once

#include "tessera/scene.h"

#include <span>

namespace tessera::bench {

// The camera at `along`, 0 to 1, on the path that goes straight from each of `cameras` to the next, as long for each part; turns are even.
// Requires a camera.
[[nodiscard]] Camera cameraAlong(std::span<const Camera> cameras, double along);

}  // namespace tessera::bench
