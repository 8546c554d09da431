// What the evaluation measures: a list of trials, known before any device is opened.
#pragma once

#include "evaluation/evaluation_scenes.h"
#include "tessera/options.h"

#include <optional>
#include <string>
#include <vector>

namespace tessera::bench {

// One configuration of which frames are measured.
struct Trial {
    std::string figure;  // of which paper; the name of its CSV file
    View view;
    std::optional<double> along;  // place on the scene's camera path, 0 to 1, instead of the view's camera
    RenderOptions options;
    bool once = false;  // a single frame that none goes before: where counts and bytes are wanted, not times
    bool load = false;  // what each work-group did is wanted as well
};

// FIGURE/SCENE[@CAMERA]/MODE/METHOD/..., with what its figure varies.
[[nodiscard]] std::string name(const Trial& trial);

// Trials that are compared with each other: they take turns.
struct Group {
    std::string figure;
    View view;
    std::vector<Trial> trials;  // of that figure and view
};

// How large pictures and how fine steps are.
struct PlanSizes {
    int width = 1280;
    int height = 720;
    std::vector<std::uint32_t> tableBatches{10000, 40000, 200000};
    std::vector<std::uint32_t> batches{2500, 5000, 10000, 20000, 40000, 100000, 200000};
    int pathSteps = 41;    // odd: the watertight mode takes every second one
    int patneySide = 512;  // pixels: width and height
    std::vector<int> screenSides{128, 192, 256, 384, 512, 768, 1024, 1280};
    std::vector<int> bucketSides{32, 64, 128, 192, 256, 384, 512};
    std::vector<std::uint64_t> budgetsMiB{32, 64, 128, 512};
};

[[nodiscard]] PlanSizes quickSizes();

// All trials whose name matches the regular expression `filter` (empty: all), in groups. Groups of one scene follow one another, so that
// each scene is loaded once.
[[nodiscard]] std::vector<Group> planGroups(const EvaluationScenes& scenes, const PlanSizes& sizes, const std::string& filter);

// What the thesis' figures have in common: one sample a pixel, no occlusion culling, and memory enough for breadth.
[[nodiscard]] RenderOptions paperOptions(DiceMode mode, SplitMethod method, std::uint32_t batch, const PlanSizes& sizes);

// Each adds its trials. figures_thesis.cpp, figures_patney.cpp, figures_ours.cpp.
void addThesisTrials(const EvaluationScenes& scenes, const PlanSizes& sizes, std::vector<Trial>& trials);
void addPatneyTrials(const EvaluationScenes& scenes, const PlanSizes& sizes, std::vector<Trial>& trials);
void addOurTrials(const EvaluationScenes& scenes, const PlanSizes& sizes, std::vector<Trial>& trials);

}  // namespace tessera::bench
