// The measurements of Patney and Owens: figures 6 to 8. Their pictures are 512 pixels wide and high, and their grids 16 x 16 at a bound of
// 16 pixels.
#include "evaluation/plan.h"

#include <array>

namespace tessera::bench {

namespace {

constexpr std::array kMethods{SplitMethod::breadth, SplitMethod::bounded};

RenderOptions patneyOptions(SplitMethod method, int side, const PlanSizes& sizes) {
    RenderOptions options = paperOptions(DiceMode::classical, method, 0, sizes);
    options.width = side;
    options.height = side;
    options.splitBound = 16.0F;
    options.diceRate = 16;
    return options;
}

void addPrimitiveCounts(const EvaluationScenes& scenes, const PlanSizes& sizes, std::vector<Trial>& trials) {
    for (const std::string& scene : scenes.random) {
        for (const SplitMethod method : kMethods) {
            trials.push_back(
                {.figure = "patney_figure_6", .view = {scene, ""}, .along = {}, .options = patneyOptions(method, sizes.patneySide, sizes)});
        }
    }
}

void addScreenSizes(const EvaluationScenes& scenes, const PlanSizes& sizes, std::vector<Trial>& trials) {
    for (const int side : sizes.screenSides) {
        for (const SplitMethod method : kMethods) {
            trials.push_back(
                {.figure = "patney_figure_7", .view = {scenes.teapot, ""}, .along = {}, .options = patneyOptions(method, side, sizes)});
        }
    }
}

// With 4 x 4 samples: what buckets save here is the samples' memory, for no grid is ever kept.
void addBucketSizes(const EvaluationScenes& scenes, const PlanSizes& sizes, std::vector<Trial>& trials) {
    for (const int side : sizes.bucketSides) {
        for (const SplitMethod method : kMethods) {
            RenderOptions options = patneyOptions(method, sizes.patneySide, sizes);
            options.pixelSamples = 4;
            options.bucketWidth = side;
            options.bucketHeight = side;
            trials.push_back({.figure = "patney_figure_8", .view = {scenes.creature, ""}, .along = {}, .options = options});
        }
    }
}

}  // namespace

void addPatneyTrials(const EvaluationScenes& scenes, const PlanSizes& sizes, std::vector<Trial>& trials) {
    addPrimitiveCounts(scenes, sizes, trials);
    addScreenSizes(scenes, sizes, trials);
    addBucketSizes(scenes, sizes, trials);
}

}  // namespace tessera::bench
