// The scenes of the evaluation and the views that its figures take of them.
#pragma once

#include "bench_scenes.h"

#include <string>
#include <vector>

namespace tessera::bench {

struct View {
    std::string scene;
    std::string camera;  // empty: the scene's first one, or one that frames it

    [[nodiscard]] bool operator==(const View&) const = default;
};

struct GeneratedCounts {
    int city = 1'000'000;  // patches, about
    int hair = 10'000;     // strands
    int columns = 60;
    std::vector<int> random{1, 4, 16, 64, 256, 1024, 4096, 16384};  // patches
};

[[nodiscard]] GeneratedCounts quickCounts();

struct EvaluationScenes {
    std::vector<SceneSource> sources;  // all; names are unique
    std::vector<View> table;           // all but `random`
    std::vector<View> principal;       // those that stand for the thesis' seven
    std::vector<View> deep;            // of high depth complexity
    std::vector<std::string> random;   // by rising number of patches
    std::string city;
    std::string teapot;
    std::string creature;  // killeroo where it is, else the teapot
};

// Scenes from the .mscene files of `folder`, where there is one, and generated ones.
[[nodiscard]] EvaluationScenes evaluationScenes(const std::string& folder, const GeneratedCounts& counts);

}  // namespace tessera::bench
