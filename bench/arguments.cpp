// The command line of tessera_bench: short options of its own, turned into Google Benchmark's where these exist.
#include "arguments.h"

#include <cstddef>
#include <functional>
#include <map>

namespace tessera::bench {

Arguments parseArguments(const std::vector<std::string>& words, const std::string& defaultScenes) {
    Arguments arguments;
    arguments.scenes = defaultScenes;
    int runs = 7;
    const std::map<std::string, std::function<void(const std::string&)>> withValue{
        {"--filter", [&](const std::string& value) { arguments.benchmark.push_back("--benchmark_filter=" + value); }},
        {"--runs", [&](const std::string& value) { runs = wholeNumber("--runs", value, 1); }},
        {"--device", [&](const std::string& value) { arguments.device = wholeNumber("--device", value, 0); }},
        {"--scenes", [&](const std::string& value) { arguments.scenes = value; }},
        {"--cache-dir", [&](const std::string& value) { arguments.cache = value; }},
    };
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (const auto option = withValue.find(word); option != withValue.end()) {
            if (i + 1 == words.size()) throw UsageError(word + " needs a value");
            option->second(words[++i]);
        } else if (word == "--list") {
            arguments.benchmark.emplace_back("--benchmark_list_tests=true");
        } else if (word == "--help" || word == "-h") {
            arguments.help = true;
        } else if (word.starts_with("--benchmark_")) {
            arguments.benchmark.push_back(word);
        } else {
            throw UsageError("unknown option '" + word + "'");
        }
    }
    arguments.benchmark.push_back("--benchmark_repetitions=" + std::to_string(runs));
    return arguments;
}

std::string helpText(const std::string& defaultScenes) {
    return "tessera_bench measures frames and their parts on an OpenCL device and reports medians.\n"
           "\n"
           "  --list            List the benchmarks: PART/SCENE[/METHOD]\n"
           "  --filter REGEX    Run those whose name matches; with --list, list those\n"
           "                    ('frame/' for all whole frames, '/hair/' for all parts of one scene)\n"
           "  --runs N          Frames measured for each, at least 1 [7]\n"
           "  --device I        Number of the device in 'tessera devices' [the default one]\n"
           "  --scenes DIR      Folder of .mscene files, if there is one\n"
           "                    [" +
           defaultScenes +
           "]\n"
           "  --cache-dir DIR   Folder of compiled kernels [the user's]\n"
           "  --benchmark_...   Any flag of Google Benchmark, --benchmark_out=FILE.json for one\n"
           "\n"
           "Pictures are 1280x720, classical mode at dice rate 8, one sample a pixel, but for frame16: 4x4 samples.\n"
           "  split    device time of bounding and splitting (host time for the cpu method)\n"
           "  dice     device time of dicing and hiding\n"
           "  shade    device time of shading; resolve_ms: of turning samples into surface references\n"
           "  frame    wall-clock time from the first enqueue to the picture on the host\n"
           "Frames before the measured ones warm the device up.\n";
}

}  // namespace tessera::bench
