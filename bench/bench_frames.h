// The benchmarks: frames of each scene, and what parts of a frame take.
#pragma once

#include "bench_scenes.h"
#include "tessera/renderer.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tessera::bench {

// Renders frames for benchmarks. The renderer is made with the first frame, so that listing needs no device, and a scene
// stays resident until another one is wanted.
class FrameSource {
public:
    explicit FrameSource(RendererSettings settings) : settings_(std::move(settings)) {}

    // A frame of `scene`, measured. The first one after a change of scene or options comes after two that warm up.
    [[nodiscard]] Statistics render(const SceneSource& scene, const RenderOptions& options, const std::string& benchmarkName);

private:
    RendererSettings settings_;
    std::unique_ptr<Renderer> renderer_;
    std::string sceneName_;
    std::string benchmarkName_;
    Camera camera_;
};

// Registers PART/SCENE[/METHOD] for all of `scenes`. Both arguments have to outlive the benchmarks' run.
void registerBenchmarks(FrameSource& frames, const std::vector<SceneSource>& scenes);

}  // namespace tessera::bench
