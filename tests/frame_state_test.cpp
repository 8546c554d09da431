// Frames stand for themselves: statistics match the picture, and nothing is left over from earlier frames or failed ones.
#include "frames.h"
#include "picture_scenes.h"

#include "tessera/error.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace tessera::test {
namespace {

constexpr std::uint64_t mebibyte = 1U << 20U;

class FrameState : public testing::Test {
protected:
    FrameState() : renderer(testSettings()), teapot(builtinScene("teapot")) { renderer.setScene(teapot); }

    Kept drawn(const RenderOptions& options) { return draw(renderer, teapot.cameras.front(), options); }

    // The message of the error that a frame with `options` ends with.
    std::string refusal(const RenderOptions& options) {
        try {
            static_cast<void>(renderer.render(teapot.cameras.front(), options));
        } catch (const Error& error) {
            std::string text = error.what();
            EXPECT_EQ(text.find('\n'), std::string::npos) << text;
            return text;
        }
        return "no error";
    }

    Renderer renderer;
    Scene teapot;
};

TEST_F(FrameState, StatisticsMatchThePicture) {
    for (const int samples : {1, 4}) {
        for (const SplitMethod method : {SplitMethod::cpu, SplitMethod::breadth, SplitMethod::bounded}) {
            RenderOptions options = pictureOptions(200, 120, samples);
            options.mode = DiceMode::classical;
            options.method = method;
            options.diceRate = 5;
            options.batch = 500;
            const Kept picture = drawn(options);
            const Statistics& statistics = picture.statistics();
            EXPECT_EQ(statistics.pixelsCovered, picture.coveredPixels());
            EXPECT_EQ(statistics.micropolygons, statistics.rangesDiced * 25);
            // Every split makes two of one.
            EXPECT_EQ(statistics.rangesProcessed, 2 * (statistics.rangesDiced + statistics.rangesCulled) - statistics.patches);
            EXPECT_EQ(statistics.patches, 32U);
            EXPECT_EQ(statistics.method, name(method));
            EXPECT_EQ(statistics.width, 200);
            EXPECT_EQ(statistics.height, 120);
            EXPECT_EQ(statistics.pixelSamples, samples);
            EXPECT_EQ(statistics.batch, 500U);
            EXPECT_EQ(statistics.device, renderer.device().name);
            EXPECT_GT(statistics.batches, 0U);
            EXPECT_GT(statistics.frameMs, 0.0);
        }
    }
}

TEST_F(FrameState, AFrameOf1280x720WithOneSampleStaysBelow64MiB) {
    RenderOptions options;
    options.mode = DiceMode::classical;
    options.pixelSamples = 1;
    const Kept picture = drawn(options);
    EXPECT_LT(picture.statistics().deviceBytesPeak, 64 * mebibyte);
    EXPECT_GT(picture.statistics().deviceBytesPeak, 1280U * 720U * (8 + 16));
}

TEST_F(FrameState, TheNextFrameIsTheSame) {
    for (const SplitMethod method : {SplitMethod::cpu, SplitMethod::breadth, SplitMethod::bounded}) {
        RenderOptions options = pictureOptions(200, 120, 3);
        options.method = method;
        options.threads = 2;
        const Kept first = drawn(options);
        expectSameBits(first, drawn(options));
        expectSameBits(first, drawn(options));
    }
}

TEST_F(FrameState, FramesOfOtherSizesSamplesAndScenesLeaveNothingBehind) {
    const RenderOptions options = pictureOptions(200, 120, 2);
    const Kept first = drawn(options);
    const std::vector<RenderOptions> others{pictureOptions(31, 17, 1), pictureOptions(500, 333, 4), pictureOptions(120, 200, 2),
                                            pictureOptions(200, 120, 5), pictureOptions(1, 1, 16)};
    const Scene mixed = mixedScene();
    for (const RenderOptions& other : others) {
        static_cast<void>(drawn(other));
        expectSameBits(first, drawn(options));
        renderer.setScene(mixed);
        static_cast<void>(draw(renderer, mixed.cameras.front(), other));
        renderer.setScene(teapot);
        expectSameBits(first, drawn(options));
    }
    Renderer fresh(testSettings());
    fresh.setScene(teapot);
    expectSameBits(first, draw(fresh, teapot.cameras.front(), options));
}

TEST_F(FrameState, ErrorsLeaveNothingBehind) {
    const RenderOptions options = pictureOptions(200, 120, 2);
    const Kept first = drawn(options);
    RenderOptions bad = options;
    bad.width = 0;
    EXPECT_NE(refusal(bad), "no error");
    expectSameBits(first, drawn(options));
    RenderOptions huge = pictureOptions(65536, 65536, 16);
    EXPECT_NE(refusal(huge), "no error");
    expectSameBits(first, drawn(options));
    Camera blind = teapot.cameras.front();
    blind.fovy = 180.0F;
    EXPECT_THROW(static_cast<void>(renderer.render(blind, options)), Error);
    expectSameBits(first, drawn(options));
    Scene damaged = teapot;
    damaged.meshes.front().points.front().x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(renderer.setScene(damaged), Error);
    EXPECT_NE(refusal(options).find("setScene"), std::string::npos);
    renderer.setScene(teapot);
    expectSameBits(first, drawn(options));
}

// A caller that throws from its progress function ends the frame in the middle of its batches. What that has hidden is nearer than
// anything in the frames around it.
TEST_F(FrameState, AFrameThatBreaksOffLeavesNothingBehind) {
    struct Enough {};
    const Camera close = lookAt({0.5F, 2.0F, 4.0F}, {0.0F, 1.5F, 0.0F}, 50.0F);
    for (const SplitMethod method : {SplitMethod::cpu, SplitMethod::breadth, SplitMethod::bounded}) {
        RenderOptions options = pictureOptions(200, 120, 2);
        options.method = method;
        options.batch = 20;
        const Kept first = drawn(options);
        const Progress breakOff = [](std::string_view, double fraction) {
            if (fraction > 0.3) throw Enough{};
        };
        EXPECT_THROW(static_cast<void>(renderer.render(close, options, breakOff)), Enough);
        expectSameBits(first, drawn(options));
    }
}

TEST_F(FrameState, ProgressRisesToTheEndOnTheCallersThread) {
    double last = 0.0;
    int calls = 0;
    const Progress watch = [&](std::string_view stage, double fraction) {
        EXPECT_FALSE(stage.empty());
        EXPECT_GE(fraction, last);
        EXPECT_LE(fraction, 1.0);
        last = fraction;
        ++calls;
    };
    RenderOptions options = pictureOptions(200, 120, 1);
    options.batch = 50;
    static_cast<void>(renderer.render(teapot.cameras.front(), options, watch));
    EXPECT_GT(calls, 0);
    EXPECT_EQ(last, 1.0);
}

TEST_F(FrameState, OptionsOutOfRangeAreRefusedByName) {
    using Change = std::function<void(RenderOptions&)>;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    const std::vector<std::pair<std::string, Change>> bad{
        {"width", [](RenderOptions& o) { o.width = 0; }},
        {"width", [](RenderOptions& o) { o.width = 65537; }},
        {"height", [](RenderOptions& o) { o.height = 0; }},
        {"height", [](RenderOptions& o) { o.height = -5; }},
        {"pixel samples", [](RenderOptions& o) { o.pixelSamples = 0; }},
        {"pixel samples", [](RenderOptions& o) { o.pixelSamples = 17; }},
        {"bucket width", [](RenderOptions& o) { o.bucketHeight = 8; }},
        {"batch", [](RenderOptions& o) { o.batch = (1U << 20U) + 1; }},
        {"split bound", [=](RenderOptions& o) { o.splitBound = nan; }},
        {"split bound", [](RenderOptions& o) { o.splitBound = 0.0F; }},
        {"split bound", [=](RenderOptions& o) { o.splitBound = infinite; }},
        {"dice rate", [](RenderOptions& o) { o.diceRate = 0; }},
        {"dice rate", [](RenderOptions& o) { o.diceRate = 33; }},
        {"maximum depth", [](RenderOptions& o) { o.maxDepth = -1; }},
        {"maximum depth", [](RenderOptions& o) { o.maxDepth = 25; }},
        {"shading rate", [=](RenderOptions& o) { o.shadingRate = nan; }},
        {"shading rate", [](RenderOptions& o) { o.shadingRate = 0.0F; }},
        {"shading rate", [=](RenderOptions& o) { o.shadingRate = infinite; }},
        {"grid size", [](RenderOptions& o) { o.gridSize = 0; }},
        {"grid size", [](RenderOptions& o) { o.gridSize = 12; }},
        {"grid size", [](RenderOptions& o) { o.gridSize = 64; }},
        {"mode", [](RenderOptions& o) { o.mode = static_cast<DiceMode>(7); }},
        {"background", [=](RenderOptions& o) { o.background[1] = nan; }},
        {"background", [=](RenderOptions& o) { o.background[0] = infinite; }},
        {"background", [](RenderOptions& o) { o.background[2] = -0.5F; }},
        {"background alpha", [](RenderOptions& o) { o.background[3] = 1.5F; }},
        {"crop",
         [](RenderOptions& o) {
             o.crop = {0.5F, 0.5F, 0.0F, 1.0F};
         }},
        {"crop",
         [](RenderOptions& o) {
             o.crop = {0.0F, 1.0F, 0.9F, 0.1F};
         }},
        {"crop",
         [](RenderOptions& o) {
             o.crop = {-0.1F, 1.0F, 0.0F, 1.0F};
         }},
        {"crop",
         [=](RenderOptions& o) {
             o.crop = {nan, 1.0F, 0.0F, 1.0F};
         }},
        {"threads", [](RenderOptions& o) { o.threads = 1025; }},
    };
    for (const auto& [option, change] : bad) {
        RenderOptions options = pictureOptions(64, 36, 1);
        change(options);
        EXPECT_NE(refusal(options).find(option), std::string::npos) << option << ": " << refusal(options);
        EXPECT_THROW(options.validate(), Error);
    }
    // A window between two pixels is only found against the size.
    RenderOptions between = pictureOptions(10, 10, 1);
    between.crop = {0.11F, 0.12F, 0.0F, 1.0F};
    EXPECT_NE(refusal(between).find("crop"), std::string::npos);
}

// The numbers in messages are those given.
TEST_F(FrameState, RefusalsTellTheValueAndItsRange) {
    RenderOptions options = pictureOptions(64, 36, 1);
    options.splitBound = 100000.0F;
    EXPECT_NE(refusal(options).find("100000"), std::string::npos) << refusal(options);
    EXPECT_NE(refusal(options).find("65536"), std::string::npos) << refusal(options);
    options.splitBound = 8.0F;
    options.background[3] = 20.0F;
    EXPECT_NE(refusal(options).find("20"), std::string::npos) << refusal(options);
}

TEST_F(FrameState, TheLimitsThemselvesAreTaken) {
    RenderOptions options = pictureOptions(33, 1, 16);
    options.mode = DiceMode::classical;
    options.batch = 1U << 20U;
    options.splitBound = 65536.0F;
    options.diceRate = 32;
    options.maxDepth = 24;
    options.threads = 1024;
    options.method = SplitMethod::cpu;
    options.background = {65504.0F, 0.0F, 0.0F, 1.0F};
    EXPECT_EQ(drawn(options).width(), 33);
    options.splitBound = 0.25F;
    options.diceRate = 1;
    EXPECT_EQ(drawn(options).height(), 1);
    options.mode = DiceMode::watertight;
    options.shadingRate = 65536.0F;
    options.gridSize = 32;
    EXPECT_EQ(drawn(options).width(), 33);
    options.shadingRate = 0.0625F;
    options.gridSize = 1;
    EXPECT_EQ(drawn(options).height(), 1);
}

long residentKibibytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

// 2^32 pixels of 256 samples: 2^40 samples of 20 bytes.
TEST_F(FrameState, SizesThatNoDeviceHoldsAreRefusedWithTheirBytesBeforeAnythingIsAllocated) {
    static_cast<void>(drawn(pictureOptions(64, 36, 1)));
    const long before = residentKibibytes();
    const std::string samples = refusal(pictureOptions(65536, 65536, 16));
    EXPECT_NE(samples.find("65536x65536"), std::string::npos) << samples;
    EXPECT_NE(samples.find("iB"), std::string::npos) << samples;
    const std::string pixels = refusal(pictureOptions(65536, 65536, 1));
    EXPECT_NE(pixels.find("iB"), std::string::npos) << pixels;
    EXPECT_LT(residentKibibytes() - before, 64 * 1024);
    EXPECT_LT(drawn(pictureOptions(64, 36, 1)).statistics().deviceBytesPeak, 256 * mebibyte);
}

}  // namespace
}  // namespace tessera::test
