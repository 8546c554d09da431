// Heavy scenes that need no file: generated the same on every machine.
#pragma once

#include "tessera/scene.h"

namespace tessera::bench {

// columns x rows built-in teapots side by side, all in the picture: many patches of ordinary size.
[[nodiscard]] Scene teapotGrid(int columns, int rows);

}  // namespace tessera::bench
