// The part of a command line that says which scene and how it is read: the same for every command that takes one.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace tessera::program {

struct SceneArguments {
    std::string scene;            // a built-in scene's name or a file
    double weldTolerance = 1e-5;  // of a mesh's size: borders this near each other become one; 0 to 0.1
    bool flat = false;            // triangle meshes: plain triangles
};

// Adds SCENE and its options to `app`, the latter under the heading `group`; parsing fills `arguments`, which has to outlive it.
void addSceneArguments(CLI::App& app, SceneArguments& arguments, const std::string& group);

}  // namespace tessera::program
