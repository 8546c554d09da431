// The stack keeps its proven bound, which does not grow with the number of patches; and what is hard for splitting ends in bounded time
// with nothing missing.
#include "bounded_scenes.h"
#include "picture_scenes.h"
#include "sample_meshes.h"

#include "tessera/generate.h"
#include "tessera/memory_plan.h"

#include "split/quad_shared.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

constexpr std::uint32_t batch = 300;

// `objects` sheets of 250 small patches, one behind the other along x, the first of them around the origin.
Scene sheets(std::size_t objects) {
    Mesh mesh;
    mesh.name = "sheet";
    for (int k = 0; k < 250; ++k) {
        const double x = k % 25 * 0.04 - 0.5;
        const int row = k / 25;
        const double y = row * 0.1 - 0.5;
        const Mesh patch = bilinearPatch({{{x, y, 0}, {x + 0.04, y, 0.02}, {x + 0.04, y + 0.1, 0}, {x, y + 0.1, -0.02}}});
        mesh.points.insert(mesh.points.end(), patch.points.begin(), patch.points.end());
    }
    Scene scene;
    scene.name = "sheets";
    scene.meshes.push_back(std::move(mesh));
    scene.objects.resize(objects);
    for (std::size_t k = 0; k < objects; ++k) {
        scene.objects[k].name = "sheet";
        scene.objects[k].mesh = "sheet";
        scene.objects[k].transform.translation = {static_cast<float>(k) * 1.25F, 0.0F, 0.0F};
    }
    return scene;
}

std::uint64_t boundOf(DiceMode mode, const RenderOptions& options) {
    const int depth = mode == DiceMode::watertight ? 2 * QUAD_LEVEL_MOST : options.maxDepth;
    return (static_cast<std::uint64_t>(depth) + 1) * batch;
}

class Bound : public testing::TestWithParam<DiceMode> {};

// 10 thousand to 10 million patches; the camera sees a few of them.
TEST_P(Bound, OfStackAndMemoryDoesNotGrowWithTheNumberOfPatches) {
    Renderer renderer(testSettings());
    MemoryPlan first;
    for (const std::size_t objects : {40U, 400U, 4000U, 40000U}) {
        const Scene scene = sheets(objects);
        renderer.setScene(scene);
        RenderOptions options = pictureOptions(96, 64, 1);
        options.mode = GetParam();
        options.batch = batch;
        options.memoryBytes = 16 * mebibyte;
        const MemoryPlan plan = renderer.plan(options);
        const Kept kept = draw(renderer, reference::cameraAt({0.3, 0.2, 2.2}, {0.4, 0, 0}, 40), options);
        const Statistics& s = kept.statistics();
        std::printf("%zu patches: %u chunks, %llu bytes of %llu, stack %llu of %llu\n", scene.placedPatchCount(), plan.chunks,
                    static_cast<unsigned long long>(s.deviceBytesPeak), static_cast<unsigned long long>(s.deviceBytesBudget),
                    static_cast<unsigned long long>(s.stackPeak), static_cast<unsigned long long>(plan.stackCapacity));
        EXPECT_EQ(s.patches, 250 * objects);
        EXPECT_LE(s.deviceBytesPeak, options.memoryBytes);
        EXPECT_EQ(plan.stackCapacity, boundOf(GetParam(), options));
        EXPECT_LE(s.stackPeak, plan.stackCapacity);
        EXPECT_GT(s.stackPeak, 0U);
        EXPECT_GT(kept.coveredPixels(), 1000U);
        if (first.budget == 0) first = plan;
        EXPECT_EQ(plan.bytes.queues, first.bytes.queues);
        EXPECT_EQ(plan.stackCapacity, first.stackCapacity);
        EXPECT_EQ(plan.batch, first.batch);
    }
}

// Every scene, from without and within.
TEST_P(Bound, OfTheStackHoldsForEveryScene) {
    Renderer renderer(testSettings());
    for (const ClosedModel& model : boundedScenes()) {
        if (!canDraw(GetParam(), model.scene)) continue;
        renderer.setScene(model.scene);
        for (const bool inside : {false, true}) {
            for (const std::uint32_t p : {1U, 5U, 300U}) {
                RenderOptions options = pictureOptions(48, 32, 1);
                options.mode = GetParam();
                options.batch = p;
                const Statistics s = draw(renderer, viewFrom(model.scene, inside, 77), options).statistics();
                EXPECT_LE(s.stackPeak, boundOf(GetParam(), options) / batch * p) << model.name << ", p " << p;
            }
        }
    }
}

struct Work {
    std::uint64_t processed = 0;
    std::size_t covered = 0;  // pixels
};

Work workOf(Renderer& renderer, const Camera& camera, RenderOptions options) {
    options.occlusion = false;
    const Kept kept = draw(renderer, camera, options);
    return {kept.statistics().rangesProcessed, kept.coveredPixels()};
}

// The view in a picture of such a size that it covers about as many pixels.
Work workAtArea(Renderer& renderer, const Camera& camera, RenderOptions options, std::size_t pixels) {
    for (int k = 0; k < 3; ++k) {
        const Work work = workOf(renderer, camera, options);
        EXPECT_GT(work.covered, 100U);
        const double scale = std::sqrt(static_cast<double>(pixels) / static_cast<double>(work.covered));
        if (std::abs(scale - 1.0) < 0.01) return work;
        options.width = static_cast<int>(std::lround(options.width * scale));
        options.height = static_cast<int>(std::lround(options.height * scale));
    }
    return workOf(renderer, camera, options);
}

void expectNoMoreThanFourTimes(const std::string& what, DiceMode mode, const Work& within, const Work& inFront) {
    const double times = static_cast<double>(within.processed) / static_cast<double>(inFront.processed);
    std::printf("%s, %s: %llu ranges over %zu pixels, %llu over %zu in front: %.2f times\n", what.c_str(), std::string(name(mode)).c_str(),
                static_cast<unsigned long long>(within.processed), within.covered, static_cast<unsigned long long>(inFront.processed),
                inFront.covered, times);
    EXPECT_NEAR(static_cast<double>(inFront.covered), static_cast<double>(within.covered), 0.1 * static_cast<double>(within.covered));
    EXPECT_LE(times, 4.0);
}

TEST_P(Bound, OfWorkHoldsForAPatchThatPassesTheEyePlane) {
    Renderer renderer(testSettings());
    const Scene scene = generateScene("eyesplit");
    renderer.setScene(scene);
    RenderOptions options = pictureOptions(320, 180, 1);
    options.mode = GetParam();
    const Work through = workOf(renderer, scene.cameras.front(), options);
    EXPECT_GT(through.covered, 1000U);
    // The same patch seen in the same direction, from so far back that all of it is in front: a plane seen aslant takes more ranges a
    // pixel wherever it lies, for edges are measured, not areas. Face-on, where it takes fewest, is told and not judged.
    const Camera& camera = scene.cameras.front();
    const glm::dvec3 forward = -rotationMatrix(camera.transform)[2];
    const Bounds bounds = worldBounds(scene);
    const glm::dvec3 middle = 0.5 * (glm::dvec3(bounds.lower) + glm::dvec3(bounds.upper));
    const double size = glm::length(glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower));
    Camera back = reference::cameraAt(middle - size * forward, middle, static_cast<double>(camera.fovy));
    back.near = camera.near;
    const Work above =
        workAtArea(renderer, reference::cameraAt(middle + glm::dvec3(0.0, 1.5 * size, 0.1 * size), middle, 50.0), options, through.covered);
    std::printf("face-on: %llu ranges over %zu pixels, %.2f times\n", static_cast<unsigned long long>(above.processed), above.covered,
                static_cast<double>(through.processed) / static_cast<double>(above.processed));
    expectNoMoreThanFourTimes("eyesplit", GetParam(), through, workAtArea(renderer, back, options, through.covered));
}

// A closed surface of many patches around the eye: no pixel shows the background.
TEST_P(Bound, OfWorkHoldsInsideADenseSurface) {
    Renderer renderer(testSettings());
    const Scene scene = placedAnyhow({cubeSolid(91, 24)}, 92);
    renderer.setScene(scene);
    RenderOptions options = pictureOptions(256, 256, 1);
    options.mode = GetParam();
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        const Work inside = workOf(renderer, randomView(scene, ViewKind::inside, 60 + seed), options);
        // Classical mode leaves pinholes.
        EXPECT_GE(inside.covered, GetParam() == DiceMode::watertight ? 65536U : 65000U);
        const Camera front = viewFrom(scene, false, 60 + seed);
        expectNoMoreThanFourTimes("inside", GetParam(), inside, workAtArea(renderer, front, options, inside.covered));
    }
}

// The eye just above the surface, which crosses the near plane and the eye plane all around it.
TEST_P(Bound, OfWorkHoldsWithinASurfaceThatCrossesTheNearPlane) {
    Renderer renderer(testSettings());
    const Scene scene = placedAnyhow({cubeSolid(93, 16)}, 94);
    renderer.setScene(scene);
    RenderOptions options = pictureOptions(256, 192, 1);
    options.mode = GetParam();
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        const Work crossing = workOf(renderer, randomView(scene, ViewKind::throughNearPlane, 70 + seed), options);
        if (crossing.covered < 2000) continue;
        const Camera front = viewFrom(scene, false, 70 + seed);
        expectNoMoreThanFourTimes("near plane", GetParam(), crossing, workAtArea(renderer, front, options, crossing.covered));
    }
}

INSTANTIATE_TEST_SUITE_P(Modes, Bound, testing::Values(DiceMode::watertight, DiceMode::classical),
                         [](const auto& tested) { return std::string(name(tested.param)); });

}  // namespace
}  // namespace tessera::test
