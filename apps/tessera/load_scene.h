// Finds the scene that a command line names.
#pragma once

#include "tessera/scene.h"

#include <string>
#include <vector>

namespace tessera::program {

struct LoadedScene {
    Scene scene;
    std::vector<std::string> warnings;  // a line each: oddities that still leave a scene
};

// The built-in scene `nameOrFile`, else the .mscene file of that path. Throws Error: neither exists, or a bad file.
[[nodiscard]] LoadedScene loadScene(const std::string& nameOrFile);

// The built-in scenes' names, for help texts: "teapot, sphere".
[[nodiscard]] std::string builtinSceneList();

}  // namespace tessera::program
