// The host hardly waits for the device: a handful of times in a frame, however many iterations of splitting it takes.
#include "bounded_scenes.h"

#include "tessera/generate.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <tuple>

namespace tessera::test {
namespace {

constexpr std::uint64_t mostWaits = 8;

Statistics statisticsOf(Renderer& renderer, const Camera& camera, const RenderOptions& options) {
    Statistics s = draw(renderer, camera, options).statistics();
    std::printf("%s: %llu iterations, %llu waits\n", textOf(options).c_str(), static_cast<unsigned long long>(s.iterations),
                static_cast<unsigned long long>(s.hostWaits));
    EXPECT_EQ(s.buckets, 1U);
    EXPECT_EQ(s.chunks, 1U);
    return s;
}

RenderOptions optionsOf(DiceMode mode, std::uint32_t batch) {
    RenderOptions options = pictureOptions(160, 90, 1);
    options.mode = mode;
    options.batch = batch;
    return options;
}

class HostWaits : public testing::TestWithParam<DiceMode> {
protected:
    HostWaits() : renderer_(testSettings()) {}

    Renderer renderer_;
};

TEST_P(HostWaits, AreAHandfulWhateverTheBatch) {
    const Scene scene = builtinScene("teapot");
    renderer_.setScene(scene);
    for (const std::uint32_t batch : {1U, 16U, 300U, 40000U}) {
        const Statistics s = statisticsOf(renderer_, scene.cameras.front(), optionsOf(GetParam(), batch));
        EXPECT_LE(s.hostWaits, mostWaits);
        EXPECT_GE(s.hostWaits, 1U);
        if (batch == 1) {
            EXPECT_GT(s.iterations, 200U);
        }
        if (batch == 40000) {
            EXPECT_LE(s.hostWaits, 2U);
        }
    }
}

// Patches one by one, and more at a time than a batch holds.
TEST_P(HostWaits, AreAHandfulForThousandsOfPatches) {
    const Scene scene = generateScene("random", 4000);
    renderer_.setScene(scene);
    for (const std::uint32_t batch : {4U, 16U, 300U, 40000U}) {
        const Statistics s = statisticsOf(renderer_, viewFrom(scene, true, 3), optionsOf(GetParam(), batch));
        EXPECT_LE(s.hostWaits, mostWaits);
        if (batch == 4) {
            EXPECT_GT(s.iterations, 400U);
        }
        if (batch == 40000) {
            EXPECT_LE(s.hostWaits, 2U);
        }
    }
}

// One patch whose work is not to be told beforehand.
TEST_P(HostWaits, AreAHandfulForAPatchThroughTheEyePlane) {
    const Scene scene = generateScene("eyesplit");
    renderer_.setScene(scene);
    for (const std::uint32_t batch : {1U, 16U, 40000U}) {
        const Statistics s = statisticsOf(renderer_, scene.cameras.front(), optionsOf(GetParam(), batch));
        EXPECT_LE(s.hostWaits, mostWaits);
        if (batch == 1) {
            EXPECT_GT(s.iterations, 200U);
        }
    }
}

// Nothing of a frame depends on how far the device was when the host looked.
TEST_P(HostWaits, AndAllCountsAreTheSameFrameAfterFrame) {
    const Scene scene = builtinScene("teapot");
    renderer_.setScene(scene);
    for (const std::uint32_t batch : {3U, 300U}) {
        const auto counts = [&] {
            const Statistics s = draw(renderer_, scene.cameras.front(), optionsOf(GetParam(), batch)).statistics();
            return std::tuple(s.rangesProcessed, s.rangesDiced, s.rangesCulled, s.rangesOccluded, s.patchesSkipped, s.stackPeak,
                              s.iterations, s.batches, s.micropolygons, s.pixelsCovered, s.hostWaits);
        };
        const auto first = counts();
        for (int k = 0; k < 3; ++k) EXPECT_EQ(counts(), first) << "batch " << batch;
    }
}

// Progress may be looked at more often, but nobody waits for it.
TEST_P(HostWaits, AreNoMoreWithProgress) {
    const Scene scene = builtinScene("teapot");
    renderer_.setScene(scene);
    int calls = 0;
    const RenderOptions options = optionsOf(GetParam(), 16);
    const Frame frame = renderer_.render(scene.cameras.front(), options, [&](std::string_view, double fraction) {
        ++calls;
        EXPECT_GE(fraction, 0.0);
        EXPECT_LE(fraction, 1.0);
    });
    EXPECT_LE(frame.statistics.hostWaits, mostWaits);
    EXPECT_GT(calls, 8);
}

INSTANTIATE_TEST_SUITE_P(Modes, HostWaits, testing::Values(DiceMode::watertight, DiceMode::classical),
                         [](const auto& tested) { return std::string(name(tested.param)); });

}  // namespace
}  // namespace tessera::test
