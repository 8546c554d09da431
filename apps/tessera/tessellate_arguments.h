// The command line of `tessera tessellate`.
#pragma once

#include "choose_camera.h"
#include "formats/mesh_writer.h"
#include "scene_arguments.h"
#include "tessera/renderer.h"
#include "tessera/tessellator.h"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace tessera::program {

struct TessellateArguments {
    SceneArguments scene;
    std::string output;  // the mesh's file
    std::string stats;   // statistics file, "-" for stdout, empty for none
    bool quiet = false;
    CameraArguments camera;
    std::vector<std::string> viewOptions;  // those given that only --pixel-error looks at
    RendererSettings settings;
    TessellateOptions options;  // tolerance and pixelError are 0 where they are not given; camera is not set yet
    MeshFileOptions file;
    Orientation orientation = Orientation::consistent;
};

// Adds all options to `app`; parsing fills `arguments`, which has to outlive it.
void addTessellateOptions(CLI::App& app, TessellateArguments& arguments);

// What can be told wrong without opening any file but is no matter of a single option. Throws UsageError.
void checkTessellateArguments(const TessellateArguments& arguments);

}  // namespace tessera::program
