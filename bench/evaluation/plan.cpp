// Trials put in order: by scene, then by figure and view.
#include "evaluation/plan.h"

#include <algorithm>
#include <cmath>
#include <regex>

namespace tessera::bench {

namespace {

// More than breadth needs of any scene here: the frame taker lowers it to what the device has.
constexpr std::uint64_t kAmpleBytes = std::uint64_t{4} << 30U;

std::string sizeText(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

bool sameGroup(const Group& group, const Trial& trial) { return group.figure == trial.figure && group.view == trial.view; }

}  // namespace

PlanSizes quickSizes() {
    PlanSizes sizes;
    sizes.width = 160;
    sizes.height = 90;
    sizes.tableBatches = {1000, 4000};
    sizes.batches = {1000, 4000};
    sizes.pathSteps = 5;
    sizes.patneySide = 64;
    sizes.screenSides = {32, 64};
    sizes.bucketSides = {32, 64};
    sizes.budgetsMiB = {1, 64};
    return sizes;
}

RenderOptions paperOptions(DiceMode mode, SplitMethod method, std::uint32_t batch, const PlanSizes& sizes) {
    RenderOptions options;
    options.mode = mode;
    options.method = method;
    options.batch = batch;
    options.width = sizes.width;
    options.height = sizes.height;
    options.pixelSamples = 1;
    options.occlusion = false;
    options.memoryBytes = kAmpleBytes;
    return options;
}

std::string name(const Trial& trial) {
    const RenderOptions& options = trial.options;
    std::string text = trial.figure + "/" + trial.view.scene;
    if (!trial.view.camera.empty()) text += "@" + trial.view.camera;
    text += "/" + std::string(name(options.mode)) + "/" + std::string(name(options.method));
    if (options.batch != 0) text += "/batch" + std::to_string(options.batch);
    text += "/" + sizeText(options.width, options.height);
    if (options.bucketWidth != 0) text += "/bucket" + sizeText(options.bucketWidth, options.bucketHeight);
    if (options.memoryBytes != 0 && options.memoryBytes != kAmpleBytes) text += "/" + std::to_string(options.memoryBytes >> 20U) + "MiB";
    if (options.occlusion && options.mode == DiceMode::watertight) text += "/occlusion";
    if (trial.along) text += "/along" + std::to_string(std::lround(1000.0 * *trial.along));
    return text;
}

std::vector<Group> planGroups(const EvaluationScenes& scenes, const PlanSizes& sizes, const std::string& filter) {
    std::vector<Trial> trials;
    addThesisTrials(scenes, sizes, trials);
    addPatneyTrials(scenes, sizes, trials);
    addOurTrials(scenes, sizes, trials);
    const std::regex wanted(filter);
    std::vector<Group> groups;
    for (const SceneSource& source : scenes.sources) {
        for (Trial& trial : trials) {
            if (trial.view.scene != source.name || !std::regex_search(name(trial), wanted)) continue;
            if (groups.empty() || !sameGroup(groups.back(), trial)) groups.push_back({trial.figure, trial.view, {}});
            groups.back().trials.push_back(std::move(trial));
        }
    }
    return groups;
}

}  // namespace tessera::bench
