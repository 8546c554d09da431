// The command line of tessera_evaluate.
#pragma once

#include "usage.h"

#include <string>
#include <vector>

namespace tessera::bench {

struct EvaluationArguments {
    int runs = 5;        // most frames measured of each trial
    int limit = 10;      // seconds after which trials that are compared get no further turn
    int city = 0;        // patches that the city is made of, about; 0 = a million, or 20000 with `quick`
    int device = -1;     // as `tessera devices` counts; -1 = the default
    std::string filter;  // regular expression; empty = all trials
    std::string scenes;  // folder of .mscene files
    std::string out;     // folder of the CSV files
    std::string cache;   // of compiled kernels; empty = the user's
    bool quick = false;  // small pictures and scenes, one frame each
    bool list = false;
    bool help = false;
};

// Throws UsageError. `defaultScenes`: the folder taken when none is named.
[[nodiscard]] EvaluationArguments parseEvaluationArguments(const std::vector<std::string>& words, const std::string& defaultScenes);

[[nodiscard]] std::string evaluationHelp(const std::string& defaultScenes);

}  // namespace tessera::bench
