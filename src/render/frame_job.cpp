#include "render/frame_job.h"

#include <algorithm>
#include <tuple>

#include "render/frame_setup.h"
#include "render/plan_memory.h"
#include "render/run_ahead.h"
#include "shade/shade.h"

namespace tessera {
namespace {

// Ranges that are collected before they are drawn where that tells what else is hidden: the fewer, the sooner it is known, but each time
// the tiles that were touched are looked at again.
constexpr std::uint32_t collectLeast = 1024;

// How far a bucket of a streamed scene counts as done when all is hidden and its chunks come back to be shaded.
constexpr double splitShare = 0.9;

// Whether two plans' buffers are of the same sizes, within the same budget.
bool sameRoom(const MemoryPlan& a, const MemoryPlan& b) {
    const auto room = [](const MemoryPlan& plan) {
        // Breadth's queues have grown within the budget, and beside the scene.
        return std::tuple(plan.budget, plan.bytes.scene, plan.bytes.queues, plan.bytes.film, plan.bytes.picture, plan.batch,
                          plan.readyCapacity, plan.bucketWidth, plan.bucketHeight, plan.chunkPatches, plan.chunks);
    };
    return room(a) == room(b);
}

}  // namespace

Stations::Stations(const RendererSettings& settings)
    : session(settings.device, kernelSources(), cacheFolder(settings.cacheKernels, settings.cacheFolder), settings.lanes),
      stream(session),
      queues(session),
      local(session),
      film(session),
      picture(session) {}

FrameJob::FrameJob(Stations& stations, const Camera& camera, const RenderOptions& options, const MemoryPlan& plan, const Progress& progress)
    : stations_(stations), camera_(camera), options_(options), plan_(plan), progress_(progress) {
    const glm::dmat4 view = eyeFromWorld(camera);
    placed_ = placeObjects(stations.scene, view);
    if (options.dicingCamera) dicing_ = placeObjects(stations.scene, eyeFromWorld(*options.dicingCamera));
    lights_ = placeLights(stations.scene, view, options.headlight);
}

FrameJob::~FrameJob() {
    if (ended_) return;
    try {
        stations_.session.timeline.finish();
    } catch (const cl::Error&) {
        return;  // the device is gone: nothing reads this job's memory any more
    }
}

Statistics FrameJob::run() {
    reserve();
    stations_.film.distrust();
    const auto start = Clock::now();
    beginFrame();
    for (int bucket = 0; bucket < plan_.buckets(); ++bucket) drawBucket(bucket);
    ended_ = true;
    const double frameMs = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    stations_.film.trust();
    return statistics(frameMs);
}

split_limits FrameJob::limits(const frame_params& frame) const {
    split_limits limits = queueRoom(options_, plan_.batch, stations_.session.device.info).limits;
    if (options_.method == SplitMethod::cpu) limits.batch = plan_.batch;
    if (frame.occlusion != 0) limits.collect = std::max(collectLeast, plan_.batch / 4);
    return limits;
}

// Lets go of what frames of another plan left, so that the sum never passes the budget, and makes room.
void FrameJob::reserve() {
    DeviceMemory& memory = stations_.session.memory;
    if (!sameRoom(stations_.lastPlan, plan_)) {
        stations_.film.release();
        stations_.queues.release();
        stations_.local.release();
        stations_.picture.release();
        stations_.lights = DeviceBuffer();
        stations_.chunksSeen = DeviceBuffer();
    }
    PictureBuffer::requireRoom(cropWindow(options_), plan_.bucketWidth, plan_.bucketHeight, options_.aovs);
    memory.setBudget(plan_.budget);
    stations_.stream.reserve(plan_.chunkPatches, options_.dicingCamera.has_value());
    memory.restartPeak();
    stations_.lastPlan = plan_;
    const bool normals = plan_.streamed() && contains(options_.aovs, Aov::normal);
    const bool coarse = options_.mode == DiceMode::watertight && options_.occlusion;
    stations_.film.prepare(layOutFilm({0, 0, plan_.bucketWidth, plan_.bucketHeight}, options_.pixelSamples), {normals, coarse});
    stations_.queues.setMode(options_.mode);
    const QueueRoom room = queueRoom(options_, plan_.batch, stations_.session.device.info);
    stations_.queues.reserve(room.limits, room.stack);
    if (options_.method == SplitMethod::local)
        stations_.local.reserve(localShape(stations_.session.device.info, options_.mode), options_.mode);
    memory.ensure(stations_.lights, Purpose::scene, "the lights", lights_.size() * sizeof(eye_light), CL_MEM_READ_ONLY);
    if (plan_.streamed())
        memory.ensure(stations_.chunksSeen, Purpose::scene, "which chunks are seen", std::uint64_t{plan_.chunks} * sizeof(cl_uint));
    stations_.picture.prepare(cropWindow(options_), plan_.bucketWidth, plan_.bucketHeight, options_.aovs);
}

void FrameJob::beginFrame() {
    stations_.stream.beginFrame(placed_, dicing_);
    stations_.session.timeline.writeLater(stations_.lights.cl(), lights_.data(), lights_.size() * sizeof(eye_light));
    stations_.queues.restart();
    if (options_.method == SplitMethod::local) stations_.local.restart();
}

void FrameJob::drawBucket(int bucket) {
    const FilmLayout layout = bucketLayout(options_, plan_, bucket);
    frame_params frame = setUpFrame(camera_, options_, layout, feedsByBoxes());
    frame.lights = static_cast<uint>(lights_.size());
    if (frame.occlusion != 0) stations_.film.enqueueForgetDepth(layout);
    if (plan_.streamed()) {
        splitChunks(frame);
        shadeChunks(frame, layout);
    } else {
        drawResident(frame, layout);
    }
    bucketsDone_ = bucket + 1;
}

// Boxes are worth their while where a bucket needs few of the patches, or the first batch does not hold all: else bounding tells as much.
// Classical mode counts every patch as bounded, as the original did, but for those that can't reach a bucket.
bool FrameJob::feedsByBoxes() const {
    if (plan_.buckets() > 1) return true;
    return options_.mode == DiceMode::watertight && (plan_.streamed() || stations_.stream.source().patches() > plan_.batch);
}

void FrameJob::drawResident(frame_params& frame, const FilmLayout& layout) {
    const PatchSet& patches = stations_.stream.use(0, frame);
    split(frame, patches, 0.0, 1.0, {}, [&] {
        // Shaded after every burst, the picture is mapped from the one before.
        stations_.picture.unmap();
        enqueueShade(stations_.session, frame, PictureBuffer::planesOf(layout, options_.aovs),
                     {patches, stations_.lights.cl(), stations_.queues}, stations_.film, stations_.picture.cl());
        takeBucket(layout);
    });
}

void FrameJob::tell(std::string_view stage, double fractionOfBucket) const {
    if (progress_) progress_(stage, (bucketsDone_ + fractionOfBucket) / plan_.buckets());
}

void FrameJob::takeBucket(const FilmLayout& layout) {
    // There when the picture is, which comes after it.
    static_cast<void>(stations_.queues.readStateLater(counts_));
    stations_.picture.fetch(layout);
}

void FrameJob::splitChunks(frame_params& frame) {
    std::vector<std::uint32_t> chunks;
    for (std::uint32_t k = 0; k < plan_.chunks; ++k)
        if (stations_.stream.mayShow(k, frame)) chunks.push_back(k);
    for (std::size_t k = 0; k < chunks.size(); ++k) {
        const PatchSet& patches = stations_.stream.use(chunks[k], frame);
        const double share = splitShare / static_cast<double>(chunks.size());
        const auto meanwhile = [&] {
            if (k + 1 < chunks.size()) stations_.stream.prefetch(chunks[k + 1]);
        };
        split(frame, patches, static_cast<double>(k) * share, share, meanwhile, {});
    }
}

void FrameJob::split(const frame_params& frame, const PatchSet& patches, double before, double share,
                     const std::function<void()>& meanwhile, const std::function<void()>& finish) {
    stations_.queues.enqueueFeed(frame, patches);
    SplitLoop loop{stations_.session, stations_.queues, stations_.film, frame, patches, options_, limits(frame), {}, meanwhile, finish};
    loop.buckets = plan_.buckets();
    if (progress_) {
        loop.report = [this, before, share](double fraction) { tell("split and dice", before + share * fraction); };
    }
    switch (options_.method) {
        case SplitMethod::cpu:
            return report_.add(runCpu(loop));
        case SplitMethod::breadth:
            return report_.add(runBreadth(loop));
        case SplitMethod::local:
            return report_.add(runLocal(loop, stations_.local));
        case SplitMethod::bounded:
            break;
    }
    report_.add(runBounded(loop));
}

// The chunks that any sample of the bucket shows.
std::vector<std::uint32_t> FrameJob::chunksSeen(const frame_params& frame) {
    Timeline& timeline = stations_.session.timeline;
    std::vector<cl_uint> flags(plan_.chunks);
    enqueueMarkChunks(stations_.session, frame, stations_.film, plan_.chunkPatches, plan_.chunks, stations_.chunksSeen.cl());
    timeline.read(stations_.chunksSeen.cl(), flags.data(), flags.size() * sizeof(cl_uint));
    ++report_.hostWaits;
    std::vector<std::uint32_t> seen;
    for (std::uint32_t k = 0; k < plan_.chunks; ++k)
        if (flags[k] != 0) seen.push_back(k);
    return seen;
}

void FrameJob::shadeChunks(frame_params& frame, const FilmLayout& layout) {
    const picture_planes planes = PictureBuffer::planesOf(layout, options_.aovs);
    const std::vector<std::uint32_t> seen = chunksSeen(frame);
    for (std::size_t k = 0; k < seen.size(); ++k) {
        const PatchSet& patches = stations_.stream.use(seen[k], frame, Placing::toShade);
        enqueueShadeChunk(stations_.session, frame, planes, {patches, stations_.lights.cl(), stations_.queues}, stations_.film,
                          stations_.picture.cl());
        stations_.session.timeline.flush();
        if (k + 1 < seen.size()) stations_.stream.prefetch(seen[k + 1]);
        tell("shade", splitShare + (1.0 - splitShare) * static_cast<double>(k + 1) / static_cast<double>(seen.size()));
    }
    enqueueFilter(stations_.session, frame, planes, stations_.queues, stations_.film, stations_.picture.cl());
    takeBucket(layout);
    ++report_.hostWaits;
}

Statistics FrameJob::statistics(double frameMs) {
    const bool watertight = options_.mode == DiceMode::watertight;
    Statistics s;
    s.device = stations_.session.device.info.name;
    s.width = options_.width;
    s.height = options_.height;
    s.method = name(options_.method);
    s.batch = plan_.batch;
    s.mode = name(options_.mode);
    s.shadingRate = watertight ? options_.shadingRate : 0.0F;
    s.gridSize = watertight ? options_.gridSize : 0;
    s.pixelSamples = options_.pixelSamples;
    s.patches = stations_.stream.source().patches();
    s.frameMs = frameMs;
    s.buildMs = stations_.session.kernels.buildMilliseconds();
    s.kernelMs = stations_.session.timeline.milliseconds();
    s.splitMs = report_.hostMs;
    for (const auto& [label, milliseconds] : s.kernelMs) {
        for (const char* const station : {"split_", "quad_", "feed_", "local_"})
            if (label.starts_with(station)) s.splitMs += milliseconds;
    }
    addCounts(s);
    addResources(s);
    if (options_.trace) s.trace = stations_.session.timeline.trace();
    return s;
}

void FrameJob::addCounts(Statistics& s) {
    const split_state& counts = counts_;
    s.rangesProcessed = wide(counts.processed_low, counts.processed_high);
    s.rangesDiced = wide(counts.diced_low, counts.diced_high);
    s.rangesCulled = wide(counts.culled_low, counts.culled_high);
    s.rangesOccluded = wide(counts.occluded_low, counts.occluded_high);
    s.patchesSkipped = wide(counts.skipped_low, counts.skipped_high);
    s.stackPeak = counts.stack_peak;
    s.iterations = counts.iterations;
    s.batches = counts.batches;
    s.micropolygons = options_.mode == DiceMode::watertight
                          ? wide(counts.micropolygons_low, counts.micropolygons_high)
                          : s.rangesDiced * static_cast<std::uint64_t>(options_.diceRate * options_.diceRate);
    s.pixelsCovered = counts.pixels_covered;
    if (options_.method == SplitMethod::local) {
        s.launches = counts.iterations;
        s.groupRanges = stations_.local.groupRanges();
    }
}

void FrameJob::addResources(Statistics& s) const {
    s.hostWaits = report_.hostWaits + stations_.stream.waits();
    s.buckets = static_cast<std::uint64_t>(plan_.buckets());
    s.bucketWidth = plan_.bucketWidth;
    s.bucketHeight = plan_.bucketHeight;
    s.chunks = plan_.chunks;
    s.streamedBytes = stations_.stream.uploadedBytes();
    s.stackGrowths = report_.stackGrowths;
    const DeviceMemory& memory = stations_.session.memory;
    const MemoryUse use = memory.peakUse();
    s.deviceBytesBudget = plan_.budget;
    s.deviceBytesPeak = memory.peakBytes();
    s.deviceBytes = {{"scene", use.scene}, {"queues", use.queues}, {"film", use.film}, {"picture", use.picture}};
}

}  // namespace tessera
