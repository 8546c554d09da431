// Runs the split stage of the watertight mode alone, by each method, and shows what dicing makes of its ranges' borders.
#include "quad_rig.h"

#include "film/film.h"
#include "render/frame_setup.h"
#include "split/host_split.h"

#include <algorithm>
#include <bit>
#include <set>
#include <stdexcept>

namespace tessera::splitting {
namespace {

// Vertices around the largest grid, a multiple of any number of lanes.
constexpr std::size_t borderPlaces = std::size_t{4} * 32;
// Ranges a launch, which bounds the memory of a dump.
constexpr std::size_t rangesAtOnce = 1024;

constexpr const char* dumpKernel = R"(
// Walks around diced ranges as dice_hide does, and keeps what it finds: a work-group a range, 128 places each.
#include "device/lanes.clh"
#include "dice/quad_grid.clh"

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void dump_borders(
    frame_params frame, global const float* eye_points, global const placed_patch* patches, global const edge_info* records,
    global const quad_range* ranges, uint count, global int* u, global int* v, global int* place, global float* x, global float* y,
    global float* z) {
    for (uint r = (uint)get_group_id(0); r < count; r += (uint)get_num_groups(0)) {
        quad_range range = ranges[r];
        quad_domain domain = quad_domain_of(range);
        patch_ref patch = patch_at(&frame, eye_points, patches, records, range.patch_index);
        int vertices = QUAD_BORDER_VERTICES(&domain);
        for (int i = (int)get_local_id(0) * LANES; i < vertices; i += GROUP * LANES) {
            quad_border at = quad_border_vertices(&domain, i);
            vpoint p = patch_vertex(patch, at.u, at.v);
            size_t to = (size_t)r * 128 + (size_t)i;
            store_lanes(at.u, u + to);
            store_lanes(at.v, v + to);
            store_lanes(at.place, place + to);
            store_lanes(p.x, x + to);
            store_lanes(p.y, y + to);
            store_lanes(p.z, z + to);
        }
    }
}
)";

// Without the kernels of other stations, which take much longer to build.
KernelSources quadsAlone(KernelSources sources, Shape shape) {
    // split.cl for PoCL 3.1: without it LLVM crashes when it compiles quad_scatter.
    const std::set<std::string> kept = {"split/feed.cl",        "split/split.cl",      "split/quad_split.cl",
                                        "split/local_quads.cl", "split/local_book.cl", "surface/place.cl"};
    for (auto& [file, text] : sources) {
        if (file.ends_with(".cl") && !kept.contains(file)) text.clear();
    }
    sources.at("surface/evaluate.cl") = dumpKernel;
    if (shape == Shape::gpu) {
        std::string& lanes = sources.at("device/lanes.clh");
        lanes = "#undef GROUP\n#undef LANES\n#define GROUP 64\n#define LANES 1\n" + lanes;
    }
    return sources;
}

using Words = std::array<std::uint32_t, sizeof(quad_range) / 4>;

Words wordsOf(const quad_range& range) { return std::bit_cast<Words>(range); }

std::uint32_t bitsOf(float value) { return value == 0.0F ? 0U : std::bit_cast<std::uint32_t>(value); }

template <typename T>
std::vector<T> readAll(Timeline& timeline, const cl::Buffer& buffer, std::size_t count) {
    std::vector<T> values(count);
    if (count > 0) timeline.read(buffer, values.data(), count * sizeof(T));
    return values;
}

}  // namespace

std::vector<quad_range> sorted(std::vector<quad_range> ranges) {
    std::sort(ranges.begin(), ranges.end(), [](const quad_range& a, const quad_range& b) { return wordsOf(a) < wordsOf(b); });
    return ranges;
}

bool same(const std::vector<quad_range>& a, const std::vector<quad_range>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const quad_range& x, const quad_range& y) { return wordsOf(x) == wordsOf(y); });
}

QuadRig::QuadRig(KernelSources sources, Shape shape, int lanes)
    : session_(-1, quadsAlone(std::move(sources), shape), kernelCache(), lanes) {
    if (shape == Shape::gpu) session_.device.shape = {64, 1, session_.device.shape.groups};
}

void QuadRig::place(const Scene& scene, const Camera& camera, const RenderOptions& options) {
    if (options.mode != DiceMode::watertight) throw std::runtime_error("QuadRig needs options of the watertight mode");
    session_.timeline.finish();
    session_.timeline.restart(false);
    patches_ = uploadPatches(scene, session_.memory, session_.timeline);
    frame_ = setUpFrame(camera, options, layOutFilm(options), false);
    setPatches(frame_, patches_);
    // All patches, as the host splits them; and nothing is drawn that could hide any.
    frame_.feed_boxes = 0;
    frame_.occlusion = 0;
    patches_.dicingPoints = patches_.eyePoints;
    host_ = HostPatches{};
    host_.eyePoints = placeFor(scene, camera, patches_.eyePoints.cl());
    if (options.dicingCamera) {
        patches_.dicingPoints = session_.memory.allocate(Purpose::scene, "the patches in the dicing camera's space", patches_.eyeBytes());
        host_.dicingPoints = placeFor(scene, *options.dicingCamera, patches_.dicingPoints.cl());
    }
    host_.placed = readAll<placed_patch>(session_.timeline, patches_.placed.cl(), patches_.patches);
    host_.records = readAll<edge_info>(session_.timeline, patches_.records.cl(), patches_.recordCount);
}

std::vector<float> QuadRig::placeFor(const Scene& scene, const Camera& camera, const cl::Buffer& to) {
    const std::vector<placed_object> placed = placeObjects(scene, eyeFromWorld(camera));
    const std::size_t bytes = placed.size() * sizeof(placed_object);
    const DeviceBuffer objects = session_.memory.allocate(Purpose::scene, "the objects", bytes);
    session_.timeline.write(objects.cl(), placed.data(), bytes);
    enqueuePlace(session_, frame_, patches_, objects.cl(), to);
    return readAll<float>(session_.timeline, to, patches_.eyeBytes() / sizeof(float));
}

std::vector<Border> QuadRig::borders(const std::vector<quad_range>& diced) {
    std::vector<Border> borders;
    borders.reserve(diced.size());
    for (std::size_t first = 0; first < diced.size(); first += rangesAtOnce)
        dump(diced.data() + first, std::min(rangesAtOnce, diced.size() - first), borders);
    return borders;
}

void QuadRig::dump(const quad_range* diced, std::size_t count, std::vector<Border>& borders) {
    const std::size_t places = count * borderPlaces;
    const DeviceBuffer ranges = session_.memory.allocate(Purpose::scene, "diced ranges", count * sizeof(quad_range));
    std::array<DeviceBuffer, 6> out;
    for (DeviceBuffer& buffer : out) buffer = session_.memory.allocate(Purpose::scene, "a dump of borders", places * 4);
    session_.timeline.write(ranges.cl(), diced, count * sizeof(quad_range));
    session_.launch(
        session_.kernels.with("dump_borders", frame_, patches_.eyePoints.cl(), patches_.placed.cl(), patches_.records.cl(), ranges.cl(),
                              static_cast<cl_uint>(count), out[0].cl(), out[1].cl(), out[2].cl(), out[3].cl(), out[4].cl(), out[5].cl()),
        "dump_borders");
    std::array<std::vector<std::uint32_t>, 3> integers;
    std::array<std::vector<float>, 3> coordinates;
    for (std::size_t k = 0; k < 3; ++k) {
        integers[k] = readAll<std::uint32_t>(session_.timeline, out[k].cl(), places);
        coordinates[k] = readAll<float>(session_.timeline, out[3 + k].cl(), places);
    }
    for (std::size_t r = 0; r < count; ++r) {
        const std::uint32_t sizes = diced[r].sizes;
        Border& border = borders.emplace_back(std::size_t{2} * ((1U << byteOf(sizes, 2)) + (1U << byteOf(sizes, 3))));
        for (std::size_t i = 0; i < border.size(); ++i) {
            const std::size_t at = r * borderPlaces + i;
            border[i] = {integers[0][at],
                         integers[1][at],
                         integers[2][at],
                         {bitsOf(coordinates[0][at]), bitsOf(coordinates[1][at]), bitsOf(coordinates[2][at])}};
        }
    }
}

QuadPass::QuadPass(QuadRig& rig, split_limits limits, std::uint64_t spare)
    : rig_(rig),
      limits_(limits),
      bound_((2 * std::uint64_t{rig.frame().level_most} + 1) * limits.batch),
      spare_(spare),
      queues_(rig.session()) {
    queues_.setMode(DiceMode::watertight);
    queues_.reserve(limits_, bound_ + spare_);
    queues_.restart();
    queues_.enqueueFeed(rig.frame(), rig.patches());
    state_ = queues_.readState();
    spareAtFirst_ = readSpare();
}

void QuadPass::step() {
    queues_.enqueueIteration(rig_.frame(), limits_, rig_.patches());
    state_ = queues_.readState();
}

void QuadPass::stepBreadth() {
    const std::uint32_t all = state_.stack_count + (state_.feed_count - state_.next_input);
    queues_.growStack(2 * std::uint64_t{all}, state_.stack_count);
    queues_.reserve({all, all, all}, 0);
    queues_.enqueueIteration(rig_.frame(), {all, all, all}, rig_.patches());
    state_ = queues_.readState();
}

std::vector<quad_range> QuadPass::takeReady() {
    std::vector<quad_range> ready = readAll<quad_range>(rig_.session().timeline, queues_.ready(), state_.ready_count);
    state_.ready_count = 0;
    queues_.writeState(state_);
    return ready;
}

std::vector<quad_range> QuadPass::readSpare() {
    if (spare_ == 0) return {};
    const std::vector<quad_range> all = queues_.readStack<quad_range>(bound_ + spare_);
    return {all.begin() + static_cast<std::ptrdiff_t>(bound_), all.end()};
}

namespace {

template <typename Step>
QuadsFound findAll(QuadPass& pass, const Step& step) {
    QuadsFound found;
    while (!pass.over()) {
        step(pass);
        const std::vector<quad_range> ready = pass.takeReady();
        found.diced.insert(found.diced.end(), ready.begin(), ready.end());
    }
    found.processed = pass.processed();
    found.culled = pass.culled();
    return found;
}

}  // namespace

QuadsFound findBounded(QuadRig& rig, std::uint32_t p) {
    QuadPass pass(rig, {p, 2 * p, p}, 0);
    return findAll(pass, [](QuadPass& one) { one.step(); });
}

QuadsFound findBreadth(QuadRig& rig) {
    QuadPass pass(rig, {1, 1, 1}, 0);
    return findAll(pass, [](QuadPass& one) { one.stepBreadth(); });
}

QuadsFound findOnHost(const QuadRig& rig, unsigned threads) {
    HostSplit<WatertightRule> split(WatertightRule(rig.frame(), rig.host()), threads);
    QuadsFound found;
    for (std::vector<quad_range> next = split.next(1000); !next.empty(); next = split.next(1000))
        found.diced.insert(found.diced.end(), next.begin(), next.end());
    found.processed = split.counts().processed;
    found.culled = split.counts().culled;
    return found;
}

}  // namespace tessera::splitting
