// The command line of `tessera render`.
#pragma once

#include "choose_camera.h"
#include "scene_arguments.h"
#include "tessera/options.h"
#include "tessera/renderer.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tessera::program {

struct RenderArguments {
    SceneArguments scene;
    std::string output;  // the picture's file
    std::string stats;   // statistics file, "-" for stdout, empty for none
    std::string trace;   // trace file, empty for none
    int frames = 1;      // how often the frame is rendered; the median is reported
    bool quiet = false;
    CameraArguments camera;
    std::optional<std::string> dicingCamera;                    // name of the scene's camera that rates are measured by
    std::vector<std::pair<std::string, DiceMode>> modeOptions;  // those given that only one mode looks at
    RendererSettings settings;
    RenderOptions options;
};

// Adds all options to `app`; parsing fills `arguments`, which has to outlive it.
void addRenderOptions(CLI::App& app, RenderArguments& arguments);

// Options of the frame that are each right, but not together. Throws UsageError.
void checkFrameOptions(const RenderArguments& arguments);

// What can be told wrong without opening any file but is no matter of a single option. Throws UsageError.
void checkRenderArguments(const RenderArguments& arguments);

}  // namespace tessera::program
