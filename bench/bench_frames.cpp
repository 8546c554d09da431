// The benchmarks. Each measured iteration is a whole frame; its time is the part that the benchmark is about.
#include "bench_frames.h"

#include "tessera/error.h"
#include "tessera/weld.h"

#include <benchmark/benchmark.h>

#include <functional>
#include <string_view>
#include <utility>

namespace tessera::bench {

namespace {

constexpr int kWarmFrames = 2;

// Times in milliseconds, rates in millions a second.
using Measure = std::function<double(const Statistics&, benchmark::State&)>;

// Kernels are told by their station's prefix: their number and names may change.
double kernelMs(const Statistics& statistics, std::string_view prefix) {
    double sum = 0.0;
    for (const auto& [kernel, milliseconds] : statistics.kernelMs) {
        if (kernel.starts_with(prefix)) sum += milliseconds;
    }
    return sum;
}

double millionsPerSecond(std::uint64_t count, double milliseconds) {
    return milliseconds > 0.0 ? static_cast<double>(count) / milliseconds / 1000.0 : 0.0;
}

double measureSplit(const Statistics& s, benchmark::State& state) {
    state.counters["Mranges/s"] = millionsPerSecond(s.rangesProcessed, s.splitMs);
    state.counters["ranges"] = static_cast<double>(s.rangesProcessed);
    state.counters["stack_peak"] = static_cast<double>(s.stackPeak);
    state.counters["split_steps"] = static_cast<double>(s.iterations);
    return s.splitMs;
}

double measureDice(const Statistics& s, benchmark::State& state) {
    const double milliseconds = kernelMs(s, "dice_");
    state.counters["Mmicropolygons/s"] = millionsPerSecond(s.micropolygons, milliseconds);
    state.counters["micropolygons"] = static_cast<double>(s.micropolygons);
    return milliseconds;
}

double measureShade(const Statistics& s, benchmark::State& state) {
    const double milliseconds = kernelMs(s, "shade_");
    state.counters["Mpixels/s"] = millionsPerSecond(s.pixelsCovered, milliseconds);
    state.counters["resolve_ms"] = kernelMs(s, "resolve_");
    return milliseconds;
}

double measureFrame(const Statistics& s, benchmark::State& state) {
    state.counters["device_MiB"] = static_cast<double>(s.deviceBytesPeak) / 1048576.0;
    state.counters["Mmicropolygons/s"] = millionsPerSecond(s.micropolygons, s.frameMs);
    state.counters["split_ms"] = s.splitMs;
    state.counters["dice_ms"] = kernelMs(s, "dice_");
    state.counters["resolve_ms"] = kernelMs(s, "resolve_");
    state.counters["shade_ms"] = kernelMs(s, "shade_");
    return s.frameMs;
}

RenderOptions frameOptions(DiceMode mode, SplitMethod method, int pixelSamples) {
    RenderOptions options;
    options.mode = mode;
    options.width = 1280;
    options.height = 720;
    options.diceRate = 8;
    options.pixelSamples = pixelSamples;
    options.method = method;
    return options;
}

// What watertightness costs: a classical frame and a watertight one in turn. Micropolygons are at most a pixel long in both.
void addCost(FrameSource& frames, const SceneSource& scene) {
    const std::string benchmarkName = "cost/" + scene.name;
    const auto run = [&frames, &scene, benchmarkName](benchmark::State& state) {
        try {
            for ([[maybe_unused]] auto _ : state) {
                const RenderOptions classical = frameOptions(DiceMode::classical, SplitMethod::bounded, 1);
                const RenderOptions watertight = frameOptions(DiceMode::watertight, SplitMethod::bounded, 1);
                const Statistics before = frames.render(scene, classical, benchmarkName);
                const Statistics after = frames.render(scene, watertight, benchmarkName);
                state.counters["frame_ratio"] = after.frameMs / before.frameMs;
                state.counters["split_ratio"] = after.splitMs / before.splitMs;
                state.counters["classical_ms"] = before.frameMs;
                state.counters["Kmicropolygons"] = static_cast<double>(after.micropolygons) / 1000.0;
                state.counters["classical_Kmicropolygons"] = static_cast<double>(before.micropolygons) / 1000.0;
                state.SetIterationTime(after.frameMs / 1000.0);
            }
        } catch (const std::exception& error) {
            state.SkipWithError(error.what());
        }
    };
    benchmark::RegisterBenchmark(benchmarkName.c_str(), run)->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);
}

void add(FrameSource& frames, const std::string& benchmarkName, const SceneSource& scene, const RenderOptions& options, Measure measure) {
    const auto run = [&frames, &scene, benchmarkName, options, measure = std::move(measure)](benchmark::State& state) {
        try {
            for ([[maybe_unused]] auto _ : state) {
                const Statistics statistics = frames.render(scene, options, benchmarkName);
                state.SetIterationTime(measure(statistics, state) / 1000.0);
            }
        } catch (const std::exception& error) {
            state.SkipWithError(error.what());
        }
    };
    // One frame a repetition: the median over repetitions is then one over frames.
    benchmark::RegisterBenchmark(benchmarkName.c_str(), run)->UseManualTime()->Iterations(1)->Unit(benchmark::kMillisecond);
}

}  // namespace

Statistics FrameSource::render(const SceneSource& scene, const RenderOptions& options, const std::string& benchmarkName) {
    if (!renderer_) renderer_ = std::make_unique<Renderer>(settings_);
    if (sceneName_ != scene.name) {
        sceneName_.clear();
        Scene made = scene.make();
        weld(made);
        camera_ = made.cameras.empty() ? framingCamera(made, Camera{}.fovy) : made.cameras.front();
        renderer_->setScene(made);
        sceneName_ = scene.name;
    }
    if (benchmarkName_ != benchmarkName) {
        for (int i = 0; i < kWarmFrames; ++i) static_cast<void>(renderer_->render(camera_, options));
        benchmarkName_ = benchmarkName;
    }
    return renderer_->render(camera_, options).statistics;
}

void registerBenchmarks(FrameSource& frames, const std::vector<SceneSource>& scenes) {
    for (const SceneSource& scene : scenes) {
        for (const DiceMode mode : {DiceMode::watertight, DiceMode::classical}) {
            // Classical mode knows no rational patches and triangles.
            if (mode == DiceMode::classical && !scene.classical) continue;
            const std::string ending = "/" + scene.name + "/" + std::string(name(mode));
            for (const SplitMethod method : {SplitMethod::cpu, SplitMethod::breadth, SplitMethod::bounded}) {
                add(frames, "split" + ending + "/" + std::string(name(method)), scene, frameOptions(mode, method, 1), measureSplit);
            }
            const RenderOptions one = frameOptions(mode, SplitMethod::bounded, 1);
            add(frames, "dice" + ending, scene, one, measureDice);
            add(frames, "shade" + ending, scene, one, measureShade);
            add(frames, "frame" + ending, scene, one, measureFrame);
            add(frames, "frame16" + ending, scene, frameOptions(mode, SplitMethod::bounded, 4), measureFrame);
        }
        if (scene.classical) addCost(frames, scene);
    }
}

}  // namespace tessera::bench
