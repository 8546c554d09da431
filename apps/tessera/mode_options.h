// The options that choose a mode, and those that only one mode looks at.
#pragma once

#include "render_arguments.h"

#include <CLI/CLI.hpp>

namespace tessera::program {

enum class ModeOptions {
    all,
    ofMemory,  // those that the memory plan depends on
};

// Adds --mode, and the options of each mode under a heading of their own.
void addModeOptions(CLI::App& app, RenderArguments& arguments, ModeOptions which);

// Throws UsageError where an option was given that the chosen mode does not look at.
void checkModeOptions(const RenderArguments& arguments);

}  // namespace tessera::program
