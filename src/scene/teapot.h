// Martin Newell's teapot as a mesh.
#pragma once

#include "tessera/scene.h"

namespace tessera {

// 32 Bezier patches, named "teapot", z up, standing on z = 0: 3.15 high, 6.5 from handle (-x) to spout (+x).
[[nodiscard]] Mesh teapotMesh();

}  // namespace tessera
