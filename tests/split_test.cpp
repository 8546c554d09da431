// Bound and split with the real bounding: the host decides as the device does, and every method finds the same ranges.
#include "split_rig.h"

#include "sample_meshes.h"

#include "render/plan_memory.h"
#include "split/host_split.h"
#include "tessera/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace tessera::splitting {
namespace {

using reference::Random;

// Bezier patches and truly rational Gregory patches, in a cube of 2 around the origin.
Scene bothKinds(std::uint64_t seed, std::size_t patches) {
    const Mesh bezier = reference::bumpyBezierMesh(seed, patches);
    return reference::sceneOf(
        {bezier, reference::parted(reference::asGregory(reference::bumpyBezierMesh(seed + 1, patches)), 0.3, seed + 2)});
}

struct Sight {
    std::string name;
    Camera camera;
};

// From outside, from among the patches, with them behind the eye, and from far away.
std::vector<Sight> sights() {
    std::vector<Sight> result{{"outside", reference::cameraAt({0.5, 1, 5}, {0, 0, 0}, 35)},
                              {"among them", reference::cameraAt({0.1, 0.2, 0.3}, {0, 0, -1}, 60)},
                              {"half behind", reference::cameraAt({0, 0, -0.2}, {0.3, 0, -2}, 90)},
                              {"behind", reference::cameraAt({0, 0, 4}, {0, 0.5, 9}, 45)},
                              {"far away", reference::cameraAt({30, 40, 300}, {0, 0, 0}, 20)},
                              {"beyond 1000", reference::cameraAt({0, 3, 1000}, {0, 0, 0}, 0.5)},
                              {"aside", reference::cameraAt({0, 0, 5}, {2.2, 0.4, 0}, 30)}};
    result[2].camera.near = 0.2F;
    return result;
}

RenderOptions smallPicture(int maxDepth = 23) {
    RenderOptions options;
    options.mode = DiceMode::classical;
    options.width = 160;
    options.height = 90;
    options.pixelSamples = 1;
    options.maxDepth = maxDepth;
    return options;
}

// Small and large, long and narrow, up to the deepest that a range can be.
std::vector<range_t> randomRanges(Random& random, std::uint32_t patches, std::size_t count) {
    const auto side = [&random] {
        const double bias = random.unit();
        const auto level = static_cast<std::uint32_t>(bias * bias * bias * 24.999);
        return (level << SIDE_LEVEL_SHIFT) | static_cast<std::uint32_t>(random.unit() * std::exp2(level));
    };
    std::vector<range_t> ranges(count);
    for (range_t& range : ranges) {
        range.patch_index = static_cast<std::uint32_t>(random.unit() * patches);
        range.u_side = side();
        range.v_side = side();
    }
    return ranges;
}

// What split_bound decides of ranges that stand on a stack of the test's own.
std::vector<int> deviceActions(SplitRig& rig, const std::vector<range_t>& ranges) {
    DeviceSession& session = rig.session();
    const std::size_t count = ranges.size();
    const auto buffer = [&](std::size_t bytes) { return session.memory.allocate(Purpose::scene, "a test's buffer", bytes); };
    const DeviceBuffer stack = buffer(count * sizeof(range_t));
    const DeviceBuffer batch = buffer(count * sizeof(range_t));
    const DeviceBuffer actions = buffer(count);
    const DeviceBuffer sums = buffer((count / SPLIT_CHUNK + 1) * sizeof(chunk_sum));
    const DeviceBuffer stateBuffer = buffer(sizeof(split_state));
    split_state state{};
    state.stack_count = static_cast<std::uint32_t>(count);
    session.timeline.write(stack.cl(), ranges.data(), count * sizeof(range_t));
    session.timeline.write(stateBuffer.cl(), &state, sizeof state);
    const split_limits limits{state.stack_count, state.stack_count, state.stack_count};
    session.launch(session.kernels.with("split_bound", rig.frame(), limits, rig.patches().eyePoints.cl(), rig.patches().feed.cl(),
                                        stack.cl(), batch.cl(), actions.cl(), sums.cl(), stateBuffer.cl()),
                   "split_bound");
    std::vector<std::uint8_t> read(count);
    session.timeline.read(actions.cl(), read.data(), count);
    return {read.begin(), read.end()};
}

void expectSameActions(Shape shape) {
    SplitRig rig(kernelSources(), shape);
    Random random(11);
    std::array<int, 4> seen{};
    for (const Sight& sight : sights()) {
        SCOPED_TRACE(sight.name);
        rig.place(bothKinds(20, 30), sight.camera, smallPicture());
        const Decide host = rig.hostBound();
        const std::vector<range_t> ranges = randomRanges(random, rig.patches().patches, 5000);
        const std::vector<int> device = deviceActions(rig, ranges);
        for (std::size_t k = 0; k < ranges.size(); ++k) {
            const int action = host(ranges[k]);
            ++seen[static_cast<std::size_t>(action)];
            ASSERT_EQ(device[k], action) << "patch " << ranges[k].patch_index << ", sides " << ranges[k].u_side << " and "
                                         << ranges[k].v_side;
        }
    }
    for (const int times : seen) EXPECT_GT(times, 500);
}

TEST(HostBound, DecidesAsTheDeviceOnRandomRanges) { expectSameActions(Shape::native); }

TEST(HostBound, DecidesAsTheDeviceInTheShapeOfGpus) { expectSameActions(Shape::gpu); }

// What a method found of a scene.
struct Found {
    std::vector<range_t> diced;
    std::uint64_t processed = 0;
    std::uint64_t culled = 0;
};

void expectSame(const Found& found, const Outcome& expected) {
    EXPECT_EQ(found.processed, expected.processed);
    EXPECT_EQ(found.culled, expected.culled);
    EXPECT_TRUE(same(sorted(found.diced), sorted(expected.diced)))
        << "ranges were lost, or came twice: " << found.diced.size() << " instead of " << expected.diced.size();
}

// Bounded at p ranges; the stack is judged after every iteration.
Found findBounded(SplitRig& rig, std::uint32_t p) {
    SplitPass pass(rig, {p, 2 * p, p}, 64);
    Found found;
    const auto take = [&] {
        const std::vector<range_t> ready = pass.takeReady();
        found.diced.insert(found.diced.end(), ready.begin(), ready.end());
    };
    while (!pass.over() && !::testing::Test::HasFailure()) {
        pass.step();
        if (2 * p - pass.state().ready_count < p) take();
        const StackVerdict verdict = judge(pass.stack(), p, static_cast<int>(rig.frame().max_depth));
        EXPECT_TRUE(verdict.ordered && verdict.bounded && verdict.summed && verdict.shallow);
    }
    take();
    EXPECT_TRUE(pass.spareUntouched());
    found.processed = pass.processed();
    found.culled = pass.culled();
    return found;
}

Found findBreadth(SplitRig& rig) {
    SplitPass pass(rig, {1, 1, 1}, 0);
    Found found;
    while (!pass.over() && !::testing::Test::HasFailure()) {
        pass.stepBreadth();
        const std::vector<range_t> ready = pass.takeReady();
        found.diced.insert(found.diced.end(), ready.begin(), ready.end());
    }
    found.processed = pass.processed();
    found.culled = pass.culled();
    return found;
}

Found findOnHost(const SplitRig& rig, unsigned threads, std::size_t limit) {
    HostSplit<ClassicalRule> split(ClassicalRule(rig.frame(), rig.eyePoints()), threads);
    Found found;
    for (std::vector<range_t> some = split.next(limit); !some.empty(); some = split.next(limit))
        found.diced.insert(found.diced.end(), some.begin(), some.end());
    EXPECT_EQ(split.counts().diced, found.diced.size());
    EXPECT_DOUBLE_EQ(split.fractionFed(), 1.0);
    found.processed = split.counts().processed;
    found.culled = split.counts().culled;
    return found;
}

void expectAllMethodsAgree(SplitRig& rig, const Scene& scene, const Camera& camera, const RenderOptions& options) {
    rig.place(scene, camera, options);
    const Outcome expected = depthFirst(rig.patches().patches, rig.hostBound());
    EXPECT_DOUBLE_EQ(areaOf(expected.diced) + expected.culledArea, rig.patches().patches);
    expectSame(findBreadth(rig), expected);
    for (const std::uint32_t p : {1U, 7U, 100U, 1000U, 40000U}) {
        SCOPED_TRACE("p = " + std::to_string(p));
        if (p == 1 && expected.processed > 2000) continue;  // an iteration a range: too slow
        expectSame(findBounded(rig, p), expected);
    }
    expectSame(findOnHost(rig, 1, 1), expected);
    expectSame(findOnHost(rig, 2, 333), expected);
    expectSame(findOnHost(rig, 5, 100), expected);
}

TEST(SplitMethods, FindTheSameRangesOnce) {
    SplitRig rig(kernelSources());
    for (const Sight& sight : sights()) {
        for (const int depth : {0, 5, 23}) {
            SCOPED_TRACE(sight.name + ", depth " + std::to_string(depth));
            expectAllMethodsAgree(rig, bothKinds(31, 25), sight.camera, smallPicture(depth));
        }
    }
}

TEST(SplitMethods, FindTheSameRangesOnceInTheShapeOfGpus) {
    SplitRig rig(kernelSources(), Shape::gpu);
    expectAllMethodsAgree(rig, bothKinds(32, 40), sights()[0].camera, smallPicture());
    expectAllMethodsAgree(rig, bothKinds(33, 40), sights()[1].camera, smallPicture());
}

// Through the renderer's own loops, with dicing between the iterations.
TEST(SplitMethods, CountAlikeInWholeFrames) {
    RendererSettings settings;
    settings.cacheFolder = kernelCache().string();
    Renderer renderer(settings);
    SplitRig rig(kernelSources());
    for (const Sight& sight : sights()) {
        SCOPED_TRACE(sight.name);
        const Scene scene = bothKinds(41, 25);
        RenderOptions options = smallPicture();
        rig.place(scene, sight.camera, options);
        const Outcome expected = depthFirst(rig.patches().patches, rig.hostBound());
        renderer.setScene(scene);
        for (const SplitMethod method : {SplitMethod::cpu, SplitMethod::breadth, SplitMethod::bounded}) {
            for (const std::uint32_t batch : {16U, 40000U}) {
                options.method = method;
                options.batch = batch;
                const Statistics statistics = renderer.render(sight.camera, options).statistics;
                SCOPED_TRACE(std::string(name(method)) + ", batch " + std::to_string(batch));
                EXPECT_EQ(statistics.rangesProcessed, expected.processed);
                EXPECT_EQ(statistics.rangesDiced, expected.diced.size());
                EXPECT_EQ(statistics.rangesCulled, expected.culled);
                EXPECT_TRUE(method != SplitMethod::bounded ||
                            statistics.stackPeak <= queueRoom(options, batch, listDevices().front()).stack);
            }
        }
    }
}

// What the bounded method takes for its queues, with N patches.
std::uint64_t boundedBytes(SplitRig& rig, std::size_t patches, const RenderOptions& options) {
    Scene scene = reference::sceneOf({reference::bumpyBezierMesh(51, patches)});
    for (glm::vec3& point : scene.meshes[0].points) point *= 3.0F;
    rig.place(scene, reference::cameraAt({0, 0, 9}, {0, 0, 0}, 60), options);
    const std::uint64_t before = rig.session().memory.bytes();
    rig.session().memory.restartPeak();
    SplitPass pass(rig, queueRoom(options, options.batch, rig.session().device.info).limits, 0);
    while (!pass.over()) {
        pass.step();
        static_cast<void>(pass.takeReady());
    }
    return rig.session().memory.peakBytes() - before;
}

TEST(SplitQueues, BytesOfTheBoundedMethodDoNotDependOnThePatches) {
    SplitRig rig(kernelSources());
    RenderOptions options = smallPicture(8);
    for (const std::uint32_t batch : {300U, 1000U}) {
        options.batch = batch;
        const std::uint64_t few = boundedBytes(rig, 1, options);
        const QueueRoom room = queueRoom(options, batch, listDevices().front());
        EXPECT_LE(few, SplitQueues::bytes(room.limits, room.stack, DiceMode::classical));
        EXPECT_EQ(boundedBytes(rig, 20 * std::size_t{batch}, options), few);
    }
}

}  // namespace
}  // namespace tessera::splitting
