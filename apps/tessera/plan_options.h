// The options that a frame's memory plan depends on, but for those of a mode: `render` and `info --plan` share them.
#pragma once

#include "tessera/options.h"

#include <CLI/CLI.hpp>

namespace tessera::program {

// --size, --crop, --pixel-samples and --aov. Parsing fills `options`, which has to outlive `app`.
void addSizeOptions(CLI::App& app, RenderOptions& options);

// --method, --memory, --batch and --bucket.
void addMemoryOptions(CLI::App& app, RenderOptions& options);

}  // namespace tessera::program
