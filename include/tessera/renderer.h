// Renders scenes on one OpenCL device.
#pragma once

#include "tessera/device.h"
#include "tessera/memory_plan.h"
#include "tessera/options.h"
#include "tessera/progress.h"
#include "tessera/scene.h"
#include "tessera/statistics.h"

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

// One channel group of a picture, row by row from the top left, `channels` floats a pixel.
// Points into the renderer's memory: valid until its next render() or its end.
struct Plane {
    std::string_view name;  // "rgba", "Z", "N", "object.id", "patch.id", "uv"
    int channels = 0;
    std::span<const float> values;  // width x height x channels
};

// A rendered picture: the crop window's pixels only.
struct Frame {
    int x0 = 0;  // of the crop window in the full picture, pixels from the top left
    int y0 = 0;
    int width = 0;  // of the crop window
    int height = 0;
    int fullWidth = 0;
    int fullHeight = 0;
    std::vector<Plane> planes;  // "rgba" (linear, premultiplied alpha) first, then those asked for
    Statistics statistics;

    [[nodiscard]] const Plane* plane(std::string_view planeName) const;
};

struct RendererSettings {
    int device = -1;  // DeviceInfo::index, or -1 for the default
    // Of compiled kernels; empty = $TESSERA_CACHE, $XDG_CACHE_HOME/tessera or ~/.cache/tessera. Not used on PoCL, which keeps its own.
    std::string cacheFolder;
    bool cacheKernels = true;
    // Values that a work-item computes at a time: 16 or 8 (vectors, for CPUs), 1 (for GPUs), or 0 for what suits the device. The picture is
    // the same.
    int lanes = 0;
};

// Not for use by several threads at once; renderers of their own are.
class Renderer {
public:
    // Opens the device and builds or loads the kernels. Throws Error: no device, unknown index, build failure.
    explicit Renderer(const RendererSettings& settings = {});
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    [[nodiscard]] const DeviceInfo& device() const;

    // Validates the scene and makes its control points resident. Throws Error; then no scene is set.
    void setScene(const Scene& scene);

    // How a frame of these options would use the device's memory. Throws Error where the budget is too small, with the least that
    // would do, or on bad options.
    [[nodiscard]] MemoryPlan plan(const RenderOptions& options) const;

    // Renders one frame of the scene that was set. Throws Error on bad options, or when the frame's
    // buffers pass what the device holds, with the bytes they would need.
    [[nodiscard]] Frame render(const Camera& camera, const RenderOptions& options, const Progress& progress = {});

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

[[nodiscard]] std::string_view versionString();  // "0.1.0"

}  // namespace tessera
