// Runs the split stage alone, one iteration at a time.
#include "split_rig.h"

#include "film/film.h"
#include "render/frame_setup.h"
#include "split/bound_host.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace tessera::splitting {
namespace {

// Without the kernels of other stations, which take much longer to build.
KernelSources splitAlone(KernelSources sources) {
    for (auto& [file, text] : sources) {
        const bool kept = file == "split/split.cl" || file == "split/feed.cl" || file == "split/local_boxes.cl" ||
                          file == "split/local_book.cl" || file == "surface/place.cl" || file == "surface/boxes.cl";
        if (file.ends_with(".cl") && !kept) text.clear();
    }
    return sources;
}

// The kernels' text decides their shape anew, whatever the build options say.
KernelSources shaped(KernelSources sources, Shape shape) {
    if (shape == Shape::native) return sources;
    const auto lanes = sources.find("device/lanes.clh");
    if (lanes == sources.end()) throw std::runtime_error("device/lanes.clh is not among the kernels");
    lanes->second = "#undef GROUP\n#undef LANES\n#define GROUP 64\n#define LANES 1\n" + lanes->second;
    return sources;
}

}  // namespace

std::filesystem::path kernelCache() {
    return std::getenv("TESSERA_CACHE") == nullptr ? std::filesystem::path(TESSERA_TEST_CACHE) : defaultCacheFolder();
}

SplitRig::SplitRig(KernelSources sources, Shape shape) : session_(-1, shaped(splitAlone(std::move(sources)), shape), kernelCache()) {
    if (shape == Shape::gpu) session_.device.shape = {64, 1, session_.device.shape.groups};
}

void SplitRig::place(const Scene& scene, const Camera& camera, const RenderOptions& options) {
    session_.timeline.finish();
    session_.timeline.restart(false);
    patches_ = uploadPatches(scene, session_.memory, session_.timeline);
    frame_ = setUpFrame(camera, options, layOutFilm(options), false);
    setPatches(frame_, patches_);
    eyePoints_.clear();
    if (patches_.patches == 0) return;
    const std::vector<placed_object> placed = placeObjects(scene, eyeFromWorld(camera));
    const std::size_t bytes = placed.size() * sizeof(placed_object);
    const DeviceBuffer objects = session_.memory.allocate(Purpose::scene, "the objects", bytes);
    session_.timeline.write(objects.cl(), placed.data(), bytes);
    enqueuePlace(session_, frame_, patches_, objects.cl(), patches_.eyePoints.cl());
    eyePoints_.resize(patches_.eyeBytes() / sizeof(float));
    session_.timeline.read(patches_.eyePoints.cl(), eyePoints_.data(), eyePoints_.size() * sizeof(float));
}

Decide SplitRig::hostBound() const {
    return [this](const range_t& range) {
        const std::size_t bezier = std::min(range.patch_index, frame_.bezier_patches);
        const std::size_t gregory = range.patch_index - bezier;
        const float* const net = eyePoints_.data() + bezier * 3 * BEZIER_POINTS + gregory * 3 * GREGORY_POINTS;
        return boundOnHost(frame_, net, range.patch_index < frame_.bezier_patches ? BEZIER_POINTS : GREGORY_POINTS, range);
    };
}

SplitPass::SplitPass(SplitRig& rig, split_limits limits, std::uint64_t spare)
    : rig_(rig), limits_(limits), bound_((std::uint64_t{rig.frame().max_depth} + 1) * limits.batch), spare_(spare), queues_(rig.session()) {
    queues_.reserve(limits_, bound_ + spare_);
    queues_.restart();
    queues_.enqueueFeed(rig.frame(), rig.patches());
    state_ = queues_.readState();
    spareAtFirst_ = readSpare();
}

void SplitPass::step() {
    queues_.enqueueIteration(rig_.frame(), limits_, rig_.patches());
    state_ = queues_.readState();
}

void SplitPass::stepBreadth() {
    const std::uint32_t all = state_.stack_count + (state_.feed_count - state_.next_input);
    queues_.growStack(2 * std::uint64_t{all}, state_.stack_count);
    queues_.reserve({all, all, all}, 0);
    queues_.enqueueIteration(rig_.frame(), {all, all, all}, rig_.patches());
    state_ = queues_.readState();
}

std::vector<range_t> SplitPass::takeReady() {
    std::vector<range_t> ready(state_.ready_count);
    if (!ready.empty()) rig_.session().timeline.read(queues_.ready(), ready.data(), ready.size() * sizeof(range_t));
    state_.ready_count = 0;
    queues_.writeState(state_);
    return ready;
}

std::vector<range_t> SplitPass::readSpare() {
    std::vector<range_t> all = queues_.readStack(bound_ + spare_);
    return {all.begin() + static_cast<std::ptrdiff_t>(bound_), all.end()};
}

}  // namespace tessera::splitting
