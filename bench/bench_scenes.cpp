// The scenes that are measured: those that need no file first.
#include "bench_scenes.h"

#include "made_scenes.h"
#include "tessera/generate.h"

#include <string_view>
#include <utility>

namespace tessera::bench {

std::vector<SceneSource> sceneSources(const std::string& folder) {
    std::vector<SceneSource> sources;
    for (const std::string_view name : builtinSceneNames()) {
        if (!builtinScene(name).cages.empty()) continue;  // to be subdivided first
        // A file may have the same name: both are measured.
        sources.push_back({"builtin_" + std::string(name), [name] { return builtinScene(name); }, name == "teapot"});
    }
    sources.push_back({"made_teapots", [] { return teapotGrid(12, 8); }});
    sources.push_back({"made_hair", [] { return generateScene("hair", 15000); }});
    for (SceneSource& source : fileScenes(folder)) sources.push_back(std::move(source));
    return sources;
}

}  // namespace tessera::bench
