// What the papers have no figure of: budgets, and what occlusion culling gains.
#include "evaluation/plan.h"

namespace tessera::bench {

namespace {

void addOcclusion(const EvaluationScenes& scenes, const PlanSizes& sizes, std::vector<Trial>& trials) {
    for (const View& view : scenes.deep) {
        for (const bool occlusion : {false, true}) {
            RenderOptions options = paperOptions(DiceMode::watertight, SplitMethod::bounded, 0, sizes);
            options.memoryBytes = 0;
            options.occlusion = occlusion;
            trials.push_back({.figure = "occlusion", .view = view, .along = {}, .options = options});
        }
    }
}

// The city's worst ordinary view in less and less memory: what fails says what it would need.
void addBudgets(const EvaluationScenes& scenes, const PlanSizes& sizes, std::vector<Trial>& trials) {
    for (const std::uint64_t budget : sizes.budgetsMiB) {
        for (const SplitMethod method : {SplitMethod::breadth, SplitMethod::bounded, SplitMethod::local}) {
            RenderOptions options = paperOptions(DiceMode::watertight, method, 0, sizes);
            options.memoryBytes = budget << 20U;
            trials.push_back({.figure = "budget", .view = {scenes.city, "spike"}, .along = {}, .options = options});
        }
    }
}

}  // namespace

void addOurTrials(const EvaluationScenes& scenes, const PlanSizes& sizes, std::vector<Trial>& trials) {
    addOcclusion(scenes, sizes, trials);
    addBudgets(scenes, sizes, trials);
}

}  // namespace tessera::bench
