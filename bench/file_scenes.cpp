// Scenes from files: part of the benchmark where the file formats are built.
#include "bench_scenes.h"
#include "formats/mscene.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace tessera::bench {

std::vector<SceneSource> fileScenes(const std::string& folder) {
    std::vector<SceneSource> sources;
    std::error_code missing;
    for (const auto& entry : std::filesystem::directory_iterator(folder, missing)) {
        const std::filesystem::path& path = entry.path();
        if (path.extension() == ".mscene") sources.push_back({path.stem().string(), [path] { return readMscene(path); }});
    }
    std::sort(sources.begin(), sources.end(), [](const SceneSource& a, const SceneSource& b) { return a.name < b.name; });
    return sources;
}

}  // namespace tessera::bench
