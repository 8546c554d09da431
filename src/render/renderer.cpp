#include "tessera/renderer.h"

#include <algorithm>
#include <utility>

#include "render/frame_job.h"
#include "render/plan_memory.h"
#include "scene/validate.h"
#include "tessera/error.h"

namespace tessera {

const Plane* Frame::plane(std::string_view planeName) const {
    const auto found = std::find_if(planes.begin(), planes.end(), [&](const Plane& plane) { return plane.name == planeName; });
    return found == planes.end() ? nullptr : &*found;
}

struct Renderer::Impl {
    explicit Impl(const RendererSettings& settings) : stations(settings) {}

    // Throws Error where the options and the scene don't go together.
    void requireDrawable(const RenderOptions& options) const;
    [[nodiscard]] MemoryPlan plan(const RenderOptions& options) const;
    [[nodiscard]] Frame draw(const Camera& camera, const RenderOptions& options, const Progress& progress);

    Stations stations;
    bool hasScene = false;
};

void Renderer::Impl::requireDrawable(const RenderOptions& options) const {
    if (!hasScene) throw Error("no scene is set; call setScene() first");
    options.validate();
    if (options.dicingCamera) validateCamera(*options.dicingCamera, "dicing camera '" + options.dicingCamera->name + "'");
    const PatchSource& source = stations.stream.source();
    if (options.mode == DiceMode::classical && source.patches() > source.gregoryEnd()) {
        throw Error(stations.scene.name +
                    ": classical mode knows Bezier and Gregory patches alone, not rational ones or triangles; use --mode watertight");
    }
}

MemoryPlan Renderer::Impl::plan(const RenderOptions& options) const {
    return planMemory(options, stations.stream.source(), {stations.scene.lights.size()}, stations.session.device.info);
}

Frame Renderer::Impl::draw(const Camera& camera, const RenderOptions& options, const Progress& progress) {
    const MemoryPlan memory = plan(options);
    stations.session.timeline.restart(options.trace);
    FrameJob job(stations, camera, options, memory, progress);
    Frame frame;
    frame.statistics = job.run();
    const PixelWindow window = cropWindow(options);
    frame.x0 = window.x0;
    frame.y0 = window.y0;
    frame.width = window.width;
    frame.height = window.height;
    frame.fullWidth = options.width;
    frame.fullHeight = options.height;
    frame.planes = stations.picture.planes();
    return frame;
}

Renderer::Renderer(const RendererSettings& settings) : impl_(std::make_unique<Impl>(settings)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

const DeviceInfo& Renderer::device() const { return impl_->stations.session.device.info; }

void Renderer::setScene(const Scene& scene) {
    impl_->hasScene = false;
    scene.validate();
    requireMeshes(scene);
    impl_->stations.stream.setSource(PatchSource(scene));
    impl_->stations.lights = DeviceBuffer();
    impl_->stations.scene = scene;
    for (Mesh& mesh : impl_->stations.scene.meshes) mesh.points = {};
    impl_->hasScene = true;
}

MemoryPlan Renderer::plan(const RenderOptions& options) const {
    impl_->requireDrawable(options);
    return impl_->plan(options);
}

Frame Renderer::render(const Camera& camera, const RenderOptions& options, const Progress& progress) {
    impl_->requireDrawable(options);
    validateCamera(camera, "camera '" + camera.name + "'");
    try {
        return impl_->draw(camera, options, progress);
    } catch (const cl::Error& error) {
        throw Error("the frame failed on " + impl_->stations.session.device.info.name + ": " + error.what() + " gave " +
                    clErrorName(error.err()));
    }
}

}  // namespace tessera
