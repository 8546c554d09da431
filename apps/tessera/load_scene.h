// Finds the scene that a command line names, and makes it clean.
#pragma once

#include "scene_arguments.h"
#include "tessera/scene.h"
#include "tessera/subdivision.h"
#include "tessera/weld.h"

#include <string>
#include <vector>

namespace tessera::program {

struct LoadedScene {
    Scene scene;
    WeldReport weld;                    // what was found where patches meet
    std::vector<CageReport> cages;      // what the scene's cages were, and became
    std::vector<std::string> warnings;  // a line each: oddities that still leave a scene
};

// The built-in scene of that name, else the file of that path: an .mscene file, or a polygon mesh of a format that readMeshFile()
// knows; cages made meshes, which tells how far it is unless `quiet`, and welded. Throws Error: neither exists, a format that is not known,
// or a bad file; UsageError on options that make no sense together, on --flat for what is no triangle mesh, and on options of subdivision
// surfaces for what is none.
[[nodiscard]] LoadedScene loadScene(const SceneArguments& arguments, bool quiet);

// The same with the scene's cages as they are, of the scheme that is asked for, and nothing welded.
[[nodiscard]] LoadedScene loadCages(const SceneArguments& arguments);

// What loadScene() takes, for help texts and errors: "an .mscene file, a triangle mesh (...) or a built-in scene (teapot, ...)".
[[nodiscard]] std::string sceneFormats();

}  // namespace tessera::program
