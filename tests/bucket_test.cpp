// A picture in buckets is the picture at once, to the bit, and costs little more work.
#include "bounded_scenes.h"
#include "picture_scenes.h"

#include "tessera/generate.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>
#include <utility>

namespace tessera::test {
namespace {

constexpr std::size_t mostTies = 4;

// Odd ones, those below the least side of a tile's multiple, and one as wide as the picture.
constexpr std::array<std::pair<int, int>, 4> sizes{{{8, 8}, {13, 29}, {50, 17}, {128, 9}}};

void expectTheWholePicture(Renderer& renderer, const Camera& camera, RenderOptions options, const Kept& whole) {
    for (const SplitMethod method : everyMethod) {
        for (const auto& [width, height] : sizes) {
            // The smallest by one method alone: there are over a hundred of them.
            if (width == 8 && method != SplitMethod::bounded) continue;
            options.method = method;
            options.bucketWidth = width;
            options.bucketHeight = height;
            SCOPED_TRACE(textOf(options));
            const Kept part = draw(renderer, camera, options);
            EXPECT_GT(part.statistics().buckets, 1U);
            EXPECT_EQ(part.statistics().pixelsCovered, whole.statistics().pixelsCovered);
            EXPECT_EQ(part.width(), whole.width());
            expectSameButTies(whole, part, mostTies);
        }
    }
}

TEST(Buckets, OfAnySizeGiveThePictureAtOnceByEveryMethodInBothModes) {
    Renderer renderer(testSettings());
    for (const ClosedModel& model : boundedScenes()) {
        if (model.name != "mixed" && model.name != "kinds" && model.name != "torus") continue;
        renderer.setScene(model.scene);
        for (const DiceMode mode : {DiceMode::watertight, DiceMode::classical}) {
            if (!canDraw(mode, model.scene)) continue;
            for (const int pixelSamples : {1, 3}) {
                RenderOptions options = pictureOptions(101, 67, pixelSamples);
                options.mode = mode;
                const Camera camera = viewFrom(model.scene, pixelSamples == 3, 31);
                SCOPED_TRACE(model.name);
                const Kept whole = draw(renderer, camera, options);
                EXPECT_GT(whole.coveredPixels(), 500U);
                expectTheWholePicture(renderer, camera, options, whole);
            }
        }
    }
}

// Bounds of buckets are those of the crop window's tiles, which lie otherwise in the full picture.
TEST(Buckets, OfACropWindowGiveItsPixelsOfTheFullPicture) {
    Renderer renderer(testSettings());
    const Scene scene = mixedScene();
    renderer.setScene(scene);
    for (const DiceMode mode : {DiceMode::watertight, DiceMode::classical}) {
        RenderOptions options = pictureOptions(120, 80, 3);
        options.mode = mode;
        const Kept full = draw(renderer, scene.cameras.front(), options);
        for (const std::array<float, 4>& crop : {std::array{0.11F, 0.93F, 0.27F, 0.8F}, std::array{0.33F, 0.4F, 0.0F, 1.0F}}) {
            options.crop = crop;
            options.bucketWidth = 19;
            options.bucketHeight = 11;
            for (const SplitMethod method : everyMethod) {
                options.method = method;
                SCOPED_TRACE(textOf(options));
                const Kept part = draw(renderer, scene.cameras.front(), options);
                EXPECT_GT(part.statistics().buckets, 1U);
                EXPECT_LT(part.width(), full.width());
                expectSameButTies(full, part, mostTies);
            }
        }
    }
}

// A frame of many small patches, in 4 x 4 buckets and at once; without culling behind what is drawn, which knows less in buckets.
struct Work {
    Statistics once;
    Statistics bucketed;
};

Work workOf(Renderer& renderer, const Scene& scene, DiceMode mode) {
    renderer.setScene(scene);
    RenderOptions options = pictureOptions(256, 192, 1);
    options.mode = mode;
    options.occlusion = mode == DiceMode::classical;
    Work work;
    work.once = draw(renderer, scene.cameras.front(), options).statistics();
    options.bucketWidth = 64;
    options.bucketHeight = 48;
    work.bucketed = draw(renderer, scene.cameras.front(), options).statistics();
    EXPECT_EQ(work.bucketed.buckets, 16U);
    return work;
}

double growth(const Work& work) {
    return static_cast<double>(work.bucketed.rangesProcessed) / static_cast<double>(work.once.rangesProcessed);
}

TEST(Buckets, SixteenOfThemBoundLittleMoreThanOnePass) {
    Renderer renderer(testSettings());
    for (const auto& [name, count] : {std::pair("spheres", 400), std::pair("hair", 1500), std::pair("random", 4000)}) {
        const Work work = workOf(renderer, generateScene(name, count), DiceMode::watertight);
        std::printf("%s: %.3f times the ranges of one pass\n", name, growth(work));
        EXPECT_LT(growth(work), 2.0) << name;
        EXPECT_GE(work.bucketed.rangesProcessed, work.once.rangesProcessed) << name;
    }
}

// Each patch is in some buckets and skipped in the others.
TEST(Buckets, PatchesWhoseBoxesMissABucketAreSkippedAndCounted) {
    Renderer renderer(testSettings());
    const Work work = workOf(renderer, generateScene("spheres", 400), DiceMode::watertight);
    const std::uint64_t patches = work.once.patches;
    EXPECT_EQ(patches, 3200U);
    EXPECT_LT(work.once.patchesSkipped, patches);
    const std::uint64_t seen = patches - work.once.patchesSkipped;
    EXPECT_LE(work.bucketed.patchesSkipped, 16 * patches - seen);
    EXPECT_GT(work.bucketed.patchesSkipped, 14 * patches);
    const Work classical = workOf(renderer, mixedScene(), DiceMode::classical);
    EXPECT_EQ(classical.once.patchesSkipped, 0U);
    EXPECT_GT(classical.bucketed.patchesSkipped, 0U);
    EXPECT_LT(classical.bucketed.patchesSkipped, 16 * classical.once.patches);
}

}  // namespace
}  // namespace tessera::test
