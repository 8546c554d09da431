#include "tessera/renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "render/frame_setup.h"
#include "render/split_loop.h"
#include "scene/validate.h"
#include "shade/shade.h"
#include "tessera/error.h"

namespace tessera {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

std::filesystem::path cacheFolderOf(const RendererSettings& settings) {
    if (!settings.cacheKernels) return {};
    return settings.cacheFolder.empty() ? defaultCacheFolder() : std::filesystem::path(settings.cacheFolder);
}

struct PlaneSpec {
    Aov aov;
    std::string_view name;
    int channels;
    uint picture_planes::*place;
};

constexpr PlaneSpec planeSpecs[] = {
    {Aov::z, "Z", 1, &picture_planes::z},
    {Aov::normal, "N", 3, &picture_planes::normal},
    {Aov::object, "object.id", 1, &picture_planes::object},
    {Aov::patch, "patch.id", 1, &picture_planes::patch_id},
    {Aov::uv, "uv", 2, &picture_planes::uv},
};

// Where each plane lies in the picture's buffer, in floats.
struct PictureLayout {
    picture_planes planes{NO_PLANE, NO_PLANE, NO_PLANE, NO_PLANE, NO_PLANE};
    std::uint64_t floats = 0;
};

PictureLayout layOutPicture(const FilmLayout& film, Aov aovs) {
    const std::uint64_t pixels = static_cast<std::uint64_t>(film.width) * static_cast<std::uint64_t>(film.height);
    PictureLayout layout;
    layout.floats = 4 * pixels;
    for (const PlaneSpec& spec : planeSpecs) {
        if (!contains(aovs, spec.aov)) continue;
        layout.planes.*(spec.place) = static_cast<uint>(layout.floats);
        layout.floats += static_cast<std::uint64_t>(spec.channels) * pixels;
    }
    return layout;
}

}  // namespace

const Plane* Frame::plane(std::string_view planeName) const {
    const auto found = std::find_if(planes.begin(), planes.end(), [&](const Plane& plane) { return plane.name == planeName; });
    return found == planes.end() ? nullptr : &*found;
}

struct Renderer::Impl {
    explicit Impl(const RendererSettings& settings)
        : session(settings.device, kernelSources(), cacheFolderOf(settings), settings.lanes), queues(session), film(session) {}
    ~Impl() { releasePicture(); }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void releasePicture();
    void planMemory(const RenderOptions& options, const FilmLayout& layout, const PictureLayout& picture);
    void reserve(const RenderOptions& options, const FilmLayout& layout, const PictureLayout& picture);
    void placePatches(const frame_params& params, const std::vector<placed_object>& placed, const RenderOptions& options);
    SplitResult split(const frame_params& params, const RenderOptions& options, const Progress& progress);
    Frame drawFrame(const Camera& camera, const RenderOptions& options, const Progress& progress);
    Statistics gather(const RenderOptions& options, const SplitResult& result, std::uint32_t pixelsCovered, double frameMs);
    [[nodiscard]] Frame present(const RenderOptions& options, const FilmLayout& layout, const PictureLayout& picture) const;

    DeviceSession session;
    Scene scene;
    bool hasScene = false;
    PatchSet patches;
    SplitQueues queues;
    Film film;
    DeviceBuffer dicingPoints;  // the patches in the dicing camera's space, where it is another
    DeviceBuffer objects;
    DeviceBuffer lights;
    DeviceBuffer picture;
    void* mapped = nullptr;  // the picture on the host, until the next frame
};

void Renderer::Impl::releasePicture() {
    if (mapped == nullptr) return;
    try {
        session.timeline.unmap(picture.cl(), mapped);
        session.timeline.finish();
    } catch (const cl::Error&) {
        mapped = nullptr;  // the device is gone, and the mapping with it
    }
    mapped = nullptr;
}

// Refuses a frame that the device can't hold before anything is allocated, and lets go of what earlier, larger frames left.
void Renderer::Impl::planMemory(const RenderOptions& options, const FilmLayout& layout, const PictureLayout& pictureLayout) {
    const std::uint64_t sceneBytes = patches.bytes() + (options.dicingCamera ? patches.eyeBytes() : 0);
    const split_limits limits = boundedLimits(options);
    const bool bounded = options.method == SplitMethod::bounded;
    const std::uint64_t queueBytes = bounded ? SplitQueues::bytes(limits, boundedStack(options), options.mode) : 0;
    const std::uint64_t smallBytes = scene.objects.size() * sizeof(placed_object) + (scene.lights.size() + 1) * sizeof(eye_light);
    const std::uint64_t bytes = sceneBytes + queueBytes + smallBytes + layout.bytes() + pictureLayout.floats * sizeof(float);
    std::uint64_t largest = std::max(layout.samples * 8, pictureLayout.floats * sizeof(float));
    if (bounded)
        largest = std::max(largest,
                           SplitQueues::rangeBytes(options.mode) * std::max<std::uint64_t>(boundedStack(options), limits.ready_capacity));
    if (session.memory.bytes() > bytes) {
        film.release();
        queues.release();
        dicingPoints = DeviceBuffer();
        picture = DeviceBuffer();
    }
    const DeviceInfo& info = session.device.info;
    if (bytes <= info.globalBytes && largest <= info.maxAllocationBytes && pictureLayout.floats < NO_PLANE) return;
    throw Error("a picture of " + std::to_string(layout.width) + "x" + std::to_string(layout.height) + " with " +
                std::to_string(layout.pixelSamples) + "x" + std::to_string(layout.pixelSamples) + " samples a pixel would need " +
                bytesText(bytes) + " of device memory, " + bytesText(largest) + " in one buffer; " + info.name + " holds " +
                bytesText(info.globalBytes) + ", at most " + bytesText(info.maxAllocationBytes) +
                " in one buffer: use a smaller --size, --pixel-samples, --crop or --batch");
}

void Renderer::Impl::reserve(const RenderOptions& options, const FilmLayout& layout, const PictureLayout& pictureLayout) {
    film.prepare(layout);
    queues.setMode(options.mode);
    if (options.method == SplitMethod::bounded) queues.reserve(boundedLimits(options), boundedStack(options));
    if (options.dicingCamera) session.memory.ensure(dicingPoints, "the patches in the dicing camera's space", patches.eyeBytes());
    session.memory.ensure(objects, "the objects", scene.objects.size() * sizeof(placed_object), CL_MEM_READ_ONLY);
    session.memory.ensure(lights, "the lights", std::max<std::size_t>(1, scene.lights.size()) * sizeof(eye_light), CL_MEM_READ_ONLY);
    session.memory.ensure(picture, "the picture", pictureLayout.floats * sizeof(float), CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR);
}

void Renderer::Impl::placePatches(const frame_params& params, const std::vector<placed_object>& placed, const RenderOptions& options) {
    if (patches.patches == 0) return;
    const std::size_t bytes = placed.size() * sizeof(placed_object);
    if (options.dicingCamera) {
        const std::vector<placed_object> dicing = placeObjects(scene, eyeFromWorld(*options.dicingCamera));
        session.timeline.write(objects.cl(), dicing.data(), bytes);
        enqueuePlace(session, params, patches, objects.cl(), dicingPoints.cl());
    }
    session.timeline.write(objects.cl(), placed.data(), bytes);
    enqueuePlace(session, params, patches, objects.cl(), patches.eyePoints.cl());
}

SplitResult Renderer::Impl::split(const frame_params& params, const RenderOptions& options, const Progress& progress) {
    const cl::Buffer& dicing = options.dicingCamera ? dicingPoints.cl() : patches.eyePoints.cl();
    const SplitLoop loop{session, queues, film, params, patches, dicing, options, progress};
    switch (options.method) {
        case SplitMethod::cpu:
            return runCpu(loop);
        case SplitMethod::breadth:
            return runBreadth(loop);
        case SplitMethod::bounded:
            break;
    }
    return runBounded(loop);
}

Frame Renderer::Impl::drawFrame(const Camera& camera, const RenderOptions& options, const Progress& progress) {
    releasePicture();
    const FilmLayout layout = layOutFilm(options);
    const PictureLayout pictureLayout = layOutPicture(layout, options.aovs);
    session.timeline.restart(options.trace);
    planMemory(options, layout, pictureLayout);
    session.memory.restartPeak();
    reserve(options, layout, pictureLayout);
    frame_params params = setUpFrame(camera, options, layout, patches);
    const glm::dmat4 view = eyeFromWorld(camera);
    const std::vector<placed_object> placedObjects = placeObjects(scene, view);
    const std::vector<eye_light> placedLights = placeLights(scene, view, options.headlight);
    params.lights = static_cast<uint>(placedLights.size());

    film.distrust();
    const auto start = Clock::now();
    placePatches(params, placedObjects, options);
    session.timeline.write(lights.cl(), placedLights.data(), placedLights.size() * sizeof(eye_light));
    const SplitResult result = split(params, options, progress);
    if (progress) progress("shade", 1.0);
    enqueueShade(session, params, pictureLayout.planes, {patches, objects.cl(), lights.cl(), queues}, film, picture.cl());
    mapped = session.timeline.map(picture.cl(), pictureLayout.floats * sizeof(float));
    const double frameMs = millisecondsSince(start);
    film.trust();

    const std::uint32_t covered = queues.readState().pixels_covered;
    Frame frame = present(options, layout, pictureLayout);
    frame.statistics = gather(options, result, covered, frameMs);
    return frame;
}

Statistics Renderer::Impl::gather(const RenderOptions& options, const SplitResult& result, std::uint32_t pixelsCovered, double frameMs) {
    Statistics statistics;
    statistics.device = session.device.info.name;
    statistics.width = options.width;
    statistics.height = options.height;
    statistics.method = name(options.method);
    statistics.batch = options.batch;
    statistics.mode = name(options.mode);
    if (options.mode == DiceMode::watertight) {
        statistics.shadingRate = options.shadingRate;
        statistics.gridSize = options.gridSize;
    }
    statistics.pixelSamples = options.pixelSamples;
    statistics.patches = patches.patches;
    statistics.rangesProcessed = wide(result.state.processed_low, result.state.processed_high);
    statistics.rangesDiced = wide(result.state.diced_low, result.state.diced_high);
    statistics.rangesCulled = wide(result.state.culled_low, result.state.culled_high);
    statistics.stackPeak = result.stackPeak;
    statistics.iterations = result.state.iterations;
    statistics.batches = result.state.batches;
    statistics.micropolygons = options.mode == DiceMode::watertight
                                   ? wide(result.state.micropolygons_low, result.state.micropolygons_high)
                                   : statistics.rangesDiced * static_cast<std::uint64_t>(options.diceRate * options.diceRate);
    statistics.pixelsCovered = pixelsCovered;
    statistics.frameMs = frameMs;
    statistics.buildMs = session.kernels.buildMilliseconds();
    statistics.kernelMs = session.timeline.milliseconds();
    statistics.splitMs = result.hostMs;
    for (const auto& [label, milliseconds] : statistics.kernelMs) {
        if (label.starts_with("split_") || label.starts_with("quad_")) statistics.splitMs += milliseconds;
    }
    statistics.deviceBytesPeak = session.memory.peakBytes();
    if (options.trace) statistics.trace = session.timeline.trace();
    return statistics;
}

Frame Renderer::Impl::present(const RenderOptions& options, const FilmLayout& layout, const PictureLayout& pictureLayout) const {
    Frame frame;
    frame.x0 = layout.x0;
    frame.y0 = layout.y0;
    frame.width = layout.width;
    frame.height = layout.height;
    frame.fullWidth = options.width;
    frame.fullHeight = options.height;
    const std::span<const float> all(static_cast<const float*>(mapped), pictureLayout.floats);
    const std::size_t pixels = static_cast<std::size_t>(layout.width) * static_cast<std::size_t>(layout.height);
    frame.planes.push_back({"rgba", 4, all.first(4 * pixels)});
    for (const PlaneSpec& spec : planeSpecs) {
        const std::size_t place = pictureLayout.planes.*(spec.place);
        if (place == NO_PLANE) continue;
        frame.planes.push_back({spec.name, spec.channels, all.subspan(place, static_cast<std::size_t>(spec.channels) * pixels)});
    }
    return frame;
}

Renderer::Renderer(const RendererSettings& settings) : impl_(std::make_unique<Impl>(settings)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

const DeviceInfo& Renderer::device() const { return impl_->session.device.info; }

void Renderer::setScene(const Scene& scene) {
    impl_->hasScene = false;
    scene.validate();
    try {
        impl_->patches = PatchSet();
        impl_->patches = uploadPatches(scene, impl_->session.memory, impl_->session.timeline);
    } catch (const cl::Error& error) {
        throw Error("the scene can't be uploaded: " + std::string(error.what()) + " gave " + clErrorName(error.err()));
    }
    impl_->scene = scene;
    for (Mesh& mesh : impl_->scene.meshes) mesh.points = {};
    impl_->hasScene = true;
}

Frame Renderer::render(const Camera& camera, const RenderOptions& options, const Progress& progress) {
    if (!impl_->hasScene) throw Error("no scene is set; call setScene() before render()");
    options.validate();
    validateCamera(camera, "camera '" + camera.name + "'");
    if (options.dicingCamera) validateCamera(*options.dicingCamera, "dicing camera '" + options.dicingCamera->name + "'");
    if (options.mode == DiceMode::classical && impl_->patches.patches > impl_->patches.gregoryEnd) {
        throw Error(impl_->scene.name +
                    ": classical mode knows Bezier and Gregory patches alone, not rational ones or triangles; use --mode watertight");
    }
    try {
        return impl_->drawFrame(camera, options, progress);
    } catch (const cl::Error& error) {
        throw Error("the frame failed on " + impl_->session.device.info.name + ": " + error.what() + " gave " + clErrorName(error.err()));
    }
}

}  // namespace tessera
