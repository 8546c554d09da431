// Frames of one renderer in turn, and buckets of one frame: what is left of those before takes neither room nor budget from the next.
#include "chunk_scenes.h"
#include "frames.h"
#include "split_rig.h"

#include "film/picture_layout.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tessera::test {
namespace {

constexpr std::uint64_t mebibyte = 1U << 20U;

void expectWithinBudget(const Kept& picture) { EXPECT_LE(picture.statistics().deviceBytesPeak, picture.statistics().deviceBytesBudget); }

// Breadth's queues are not in the plan, so that the plans of both frames have the same sizes.
TEST(FrameMemory, BreadthGivesBackWhatALowerBudgetDoesNotHold) {
    Renderer renderer(testSettings());
    const Scene teapot = builtinScene("teapot");
    renderer.setScene(teapot);
    RenderOptions options = pictureOptions(200, 120, 1);
    options.method = SplitMethod::breadth;
    options.shadingRate = 0.0625F;
    options.gridSize = 1;
    const Kept fine = draw(renderer, teapot.cameras.front(), options);
    ASSERT_GT(fine.statistics().deviceBytesPeak, 8 * mebibyte);
    options.shadingRate = 1.0F;
    options.gridSize = 16;
    options.memoryBytes = 8 * mebibyte;
    expectWithinBudget(draw(renderer, teapot.cameras.front(), options));
}

TEST(FrameMemory, AFormerScenesLightsTakeNothingFromTheBudget) {
    Renderer renderer(testSettings());
    const Scene teapot = builtinScene("teapot");
    Scene lit = teapot;
    lit.lights.assign(20000, Light{});
    RenderOptions options = pictureOptions(8, 8, 1);
    options.batch = 100;
    renderer.setScene(lit);
    static_cast<void>(draw(renderer, lit.cameras.front(), options));
    renderer.setScene(teapot);
    options.memoryBytes = renderer.plan(options).bytes.total();
    expectWithinBudget(draw(renderer, teapot.cameras.front(), options));
}

TEST(FrameMemory, ABucketBeginsWithAllOfReadyFree) {
    splitting::SplitRig rig(kernelSources());
    const Scene teapot = builtinScene("teapot");
    rig.place(teapot, teapot.cameras.front(), pictureOptions(64, 64, 1));
    SplitQueues queues(rig.session());
    queues.reserve({32, 32, 32}, 32);
    split_state drawn{};
    drawn.ready_count = drawn.hidden = 20;
    drawn.batches = 3;
    queues.restart();
    queues.writeState(drawn);
    queues.enqueueFeed(rig.frame(), rig.patches());
    const split_state fed = queues.readState();
    EXPECT_EQ(fed.ready_count, 0U);
    EXPECT_EQ(fed.hidden, 0U);
    EXPECT_GT(fed.feed_count, 0U);
    EXPECT_EQ(fed.batches, 3U);
}

// What the last ranges of one chunk hide of the next.
TEST(FrameMemory, ChunksHideWhatLiesBehindThemInLaterOnes) {
    Renderer renderer(testSettings());
    Scene scene;
    scene.meshes.push_back(reference::bumpyBezierMesh(1, 400));
    scene.meshes.front().name = "wall";
    const Camera camera = lookAt({0.0F, 0.0F, 10.0F}, {0.0F, 0.0F, 0.0F}, 30.0F);
    for (const float z : {4.0F, -10.0F}) {
        Object& object = scene.objects.emplace_back();
        object.mesh = "wall";
        object.transform.translation = {0.0F, 0.0F, z};
    }
    scene.cameras = {camera};
    renderer.setScene(scene);
    RenderOptions options = pictureOptions(160, 120, 1);
    options.batch = 2000;
    options.aovs = Aov::z;
    const Kept whole = draw(renderer, camera, options);
    std::uint64_t least = 0, enough = renderer.plan(options).bytes.total();
    while (enough - least > 256) {
        options.memoryBytes = (least + enough) / 2;
        bool fits = true;
        try {
            static_cast<void>(renderer.plan(options));
        } catch (const std::exception&) {
            fits = false;
        }
        (fits ? enough : least) = options.memoryBytes;
    }
    options.memoryBytes = enough;
    const Kept parts = draw(renderer, camera, options);
    ASSERT_GT(parts.statistics().chunks, 1U);
    ASSERT_LT(parts.statistics().batches, 2 * parts.statistics().chunks * parts.statistics().buckets);
    EXPECT_GT(parts.statistics().rangesOccluded, 0U);
    expectSameBits(whole, parts);
}

// 46341 x 46341 pixels have more than 2^31 and four floats each more than 2^32.
TEST(FrameProgress, RunsForwardOverBucketsAndChunks) {
    Renderer renderer(testSettings());
    Scene scene = reference::sceneOf({reference::bumpyBezierMesh(1, 400)});
    const Camera camera = lookAt({0.0F, 0.0F, 10.0F}, {0.0F, 0.0F, 0.0F}, 30.0F);
    renderer.setScene(scene);
    RenderOptions options = pictureOptions(160, 120, 1);
    options.batch = 64;
    options.aovs = Aov::none;
    options.bucketWidth = options.bucketHeight = 64;
    options.memoryBytes = 400000;
    double last = 0.0;
    std::size_t times = 0;
    const Frame frame = renderer.render(camera, options, [&](std::string_view stage, double fraction) {
        EXPECT_GE(fraction, last) << stage;
        EXPECT_LE(fraction, 1.0) << stage;
        last = fraction;
        ++times;
    });
    EXPECT_GT(frame.statistics.buckets, 1U);
    EXPECT_GT(frame.statistics.chunks, 1U);
    EXPECT_GT(times, frame.statistics.chunks);
}

TEST(FrameMemory, PlanesOfAPictureOfMoreThan32BitsOfFloatsLieApart) {
    const std::uint64_t pixels = std::uint64_t{46341} * 46341;
    const PictureLayout layout = layOutPicture(46341, 46341, allPlanes);
    std::uint64_t place = 4 * pixels;
    for (std::size_t k = 0; k < planeSpecs().size(); ++k) {
        ASSERT_TRUE(layout.places[k].has_value());
        EXPECT_EQ(*layout.places[k], place);
        place += static_cast<std::uint64_t>(planeSpecs()[k].channels) * pixels;
    }
    EXPECT_EQ(layout.floats, place);
    EXPECT_FALSE(layOutPicture(8, 8, Aov::z).places.back().has_value());
}

}  // namespace
}  // namespace tessera::test
