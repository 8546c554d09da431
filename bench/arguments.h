// The command line of tessera_bench.
#pragma once

#include "usage.h"

#include <string>
#include <vector>

namespace tessera::bench {

struct Arguments {
    int device = -1;     // as `tessera devices` counts; -1 = the default
    std::string scenes;  // folder of .mscene files
    std::string cache;   // of compiled kernels; empty = the user's
    bool help = false;
    std::vector<std::string> benchmark;  // what is handed on to Google Benchmark: its flags
};

// Throws UsageError. `defaultScenes`: the folder taken when none is named.
[[nodiscard]] Arguments parseArguments(const std::vector<std::string>& words, const std::string& defaultScenes);

[[nodiscard]] std::string helpText(const std::string& defaultScenes);

}  // namespace tessera::bench
