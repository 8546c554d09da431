// The scenes that are measured.
#pragma once

#include "tessera/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace tessera::bench {

// A scene by name, made or read only when a benchmark wants it.
struct SceneSource {
    std::string name;
    std::function<Scene()> make;
    bool classical = true;  // whether classical mode draws it: Bezier and Gregory patches alone
};

// Built-in scenes, generated ones and the .mscene files of `folder` (none when it does not exist), in a fixed order.
[[nodiscard]] std::vector<SceneSource> sceneSources(const std::string& folder);

// The .mscene files of `folder`, by name; always empty in a build without file formats.
[[nodiscard]] std::vector<SceneSource> fileScenes(const std::string& folder);

}  // namespace tessera::bench
