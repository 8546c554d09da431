// The split stage of the watertight mode: the host decides as the device does, the stack keeps its bound and its order, and hulls hold the
// surface, so that nothing in sight is culled.
#include "quad_rig.h"
#include "split_adversary.h"

#include "closed_models.h"
#include "patch_eval.h"
#include "ray_caster.h"
#include "sample_meshes.h"

#include "render/frame_setup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace tessera::splitting {
namespace {

using reference::Random;

constexpr std::uint32_t unit = 1U << 24U;

std::uint32_t below(Random& random, std::uint32_t end) { return static_cast<std::uint32_t>(random.unit() * end); }

// Patches of every kind in a cube of 2 around the origin, Gregory patches with blends that are truly rational.
Scene everyKind(std::uint64_t seed, std::size_t patches) {
    const Mesh bezier = reference::bumpyBezierMesh(seed, patches);
    const Mesh gregory = reference::parted(reference::asGregory(reference::bumpyBezierMesh(seed + 1, patches)), 0.3, seed + 2);
    return reference::sceneOf({bezier, gregory, reference::weighted(reference::bumpyBezierMesh(seed + 3, patches), 3.0, seed + 4),
                               reference::bumpyPnMesh(seed + 5, patches)});
}

struct Sight {
    std::string name;
    Camera camera;
};

std::vector<Sight> sights() {
    std::vector<Sight> result{{"outside", reference::cameraAt({0.5, 1, 5}, {0, 0, 0}, 35)},
                              {"among them", reference::cameraAt({0.1, 0.2, 0.3}, {0, 0, -1}, 60)},
                              {"half behind", reference::cameraAt({0, 0, -0.2}, {0.3, 0, -2}, 90)},
                              {"close", reference::cameraAt({0.3, 0.4, 1.2}, {0.2, 0.3, 0}, 15)},
                              {"aside", reference::cameraAt({0, 0, 5}, {2.2, 0.4, 0}, 30)}};
    result[2].camera.near = 0.2F;
    return result;
}

RenderOptions optionsOf(float shadingRate, int gridSize) {
    RenderOptions options;
    options.mode = DiceMode::watertight;
    options.width = 160;
    options.height = 90;
    options.pixelSamples = 1;
    options.shadingRate = shadingRate;
    options.gridSize = gridSize;
    return options;
}

// A quadrilateral whose corners lie on those of a box of a random size, turned, or a triangle with a corner twice, or anything convex:
// what cuts make of a patch, and more.
quad_range anyRange(const frame_params& frame, Random& random) {
    quad_range range = wholePatch(frame, below(random, frame.patches));
    const bool triangle = range.patch_index >= frame.rational_end;
    const double size = std::exp2(-12.0 * random.unit() * random.unit());
    const double u0 = random.between(0.0, 1.0 - size), v0 = random.between(0.0, (triangle ? 1.0 - u0 : 1.0) - size);
    const std::array<std::array<double, 2>, 4> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    const std::uint32_t turn = below(random, 4);
    const bool skewed = below(random, 2) == 0;
    for (std::uint32_t k = 0; k < 4; ++k) {
        std::array<double, 2> at = square[(k + turn) & 3U];
        if (skewed)
            for (double& t : at) t = 0.5 + (t - 0.5) * random.between(0.55, 1.0);
        if (triangle && at[0] + at[1] > 1.0) at = {at[0] / (at[0] + at[1]), at[1] / (at[0] + at[1])};
        range.corner_u[k] = static_cast<std::uint32_t>(std::floor(unit * std::max(0.0, u0 + size * at[0])));
        range.corner_v[k] = static_cast<std::uint32_t>(std::floor(unit * std::max(0.0, v0 + size * at[1])));
    }
    if (below(random, 4) == 0) {
        const std::uint32_t k = below(random, 4);
        range.corner_u[k] = range.corner_u[(k + 1) & 3U];
        range.corner_v[k] = range.corner_v[(k + 1) & 3U];
    }
    range.rates = 0;
    for (std::uint32_t k = 0; k < 4; ++k) {
        const bool open = below(random, 3) == 0;
        range.rates |= (open ? RATE_NONUNIFORM : below(random, frame.grid_bits + 2)) << (8U * k);
    }
    // An edge that is not uniform has been cut less than L times.
    range.sizes = below(random, frame.level_most) | (below(random, frame.level_most) << 8U);
    return range;
}

// What an iteration makes of the fresh patches and of ranges that stand on a stack of the test's own, in order.
struct Made {
    std::vector<quad_range> children;
    std::vector<quad_range> ready;
};

Made iterateOnDevice(QuadRig& rig, const std::vector<quad_range>& ranges) {
    DeviceSession& session = rig.session();
    const PatchSet& patches = rig.patches();
    const auto count = static_cast<std::uint32_t>(ranges.size()) + patches.patches;
    const auto buffer = [&](std::size_t bytes) { return session.memory.allocate(Purpose::scene, "a test's buffer", bytes); };
    const DeviceBuffer stack = buffer(std::size_t{2} * count * sizeof(quad_range));
    const DeviceBuffer batch = buffer(count * sizeof(quad_range));
    const DeviceBuffer ready = buffer(count * sizeof(quad_range));
    const DeviceBuffer actions = buffer(count);
    const DeviceBuffer cuts = buffer(count * sizeof(quad_cut));
    const DeviceBuffer sums = buffer((count / SPLIT_CHUNK + 1) * sizeof(chunk_sum));
    const DeviceBuffer stateBuffer = buffer(sizeof(split_state));
    const DeviceBuffer stateAfter = buffer(sizeof(split_state));
    std::vector<std::uint32_t> feed(patches.patches);
    std::iota(feed.begin(), feed.end(), 0U);
    if (!feed.empty()) session.timeline.write(patches.feed.cl(), feed.data(), feed.size() * sizeof(std::uint32_t));
    split_state state{};
    state.stack_count = static_cast<std::uint32_t>(ranges.size());
    state.feed_count = patches.patches;
    session.timeline.write(stack.cl(), ranges.data(), ranges.size() * sizeof(quad_range));
    session.timeline.write(stateBuffer.cl(), &state, sizeof state);
    const split_limits limits{count, count, count};
    session.launch(session.kernels.with("quad_bound", rig.frame(), limits, patches.eyePoints.cl(), patches.dicingPoints.cl(),
                                        patches.placed.cl(), patches.records.cl(), patches.feed.cl(), sums.cl(), stack.cl(), batch.cl(),
                                        actions.cl(), cuts.cl(), sums.cl(), stateBuffer.cl()),
                   "quad_bound");
    session.launch(session.kernels.with("split_scan", limits, sums.cl(), stateBuffer.cl(), stateAfter.cl()), "split_scan", 1);
    session.launch(session.kernels.with("quad_scatter", limits, batch.cl(), actions.cl(), cuts.cl(), sums.cl(), stateBuffer.cl(),
                                        stack.cl(), ready.cl()),
                   "quad_scatter");
    session.timeline.read(stateAfter.cl(), &state, sizeof state);
    Made made;
    made.children.resize(state.stack_count);
    made.ready.resize(state.ready_count);
    if (!made.children.empty()) session.timeline.read(stack.cl(), made.children.data(), made.children.size() * sizeof(quad_range));
    if (!made.ready.empty()) session.timeline.read(ready.cl(), made.ready.data(), made.ready.size() * sizeof(quad_range));
    return made;
}

Made iterateOnHost(const QuadRig& rig, const std::vector<quad_range>& ranges, std::array<int, 4>& actions) {
    std::vector<quad_range> all;
    for (std::uint32_t k = 0; k < rig.patches().patches; ++k) all.push_back(wholePatch(rig.frame(), k));
    all.insert(all.end(), ranges.begin(), ranges.end());
    Made made;
    for (const quad_range& range : all) {
        const QuadStep step = splitOnHost(rig.frame(), rig.host(), range);
        ++actions.at(static_cast<std::size_t>(step.action));
        if (step.action == 1) made.ready.push_back(step.diced);
        if (step.action >= 2) made.children.insert(made.children.end(), step.children.begin(), step.children.end());
    }
    return made;
}

void expectSameDecisions(QuadRig&& rig) {
    Random random(11);
    std::array<int, 4> actions{};
    for (const Sight& sight : sights()) {
        for (const bool apart : {false, true}) {
            SCOPED_TRACE(sight.name + (apart ? ", measured from elsewhere" : ""));
            RenderOptions options = optionsOf(apart ? 4.0F : 1.0F, 1 << below(random, 6));
            if (apart) options.dicingCamera = sights()[1].camera;
            rig.place(everyKind(20, 30), sight.camera, options);
            std::vector<quad_range> ranges(1500);
            for (quad_range& range : ranges) range = anyRange(rig.frame(), random);
            const Made device = iterateOnDevice(rig, ranges);
            const Made host = iterateOnHost(rig, ranges, actions);
            EXPECT_TRUE(same(device.children, host.children));
            EXPECT_TRUE(same(device.ready, host.ready));
        }
    }
    for (const int times : actions) EXPECT_GT(times, 500);
}

TEST(QuadHost, SplitsAsTheDevice) { expectSameDecisions(QuadRig(kernelSources())); }

TEST(QuadHost, SplitsAsTheDeviceOfEightLanes) { expectSameDecisions(QuadRig(kernelSources(), Shape::native, 8)); }

TEST(QuadHost, SplitsAsTheDeviceInTheShapeOfGpus) { expectSameDecisions(QuadRig(kernelSources(), Shape::gpu)); }

// Edges whose rates are hashes of what they measure, so that trees of ranges are deep and ragged.
KernelSources hashedRates() {
    return replaced(kernelSources(), {{"split/quad_measure.clh", "uint rate = rate_of_length(frame, edge_length(frame, longest, bulge));",
                                       "uint hash = as_uint(length) * 2654435769u; hash ^= hash >> 15; hash *= 2246822519u;"
                                       "uint rate = RATE_ONE + (hash >> 20) % (frame->grid_bits + 4u);"}});
}

// What must hold between iterations: ranges in the order of their cuts, at most (i + 1) p of i cuts or fewer, at most (2 L + 1) p in all.
void expectSoundStack(QuadPass& pass, std::uint32_t p, std::uint32_t levelMost) {
    const std::vector<quad_range> stack = pass.stack();
    ASSERT_LE(stack.size(), pass.bound());
    std::uint32_t last = 0;
    for (std::size_t k = 0; k < stack.size(); ++k) {
        const std::uint32_t cuts = cutsOf(stack[k]);
        ASSERT_GE(cuts, last);
        ASSERT_LE(std::max(byteOf(stack[k].sizes, 0), byteOf(stack[k].sizes, 1)), levelMost);
        ASSERT_LE(k + 1, (std::uint64_t{cuts} + 1) * p);
        last = cuts;
    }
}

// Each range is somewhere, once, after every iteration; returns the largest stack.
std::size_t expectSoundPass(QuadRig& rig, split_limits limits, const std::vector<quad_range>& expected) {
    QuadPass pass(rig, limits, 2 * std::uint64_t{limits.batch});
    std::vector<quad_range> diced;
    std::size_t largest = 0;
    while (!pass.over() && !::testing::Test::HasFatalFailure()) {
        pass.step();
        expectSoundStack(pass, limits.batch, rig.frame().level_most);
        const split_state& state = pass.state();
        const std::uint64_t splits = pass.processed() - pass.diced() - pass.culled();
        EXPECT_EQ(state.next_input + 2 * splits, pass.processed() + state.stack_count);
        largest = std::max<std::size_t>(largest, state.stack_count);
        if (limits.ready_capacity - state.ready_count >= limits.batch) continue;
        const std::vector<quad_range> ready = pass.takeReady();
        diced.insert(diced.end(), ready.begin(), ready.end());
    }
    const std::vector<quad_range> rest = pass.takeReady();
    diced.insert(diced.end(), rest.begin(), rest.end());
    EXPECT_TRUE(same(sorted(diced), expected)) << "ranges were lost, or came twice";
    EXPECT_TRUE(pass.spareUntouched()) << "an iteration wrote behind the stack's bound";
    EXPECT_NEAR(static_cast<double>(pass.state().area_done), rig.patches().patches, 0.01);
    return largest;
}

TEST(QuadStack, OrderAndBoundHoldAfterEveryIteration) {
    QuadRig plain(kernelSources());
    QuadRig hashed(hashedRates());
    std::size_t fullest = 0;
    for (QuadRig* const rig : {&plain, &hashed}) {
        for (const Sight& sight : {sights()[0], sights()[2]}) {
            rig->place(everyKind(40, 12), sight.camera, optionsOf(rig == &plain ? 1.0F : 16.0F, 4));
            rig->setLevelMost(rig == &plain ? QUAD_LEVEL_MOST : 5);
            const std::vector<quad_range> expected = sorted(findBreadth(*rig).diced);
            EXPECT_GT(expected.size(), 500U);
            for (const std::uint32_t p : {20U, 64U, 257U, 1500U}) {
                SCOPED_TRACE(sight.name + ", p " + std::to_string(p));
                const std::size_t largest = expectSoundPass(*rig, {p, p + p / 2, p}, expected);
                fullest = std::max(fullest, largest / p);
            }
        }
    }
    EXPECT_GE(fullest, 4U) << "the trees must be deep enough to fill the stack";
}

struct InView {
    const QuadRig& rig;
    const Scene& scene;
    glm::dmat4 eyeFromWorld;

    // Whether a point of the surface is in the picture, beyond the near plane.
    [[nodiscard]] bool operator()(std::uint32_t patch, double u, double v) const {
        const placed_patch& placed = rig.host().placed[patch];
        const Mesh& mesh = scene.meshes[placed.object];
        const std::vector<glm::dvec3> points = reference::patchPoints(mesh, placed.index_in_mesh);
        const std::vector<double> weights = reference::patchWeights(mesh, placed.index_in_mesh);
        const glm::dvec3 world = reference::evaluate(mesh.kind, points, u, v, weights).position;
        const glm::dvec3 eye(eyeFromWorld * glm::dvec4(world, 1.0));
        const frame_params& frame = rig.frame();
        const auto focal = static_cast<double>(frame.focal);
        return eye.z > 1.000001 * static_cast<double>(frame.near_plane) && std::abs(focal * eye.x) < 0.5 * frame.width * eye.z &&
               std::abs(focal * eye.y) < 0.5 * frame.height * eye.z;
    }
};

// Whether any of some points of the range, at its corners and within, is in view.
bool anyInView(const InView& inView, const quad_range& range, Random& random) {
    for (int k = 0; k < 24; ++k) {
        const int column = k % 2, row = k / 2;
        const double s = k < 4 ? column : random.unit(), t = k < 4 ? row : random.unit();
        const std::array<double, 4> weight{(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
        double u = 0.0, v = 0.0;
        for (std::size_t c = 0; c < 4; ++c) {
            u += weight[c] * range.corner_u[c] / unit;
            v += weight[c] * range.corner_v[c] / unit;
        }
        if (inView(range.patch_index, u, v)) return true;
    }
    return false;
}

TEST(QuadCull, TakesNothingInSightAndMostOfWhatIsNot) {
    QuadRig rig(kernelSources());
    Random random(50);
    int seen = 0, unseen = 0, culled = 0;
    for (const Sight& sight : sights()) {
        const Scene scene = everyKind(60, 40);
        rig.place(scene, sight.camera, optionsOf(1.0F, 16));
        const InView inView{rig, scene, eyeFromWorld(sight.camera)};
        for (int k = 0; k < 2500; ++k) {
            const quad_range range = anyRange(rig.frame(), random);
            const bool gone = splitOnHost(rig.frame(), rig.host(), range).action == 0;
            const bool visible = anyInView(inView, range, random);
            ASSERT_FALSE(gone && visible) << sight.name << ", patch " << range.patch_index << ", sizes " << range.sizes;
            seen += visible ? 1 : 0;
            unseen += visible ? 0 : 1;
            culled += gone ? 1 : 0;
        }
    }
    EXPECT_GT(seen, 2000);
    EXPECT_GT(culled, unseen * 8 / 10) << "of " << unseen << " out of sight";
    RecordProperty("culled", culled);
    RecordProperty("unseen", unseen);
}

}  // namespace
}  // namespace tessera::splitting
