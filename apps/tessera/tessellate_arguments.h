// The command line of `tessera tessellate`.
#pragma once

#include "choose_camera.h"
#include "formats/mesh_writer.h"
#include "scene_arguments.h"
#include "tessera/renderer.h"
#include "tessera/subdivision_tables.h"
#include "tessera/tessellator.h"

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace tessera::program {

enum class TessellateMethod {
    patches,  // Tessellator
    tables,   // TableTessellator
};

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
    TessellateMethod method = TessellateMethod::patches;
    int level = -1;  // of tables; -1 where it is not given
    TableOrder order = TableOrder::global;
    std::vector<std::pair<std::string, TessellateMethod>> methodOptions;  // those given that only one method looks at
};

// Adds all options to `app`; parsing fills `arguments`, which has to outlive it.
void addTessellateOptions(CLI::App& app, TessellateArguments& arguments);

// What can be told wrong without opening any file but is no matter of a single option. Throws UsageError.
void checkTessellateArguments(const TessellateArguments& arguments);

}  // namespace tessera::program
