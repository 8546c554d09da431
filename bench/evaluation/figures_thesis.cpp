// The measurements of Weber's thesis: its table 7.2 and figures 7.1 to 7.5.
#include "evaluation/plan.h"

#include <array>

namespace tessera::bench {

namespace {

constexpr std::array kModes{DiceMode::classical, DiceMode::watertight};
// The middle one of the thesis' batch sizes.
constexpr std::uint32_t kMiddleBatch = 40000;

// Where only splitting is looked at: ranges are split as ever, but grids of 4 x 4 halve the time to dice them.
RenderOptions splitOptions(DiceMode mode, SplitMethod method, std::uint32_t batch, const PlanSizes& sizes) {
    RenderOptions options = paperOptions(mode, method, batch, sizes);
    if (mode == DiceMode::classical) options.diceRate = 4;
    return options;
}

void addTable(const EvaluationScenes& scenes, const PlanSizes& sizes, std::vector<Trial>& trials) {
    for (const View& view : scenes.table) {
        for (const DiceMode mode : kModes) {
            const auto add = [&](SplitMethod method, std::uint32_t batch) {
                trials.push_back(
                    {.figure = "thesis_table_7_2", .view = view, .along = {}, .options = paperOptions(mode, method, batch, sizes)});
            };
            add(SplitMethod::breadth, 0);
            for (const std::uint32_t batch : sizes.tableBatches) add(SplitMethod::bounded, batch);
        }
    }
}

void addPath(const EvaluationScenes& scenes, const PlanSizes& sizes, std::vector<Trial>& trials) {
    for (int step = 0; step < sizes.pathSteps; ++step) {
        for (const DiceMode mode : kModes) {
            // Its ranges cannot be split without dicing them in full: half as many steps.
            if (mode == DiceMode::watertight && step % 2 != 0) continue;
            for (const SplitMethod method : {SplitMethod::breadth, SplitMethod::bounded}) {
                const std::uint32_t batch = method == SplitMethod::bounded ? kMiddleBatch : 0;
                trials.push_back({.figure = "thesis_figure_7_1",
                                  .view = {scenes.city, "path"},
                                  .along = static_cast<double>(step) / (sizes.pathSteps - 1),
                                  .options = splitOptions(mode, method, batch, sizes),
                                  .once = true});
            }
        }
    }
}

// Figures 7.2 and 7.3 are one measurement: bounded and local over batch size, and breadth, which has none.
void addBatchSizes(const EvaluationScenes& scenes, const PlanSizes& sizes, std::vector<Trial>& trials) {
    for (const View& view : scenes.principal) {
        const auto add = [&](SplitMethod method, std::uint32_t batch) {
            trials.push_back({.figure = "thesis_figure_7_2_3",
                              .view = view,
                              .along = {},
                              .options = splitOptions(DiceMode::classical, method, batch, sizes)});
        };
        add(SplitMethod::breadth, 0);
        for (const std::uint32_t batch : sizes.batches) {
            add(SplitMethod::bounded, batch);
            add(SplitMethod::local, batch);
        }
    }
}

void addLoad(const EvaluationScenes& scenes, const PlanSizes& sizes, std::vector<Trial>& trials) {
    for (const View& view : scenes.principal) {
        for (const DiceMode mode : kModes) {
            trials.push_back({.figure = "thesis_figure_7_4",
                              .view = view,
                              .along = {},
                              .options = paperOptions(mode, SplitMethod::local, kMiddleBatch, sizes),
                              .once = true,
                              .load = true});
        }
    }
}

// As a user gets it: batch size and memory by the plan, occlusion culling on where there is any.
void addStages(const EvaluationScenes& scenes, const PlanSizes& sizes, std::vector<Trial>& trials) {
    for (const View& view : scenes.principal) {
        for (const DiceMode mode : kModes) {
            for (const SplitMethod method : {SplitMethod::bounded, SplitMethod::local}) {
                RenderOptions options = paperOptions(mode, method, 0, sizes);
                options.memoryBytes = 0;
                options.occlusion = true;
                trials.push_back({.figure = "thesis_figure_7_5", .view = view, .along = {}, .options = options});
            }
        }
    }
}

}  // namespace

void addThesisTrials(const EvaluationScenes& scenes, const PlanSizes& sizes, std::vector<Trial>& trials) {
    addTable(scenes, sizes, trials);
    addPath(scenes, sizes, trials);
    addBatchSizes(scenes, sizes, trials);
    addLoad(scenes, sizes, trials);
    addStages(scenes, sizes, trials);
}

}  // namespace tessera::bench
