// The benchmarks. Each measured iteration is a whole frame; its time is the part that the benchmark is about.
#include "bench_frames.h"

#include "tessera/error.h"

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

RenderOptions frameOptions(SplitMethod method, int pixelSamples) {
    RenderOptions options;
    options.mode = DiceMode::classical;
    options.width = 1280;
    options.height = 720;
    options.diceRate = 8;
    options.pixelSamples = pixelSamples;
    options.method = method;
    return options;
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
        const Scene made = scene.make();
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
        for (const SplitMethod method : {SplitMethod::cpu, SplitMethod::breadth, SplitMethod::bounded}) {
            add(frames, "split/" + scene.name + "/" + std::string(name(method)), scene, frameOptions(method, 1), measureSplit);
        }
        const RenderOptions one = frameOptions(SplitMethod::bounded, 1);
        add(frames, "dice/" + scene.name, scene, one, measureDice);
        add(frames, "shade/" + scene.name, scene, one, measureShade);
        add(frames, "frame/" + scene.name, scene, one, measureFrame);
        add(frames, "frame16/" + scene.name, scene, frameOptions(SplitMethod::bounded, 4), measureFrame);
    }
}

}  // namespace tessera::bench
