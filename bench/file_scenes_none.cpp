// Stands in for file_scenes.cpp where the file formats are not built: there are no scenes from files.
#include "bench_scenes.h"

namespace tessera::bench {

std::vector<SceneSource> fileScenes(const std::string& /*folder*/) { return {}; }

}  // namespace tessera::bench
