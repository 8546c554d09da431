// tessera_bench: how long frames and their parts take.
#include "arguments.h"
#include "bench_frames.h"
#include "bench_scenes.h"
#include "report.h"

#include <benchmark/benchmark.h>

#include <exception>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace tessera::bench;

// Google Benchmark copies the flags but keeps `program`, which has to be main()'s.
void handToBenchmark(char* program, std::vector<std::string> flags) {
    std::vector<char*> pointers{program};
    for (std::string& flag : flags) pointers.push_back(flag.data());
    int count = static_cast<int>(pointers.size());
    pointers.push_back(nullptr);
    benchmark::Initialize(&count, pointers.data());
    if (count > 1) throw UsageError("Google Benchmark knows no flag '" + std::string(pointers[1]) + "'");
}

int run(char* program, const std::vector<std::string>& words) {
    const std::string defaultScenes = TESSERA_SHARED_SCENES;
    const Arguments arguments = parseArguments(words, defaultScenes);
    if (arguments.help) {
        std::cout << helpText(defaultScenes);
        return 0;
    }
    handToBenchmark(program, arguments.benchmark);
    tessera::RendererSettings settings;
    settings.device = arguments.device;
    settings.cacheFolder = arguments.cache;
    FrameSource frames(settings);
    const std::vector<SceneSource> scenes = sceneSources(arguments.scenes);
    registerBenchmarks(frames, scenes);
    MedianReporter reporter;
    const std::size_t matched = benchmark::RunSpecifiedBenchmarks(&reporter);
    benchmark::Shutdown();
    return matched == 0 || reporter.failed() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argv[0], std::vector<std::string>(argv + 1, argv + argc));
    } catch (const UsageError& error) {
        std::cerr << "tessera_bench: error: " << error.what() << "; see --help\n";
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "tessera_bench: error: " << error.what() << "\n";
        return 1;
    }
}
