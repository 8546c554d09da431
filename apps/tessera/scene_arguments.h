// The part of a command line that says which scene and how it is read: the same for every command that takes one.
#pragma once

#include "tessera/subdivision.h"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace tessera::program {

struct SceneArguments {
    std::string scene;            // a built-in scene's name or a file
    double weldTolerance = 1e-5;  // of a mesh's size: borders this near each other become one; 0 to 0.1
    bool flat = false;            // triangle meshes: plain triangles
    SubdivisionOptions subdivision;
    std::vector<std::string> given;  // those of --weld-tolerance and the options of subdivision surfaces that the command line has
};

[[nodiscard]] bool isGiven(const SceneArguments& arguments, const std::string& option);

// Options that are each right, but not together. Throws UsageError.
void checkSceneArguments(const SceneArguments& arguments);

// The first option that is given for subdivision surfaces alone, --subdivision-scheme not being one; empty where there is none.
[[nodiscard]] std::string givenForSurfaces(const SceneArguments& arguments);

// Adds SCENE and its options to `app`, the latter under the heading `group`; parsing fills `arguments`, which has to outlive it.
void addSceneArguments(CLI::App& app, SceneArguments& arguments, const std::string& group);

}  // namespace tessera::program
