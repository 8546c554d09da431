// Generated scenes by kind.
#include "evaluation/generated_scenes.h"

#include "tessera/generate.h"

#include <cstdint>

namespace tessera::bench {

Scene generated(const std::string& kind, int count) { return generateScene(kind, static_cast<std::uint64_t>(count)); }

}  // namespace tessera::bench
