// Generated scenes by kind: the evaluation's one door to them.
#pragma once

#include "tessera/scene.h"

#include <string>

namespace tessera::bench {

// kind: "hair" (count strands), "columns" (count columns), "city" (about count patches; cameras average, spike and eyesplit), "eyesplit",
// "random" (count patches). Throws Error on another.
[[nodiscard]] Scene generated(const std::string& kind, int count);

}  // namespace tessera::bench
