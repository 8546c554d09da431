// The command line of `tessera render`.
#pragma once

#include "choose_camera.h"
#include "tessera/options.h"
#include "tessera/renderer.h"

#include <CLI/CLI.hpp>
#include <string>

namespace tessera::program {

struct RenderArguments {
    std::string scene;   // a built-in scene's name or a file
    std::string output;  // the picture's file
    std::string mode = "classical";
    std::string stats;  // statistics file, "-" for stdout, empty for none
    std::string trace;  // trace file, empty for none
    int frames = 1;     // how often the frame is rendered; the median is reported
    bool quiet = false;
    CameraArguments camera;
    RendererSettings settings;
    RenderOptions options;
};

// Adds all options to `app`; parsing fills `arguments`, which has to outlive it.
void addRenderOptions(CLI::App& app, RenderArguments& arguments);

// What can be told wrong without opening any file but is no matter of a single option. Throws UsageError.
void checkRenderArguments(const RenderArguments& arguments);

}  // namespace tessera::program
