// tessera_evaluate: the papers' measurements, and CSV files of them.
#include "evaluation/arguments.h"
#include "evaluation/frame_taker.h"
#include "evaluation/measure.h"
#include "evaluation/results.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace tessera::bench;

EvaluationScenes scenesOf(const EvaluationArguments& arguments) {
    GeneratedCounts counts = arguments.quick ? quickCounts() : GeneratedCounts{};
    if (arguments.city != 0) counts.city = arguments.city;
    return evaluationScenes(arguments.scenes, counts);
}

std::string viewText(const Group& group) {
    return group.figure + " " + group.view.scene + (group.view.camera.empty() ? "" : "@" + group.view.camera);
}

void tell(const Group& group, const std::vector<Measured>& measured, double seconds) {
    std::size_t frames = 0;
    for (const Measured& item : measured) frames += item.frames.size();
    std::array<char, 64> time{};
    std::snprintf(time.data(), time.size(), "%.1f s", seconds);
    std::cout << viewText(group) << ": " << measured.size() << " trials, " << frames << " frames, " << time.data() << "\n";
    for (const Measured& item : measured) {
        if (!item.error.empty()) std::cout << "  " << name(item.trial) << ": " << item.error << "\n";
    }
    std::cout.flush();
}

void evaluate(const EvaluationArguments& arguments, const EvaluationScenes& scenes, const std::vector<Group>& groups) {
    tessera::RendererSettings settings;
    settings.device = arguments.device;
    settings.cacheFolder = arguments.cache;
    FrameTaker taker(scenes.sources, settings);
    std::cout << "on " << taker.device().name << "\n";
    const std::vector<std::pair<std::string, std::string>> how{{"version", std::string(tessera::versionString())},
                                                               {"runs", std::to_string(arguments.runs)},
                                                               {"limit_s", std::to_string(arguments.limit)},
                                                               {"quick", arguments.quick ? "1" : "0"},
                                                               {"filter", arguments.filter}};
    ResultFiles files(arguments.out, taker.device(), how);
    for (const Group& group : groups) {
        const auto start = std::chrono::steady_clock::now();
        const std::vector<Measured> measured =
            measure(group, arguments.runs, arguments.limit, [&](const Trial& trial) { return taker.take(trial); });
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        files.add(measured);
        tell(group, measured, taken.count());
    }
}

int run(const std::vector<std::string>& words) {
    const std::string defaultScenes = TESSERA_SHARED_SCENES;
    const EvaluationArguments arguments = parseEvaluationArguments(words, defaultScenes);
    if (arguments.help) {
        std::cout << evaluationHelp(defaultScenes);
        return 0;
    }
    const EvaluationScenes scenes = scenesOf(arguments);
    const std::vector<Group> groups = planGroups(scenes, arguments.quick ? quickSizes() : PlanSizes{}, arguments.filter);
    if (groups.empty()) throw UsageError("--filter: no trial's name matches '" + arguments.filter + "'; --list names all");
    if (arguments.list) {
        for (const Group& group : groups) {
            for (const Trial& trial : group.trials) std::cout << name(trial) << "\n";
        }
        return 0;
    }
    evaluate(arguments, scenes, groups);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(std::vector<std::string>(argv + 1, argv + argc));
    } catch (const UsageError& error) {
        std::cerr << "tessera_evaluate: error: " << error.what() << "; see --help\n";
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "tessera_evaluate: error: " << error.what() << "\n";
        return 1;
    }
}
