// The local method: every range is found once whatever the groups, rounds and room for diceable ranges; stacks and pool keep their bound;
// no group does much more than the others.
#include "local_rig.h"
#include "quad_rig.h"
#include "split_adversary.h"
#include "split_rig.h"

#include "sample_meshes.h"

#include "tessera/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace tessera::splitting {
namespace {

RenderOptions optionsOf(DiceMode mode, int maxDepth = 23) {
    RenderOptions options;
    options.mode = mode;
    options.width = 160;
    options.height = 90;
    options.pixelSamples = 1;
    options.gridSize = 4;
    options.maxDepth = maxDepth;
    return options;
}

// In a cube of 2 around the origin.
Scene everyKind(std::uint64_t seed, std::size_t patches, DiceMode mode) {
    const Mesh bezier = reference::bumpyBezierMesh(seed, patches);
    const Mesh gregory = reference::parted(reference::asGregory(reference::bumpyBezierMesh(seed + 1, patches)), 0.3, seed + 2);
    if (mode == DiceMode::classical) return reference::sceneOf({bezier, gregory});
    return reference::sceneOf({bezier, gregory, reference::weighted(reference::bumpyBezierMesh(seed + 3, patches), 3.0, seed + 4),
                               reference::bumpyPnMesh(seed + 5, patches)});
}

// One patch that passes the eye, from far in front to far behind.
Scene eyeSplit() {
    Mesh mesh;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            mesh.points.emplace_back(-20.0F + 40.0F / 3.0F * static_cast<float>(i), -0.5F, 20.0F - 40.0F / 3.0F * static_cast<float>(j));
    return reference::sceneOf({mesh});
}

struct Sight {
    std::string name;
    Scene scene;
    Camera camera;
};

std::vector<Sight> sights(DiceMode mode) {
    return {{"outside", everyKind(40, 12, mode), reference::cameraAt({0.5, 1, 5}, {0, 0, 0}, 35)},
            {"among them", everyKind(20, 30, mode), reference::cameraAt({0.1, 0.2, 0.3}, {0, 0, -1}, 60)},
            {"nothing in sight", everyKind(20, 10, mode), reference::cameraAt({0, 0, 4}, {0, 0.5, 9}, 45)},
            {"an eye-split", eyeSplit(), Camera{}}};
}

// What local runs with: few and many groups, narrow and wide ones, and room for one round or a dozen.
std::vector<LocalRun> runs(std::uint32_t width, std::uint32_t levels) {
    std::vector<LocalRun> all;
    for (const std::uint32_t groups : {1U, 2U, 7U})
        for (const std::uint32_t rounds : {1U, 3U, 64U})
            for (const std::uint32_t batches : {1U, 12U}) all.push_back({{groups, width}, groups * width * batches, rounds, levels});
    all.push_back({{3, 1}, 3, 5, levels});
    all.push_back({{2, width / 4}, 3 * width, 8, levels});
    return all;
}

std::string textOf(const LocalRun& run) {
    return std::to_string(run.shape.groups) + " groups of " + std::to_string(run.shape.width) + ", " + std::to_string(run.mostRounds) +
           " rounds, room for " + std::to_string(run.readyCapacity);
}

template <typename Range, typename Expected>
void expectSame(const LocalFound<Range>& found, const Expected& expected) {
    EXPECT_EQ(found.processed, expected.processed);
    EXPECT_EQ(found.culled, expected.culled);
    EXPECT_TRUE(same(sorted(found.diced), sorted(expected.diced)))
        << "ranges were lost, or came twice: " << found.diced.size() << " instead of " << expected.diced.size();
}

double mostByMean(const std::vector<std::uint64_t>& ranges) {
    const auto sum = static_cast<double>(std::accumulate(ranges.begin(), ranges.end(), std::uint64_t{0}));
    return static_cast<double>(*std::max_element(ranges.begin(), ranges.end())) * static_cast<double>(ranges.size()) / sum;
}

LocalFound<quad_range> findQuads(QuadRig& rig, const LocalRun& run) {
    return LocalPass<quad_range, QuadRig>(rig, DiceMode::watertight, run).findAll();
}

LocalFound<range_t> findBoxes(SplitRig& rig, const LocalRun& run) {
    return LocalPass<range_t, SplitRig>(rig, DiceMode::classical, run).findAll();
}

std::uint64_t micropolygonsOf(const std::vector<quad_range>& diced) {
    std::uint64_t sum = 0;
    for (const quad_range& range : diced) sum += std::uint64_t{1} << (byteOf(range.sizes, 2) + byteOf(range.sizes, 3));
    return sum;
}

void expectSameQuads(QuadRig&& rig, std::size_t stride) {
    for (const Sight& sight : sights(DiceMode::watertight)) {
        rig.place(sight.scene, sight.camera, optionsOf(DiceMode::watertight));
        const QuadsFound expected = findBounded(rig, 1000);
        EXPECT_EQ(findOnHost(rig, 1).processed, expected.processed);
        const std::vector<LocalRun> all = runs(QUAD_GROUP, 2 * rig.frame().level_most);
        for (std::size_t k = 0; k < all.size(); k += stride) {
            SCOPED_TRACE(sight.name + ", " + textOf(all[k]));
            const LocalFound<quad_range> found = findQuads(rig, all[k]);
            expectSame(found, expected);
            EXPECT_EQ(found.micropolygons, micropolygonsOf(expected.diced));
            EXPECT_EQ(std::accumulate(found.groupRanges.begin(), found.groupRanges.end(), std::uint64_t{0}), expected.processed);
            if (::testing::Test::HasFailure()) return;
        }
    }
}

TEST(LocalQuads, FindTheSameRangesOnce) { expectSameQuads(QuadRig(kernelSources()), 1); }

TEST(LocalQuads, FindTheSameRangesOnceInTheShapeOfGpus) { expectSameQuads(QuadRig(kernelSources(), Shape::gpu), 5); }

void expectSameBoxes(SplitRig&& rig, std::size_t stride) {
    for (const Sight& sight : sights(DiceMode::classical)) {
        for (const int depth : {0, 5, 24}) {
            rig.place(sight.scene, sight.camera, optionsOf(DiceMode::classical, depth));
            const Outcome expected = depthFirst(rig.patches().patches, rig.hostBound());
            const std::vector<LocalRun> all = runs(LOCAL_BOXES_MOST, rig.frame().max_depth);
            for (std::size_t k = 0; k < all.size(); k += stride) {
                SCOPED_TRACE(sight.name + ", depth " + std::to_string(depth) + ", " + textOf(all[k]));
                expectSame(findBoxes(rig, all[k]), expected);
                if (::testing::Test::HasFailure()) return;
            }
        }
    }
}

TEST(LocalBoxes, FindTheSameRangesOnce) { expectSameBoxes(SplitRig(kernelSources()), 1); }

TEST(LocalBoxes, FindTheSameRangesOnceInTheShapeOfGpus) { expectSameBoxes(SplitRig(kernelSources(), Shape::gpu), 5); }

// Trees made to fill stacks. Their decisions hang on the range alone, so the host knows the outcome.
TEST(LocalStack, KeepsItsBoundUnderHarmfulTrees) {
    SplitRig rig(adversarialKernels());
    std::uint64_t fullest = 0;
    for (const Plot plot : {Plot::everything, Plot::burst, Plot::first, Plot::last, Plot::tightest, Plot::coin}) {
        for (const int depth : {6, 11}) {
            const std::size_t patches = plot == Plot::everything || plot == Plot::tightest ? 3 : 200;
            const Plan plan{std::vector<Plot>(patches, plot), 77, 8, depth};
            rig.place(sceneOf(plan), Camera{}, optionsOf(DiceMode::classical, depth));
            const Outcome expected = depthFirst(rig.patches().patches, decisionsOf(plan));
            for (const std::uint32_t groups : {1U, 2U, 5U}) {
                const LocalRun run{{groups, 8}, 40 * groups, 6, static_cast<std::uint32_t>(depth)};
                SCOPED_TRACE("plot " + std::to_string(static_cast<int>(plot)) + ", depth " + std::to_string(depth) + ", " + textOf(run));
                const LocalFound<range_t> found = findBoxes(rig, run);
                expectSame(found, expected);
                fullest = std::max(fullest, found.peak);
                if (::testing::Test::HasFailure()) return;
            }
        }
    }
    EXPECT_GE(fullest, 80U) << "the trees must be deep enough to fill stacks of at most 96";
}

// Over a whole frame, however the groups come to run; LocalPass judges each launch besides.
TEST(LocalBalance, HoldsFromOnePatchToMany) {
    QuadRig quads(kernelSources());
    SplitRig boxes(kernelSources());
    for (const std::uint32_t groups : {2U, 7U, 32U}) {
        for (const DiceMode mode : {DiceMode::watertight, DiceMode::classical}) {
            for (const bool one : {true, false}) {
                SCOPED_TRACE(std::to_string(groups) + " groups, " + std::string(name(mode)) + (one ? ", one patch" : ", many patches"));
                const Sight sight =
                    one ? sights(mode)[3] : Sight{"", everyKind(7, 500, mode), reference::cameraAt({0.5, 1, 5}, {0, 0, 0}, 35)};
                RenderOptions options = optionsOf(mode);
                options.width = 640;
                options.height = 360;
                std::vector<std::uint64_t> ranges;
                if (mode == DiceMode::watertight) {
                    quads.place(sight.scene, sight.camera, options);
                    ranges = findQuads(quads, {{groups, QUAD_GROUP}, 100'000, 64, 2 * quads.frame().level_most}).groupRanges;
                } else {
                    boxes.place(sight.scene, sight.camera, options);
                    ranges = findBoxes(boxes, {{groups, 16}, 100'000, 64, boxes.frame().max_depth}).groupRanges;
                }
                EXPECT_GT(std::accumulate(ranges.begin(), ranges.end(), std::uint64_t{0}), 2000U);
                EXPECT_LE(mostByMean(ranges), 2.0);
            }
        }
    }
}

TEST(LocalShape, FitsTheDevicesLocalMemory) {
    DeviceInfo device;
    device.name = "a device";
    device.computeUnits = 6;
    for (const DiceMode mode : {DiceMode::watertight, DiceMode::classical}) {
        device.localBytes = std::uint64_t{48} << 10U;
        const std::uint32_t most = mode == DiceMode::watertight ? LOCAL_QUADS_MOST : LOCAL_BOXES_MOST;
        EXPECT_EQ(localShape(device, mode).width, most);
        EXPECT_EQ(localShape(device, mode).groups, 6U);
        device.localBytes = std::uint64_t{32} << 10U;
        EXPECT_EQ(localShape(device, mode).width, most / 2);
        device.localBytes = std::uint64_t{16} << 10U;
        try {
            static_cast<void>(localShape(device, mode));
            FAIL() << "16 KiB must be refused";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("local memory"), std::string::npos);
        }
    }
}

TEST(LocalQueues, TakeTheBytesTheySay) {
    QuadRig rig(kernelSources());
    for (const DiceMode mode : {DiceMode::watertight, DiceMode::classical}) {
        for (const LocalShape shape : {LocalShape{1, 1}, LocalShape{5, 16}}) {
            const std::uint64_t before = rig.session().memory.bytes();
            LocalQueues queues(rig.session());
            queues.reserve(shape, mode);
            EXPECT_EQ(rig.session().memory.bytes() - before, LocalQueues::bytes(shape, mode));
            queues.release();
            EXPECT_EQ(rig.session().memory.bytes(), before);
        }
    }
}

}  // namespace
}  // namespace tessera::splitting
