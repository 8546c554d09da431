// Culling behind what is drawn changes no bit of a picture, and works; and its rule, compiled as C++, hides what is hidden alone.
#include "bounded_scenes.h"
#include "picture_scenes.h"
#include "sample_meshes.h"

#include "tessera/generate.h"
#include "tessera/weld.h"

#include "core/frame_shared.h"
#include "device/lanes_host.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace tessera::kernels {
// As OpenCL defines them; NaN gives the lower bound.
inline float clamp(float value, float low, float high) { return std::fmin(std::fmax(value, low), high); }
inline uint as_uint(float value) { return std::bit_cast<uint>(value); }
}  // namespace tessera::kernels

// clang-format off
#include "device/kernel_headers_begin.h"
namespace tessera::kernels {
#include "split/occlusion.clh"
}  // namespace tessera::kernels
#include "device/kernel_headers_end.h"
// clang-format on

namespace tessera::test {

static void PrintTo(const ClosedModel& model, std::ostream* stream) { *stream << model.name; }

namespace {

using reference::Random;

constexpr std::size_t mostTies = 4;

// Scenes of high depth complexity.
std::vector<ClosedModel> deepScenes() {
    using namespace reference;
    std::vector<ClosedModel> scenes;
    for (ClosedModel& model : boundedScenes()) {
        if (model.name == "solid" || model.name == "kinds" || model.name == "torus" || model.name == "mixed") {
            scenes.push_back({"nested_" + model.name, nested(model.scene, 4)});
        }
    }
    scenes.push_back({"layers", placedAnyhow({bumpyBezierMesh(81, 200)}, 82)});
    scenes.push_back({"triangles", nested(placedAnyhow({triangleSolid(83, 4, TriangleLook::creased)}, 84), 3)});
    // Of all kinds, joined by edge records.
    Scene recorded = placedAnyhow(mixedSolid(85, 3, {PatchKind::bezier, PatchKind::gregory, PatchKind::rational, PatchKind::pn}), 86);
    static_cast<void>(weld(recorded));
    scenes.push_back({"recorded", nested(recorded, 3)});
    scenes.push_back({"hair", generateScene("hair", 120)});
    return scenes;
}

class Occlusion : public testing::TestWithParam<ClosedModel> {
protected:
    Occlusion() : renderer_(testSettings()) { renderer_.setScene(GetParam().scene); }

    // Draws with and without, and returns the ranges that were culled as hidden.
    std::uint64_t expectSameWithout(const Camera& camera, RenderOptions options) {
        options.occlusion = true;
        const Kept with = draw(renderer_, camera, options);
        options.occlusion = false;
        const Kept without = draw(renderer_, camera, options);
        expectSameButTies(without, with, mostTies);
        EXPECT_EQ(without.statistics().rangesOccluded, 0U);
        EXPECT_LE(with.statistics().rangesOccluded, with.statistics().rangesCulled);
        EXPECT_LE(with.statistics().rangesProcessed, without.statistics().rangesProcessed);
        return with.statistics().rangesOccluded;
    }

    Renderer renderer_;
};

// Batches so small that some is drawn before the rest is split; samples, grids, buckets and crops in turn.
TEST_P(Occlusion, ChangesNoPictureFromAnyView) {
    const Scene& scene = GetParam().scene;
    constexpr std::array<std::uint32_t, 4> batches{1, 8, 40, 64};
    std::uint64_t occluded = 0;
    for (std::size_t k = 0; k < 16; ++k) {
        RenderOptions options = pictureOptions(96, 72, std::array{1, 4, 2, 3}[k / 2 % 4]);
        options.batch = k % 4 == 0 ? 8 : batches[k % batches.size()];
        options.gridSize = std::array{16, 4, 1}[k % 3];
        options.shadingRate = options.gridSize == 1 ? 16.0F : 1.0F;
        if (k % 5 == 1) options.crop = {0.13F, 0.81F, 0.3F, 0.97F};
        if (k % 4 == 2) std::tie(options.bucketWidth, options.bucketHeight) = std::pair(37, 22);
        const bool inside = k % 2 == 1;
        Camera camera = viewFrom(scene, inside, 700 + k);
        if (k % 6 == 3) camera.near *= 8.0F;  // much crosses the near plane
        if (k % 4 == 3) options.dicingCamera = viewFrom(scene, k % 8 == 3, 800 + k);
        SCOPED_TRACE("view " + std::to_string(k) + ", " + textOf(options));
        occluded += expectSameWithout(camera, options);
    }
    std::printf("%llu ranges occluded\n", static_cast<unsigned long long>(occluded));
    EXPECT_GT(occluded, 0U);
}

// What lies behind is found hidden in batches that the plan chooses too, and whatever the chunks that it comes in.
TEST_P(Occlusion, ChangesNoPictureUnderATightBudget) {
    const Scene& scene = GetParam().scene;
    for (const std::uint64_t mebibytes : {1U, 2U}) {
        RenderOptions options = pictureOptions(80, 60, 2);
        options.memoryBytes = mebibytes * mebibyte;
        options.batch = 16;
        SCOPED_TRACE(textOf(options));
        static_cast<void>(expectSameWithout(viewFrom(scene, false, 21), options));
        static_cast<void>(expectSameWithout(viewFrom(scene, true, 22), options));
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Occlusion, testing::ValuesIn(deepScenes()), [](const auto& tested) { return tested.param.name; });

// Sheets parallel to the picture: the nearest hides all others, but for those that are pushed into the picture's own border.
TEST(OcclusionOfSheets, TheNearestHidesTheOthersInWhateverOrderTheyStand) {
    constexpr int width = 128;
    constexpr int height = 96;
    const Screen screen(width, height);
    Renderer renderer(testSettings());
    for (const bool nearestFirst : {true, false}) {
        Scene scene;
        for (int k = 0; k < 40; ++k) {
            const double depth = 10.0 * (1.0 + (nearestFirst ? k : 39 - k));
            addObject(scene,
                      bilinearPatch({screen.at(-9, -9, depth), screen.at(width + 9, -9, depth), screen.at(width + 9, height + 9, depth),
                                     screen.at(-9, height + 9, depth)}),
                      {1.0F, 0.5F, 0.2F});
        }
        renderer.setScene(scene);
        RenderOptions options = pictureOptions(width, height, 2);
        options.batch = 2;
        const Kept with = draw(renderer, screen.camera(), options);
        options.occlusion = false;
        const Kept without = draw(renderer, screen.camera(), options);
        expectSameBits(without, with);
        EXPECT_EQ(with.coveredPixels(), std::size_t{width} * height);
        EXPECT_GE(with.statistics().rangesOccluded, 30U);
        EXPECT_LT(with.statistics().rangesProcessed * 5, without.statistics().rangesProcessed);
        EXPECT_EQ(without.statistics().rangesOccluded, 0U);
    }
}

TEST(OcclusionOfACity, ChangesNoPicture) {
    const Scene scene = generateScene("city", 20000);
    Renderer renderer(testSettings());
    renderer.setScene(scene);
    for (const char* const view : {"average", "spike", "eyesplit"}) {
        RenderOptions options = pictureOptions(160, 90, 1);
        options.batch = 600;
        const Kept with = draw(renderer, *scene.findCamera(view), options);
        options.occlusion = false;
        const Kept without = draw(renderer, *scene.findCamera(view), options);
        SCOPED_TRACE(view);
        expectSameButTies(without, with, 60);
        EXPECT_GT(with.statistics().rangesOccluded, 0U);
    }
}

// A film of tiles and what is known of their depth.
struct Coarse {
    frame_params frame{};
    std::vector<std::uint32_t> keys;  // tiles, then blocks
    int tilesX = 0;
    int tilesY = 0;
    float tile = 0.0F;  // pixels
    float left = 0.0F;
    float top = 0.0F;
};

std::uint32_t keyOf(float depth) { return ~std::bit_cast<std::uint32_t>(1.0F / depth); }

Coarse randomCoarse(Random& random) {
    Coarse made;
    const auto upTo = [&](int most) { return 1 + static_cast<int>(random.unit() * most); };
    made.tilesX = upTo(40);
    made.tilesY = upTo(40);
    const int samples = upTo(4);
    const int tilePixels = 8 / samples;
    const int x0 = upTo(300) - 1;
    const int y0 = upTo(300) - 1;
    made.tile = static_cast<float>(tilePixels);
    made.left = static_cast<float>(x0);
    made.top = static_cast<float>(y0);
    made.frame.pixel_samples = samples;
    made.frame.tile_cells = samples * tilePixels;
    made.frame.cell_x0 = x0 * samples;
    made.frame.cell_y0 = y0 * samples;
    made.frame.tiles_x = made.tilesX;
    made.frame.tiles = made.tilesX * made.tilesY;
    // Mostly near, so that large spans may be hidden, with some tiles deeper or open.
    const double open = 0.02 * random.unit();
    for (int k = 0; k < made.frame.tiles; ++k) {
        const double what = random.unit();
        const auto depth = static_cast<float>(what < 2.0 * open ? random.between(1.0, 100.0) : random.between(1.0, 2.0));
        made.keys.push_back(what < open ? ~0U : keyOf(depth));
    }
    const int blocksX = (made.tilesX + 7) / 8;
    const int blocksY = (made.tilesY + 7) / 8;
    std::vector<std::uint32_t> blocks(static_cast<std::size_t>(blocksX * blocksY), 0U);
    for (int k = 0; k < made.frame.tiles; ++k) {
        std::uint32_t& block = blocks.at(static_cast<unsigned>(k / made.tilesX / 8 * blocksX + k % made.tilesX / 8));
        block = std::max(block, made.keys[static_cast<std::size_t>(k)]);
    }
    made.keys.insert(made.keys.end(), blocks.begin(), blocks.end());
    return made;
}

struct Verdict {
    bool hidden = true;  // behind all tiles that the span meets
    int tilesX = 0;      // that it meets
    int tilesY = 0;
};

// By every tile of the film, in double precision.
Verdict bruteForce(const Coarse& coarse, const kernels::screen_span& span) {
    Verdict verdict;
    std::vector<bool> columns(static_cast<std::size_t>(coarse.tilesX)), rows(static_cast<std::size_t>(coarse.tilesY));
    for (int y = 0; y < coarse.tilesY; ++y) {
        for (int x = 0; x < coarse.tilesX; ++x) {
            const double left = static_cast<double>(coarse.left) + static_cast<double>(coarse.tile) * x;
            const double top = static_cast<double>(coarse.top) + static_cast<double>(coarse.tile) * y;
            const auto meets = [&](double low, double high, double from) {
                return high >= from && low < from + static_cast<double>(coarse.tile);
            };
            if (!meets(static_cast<double>(span.x0), static_cast<double>(span.x1), left)) continue;
            if (!meets(static_cast<double>(span.y0), static_cast<double>(span.y1), top)) continue;
            columns[static_cast<std::size_t>(x)] = rows[static_cast<std::size_t>(y)] = true;
            if (keyOf(span.nearest) <= coarse.keys[static_cast<unsigned>(y * coarse.tilesX + x)]) verdict.hidden = false;
        }
    }
    verdict.tilesX = static_cast<int>(std::count(columns.begin(), columns.end(), true));
    verdict.tilesY = static_cast<int>(std::count(rows.begin(), rows.end(), true));
    return verdict;
}

bool hides(const Coarse& coarse, const kernels::screen_span& span) { return kernels::span_hidden(&coarse.frame, coarse.keys.data(), span); }

kernels::screen_span randomSpan(Random& random, const Coarse& coarse) {
    const double width = static_cast<double>(coarse.tile) * coarse.tilesX;
    const double height = static_cast<double>(coarse.tile) * coarse.tilesY;
    // Eighths of pixels, exact in float: some lie on the tiles' borders.
    const auto eighths = [](double x) { return static_cast<float>(std::floor(8.0 * x) / 8.0); };
    const double size = random.unit() < 0.5 ? 24.0 : 400.0;
    kernels::screen_span span{};
    span.x0 = coarse.left + eighths(random.between(-0.2, 1.1) * width);
    span.y0 = coarse.top + eighths(random.between(-0.2, 1.1) * height);
    span.x1 = span.x0 + eighths(random.unit() * size);
    span.y1 = span.y0 + eighths(random.unit() * size);
    span.nearest = static_cast<float>(random.unit() < 0.7 ? random.between(1.5, 2.5) : random.between(0.5, 200.0));
    return span;
}

TEST(SpanHidden, HidesNothingThatAnyTileLeavesOpenAndAllSmallSpansThatNoneDoes) {
    Random random(17);
    int hidden = 0;
    int open = 0;
    for (int film = 0; film < 100; ++film) {
        const Coarse coarse = randomCoarse(random);
        for (int k = 0; k < 300; ++k) {
            const kernels::screen_span span = randomSpan(random, coarse);
            const Verdict expected = bruteForce(coarse, span);
            if (expected.tilesX == 0 || expected.tilesY == 0) continue;  // off the film: either is right
            const bool found = hides(coarse, span);
            ASSERT_TRUE(!found || expected.hidden) << "film " << film << ", span " << k;
            if (expected.tilesX <= 4 && expected.tilesY <= 4) {
                ASSERT_EQ(found, expected.hidden) << "film " << film << ", span " << k;
            }
            ++(found ? hidden : open);
        }
    }
    EXPECT_GT(hidden, 2000);
    EXPECT_GT(open, 2000);
}

TEST(SpanHidden, LargeSpansAreHiddenByBlocks) {
    Random random(18);
    Coarse coarse = randomCoarse(random);
    coarse.frame.tiles_x = coarse.tilesX = 40;
    coarse.tilesY = 40;
    coarse.frame.tiles = 1600;
    coarse.keys.assign(1600 + 25, keyOf(2.0F));
    const float all = 40.0F * coarse.tile;
    const kernels::screen_span span{coarse.left + 1.0F, coarse.left + all - 1.0F, coarse.top + 1.0F, coarse.top + all - 1.0F, 2.5F};
    EXPECT_TRUE(hides(coarse, span));
    for (std::size_t block = 1600; block < coarse.keys.size(); ++block) {
        const std::uint32_t before = std::exchange(coarse.keys[block], ~0U);
        EXPECT_FALSE(hides(coarse, span));
        coarse.keys[block] = before;
    }
}

TEST(SpanHidden, EqualDepthIsKeptAndWhatIsNoDepthToo) {
    Random random(19);
    Coarse coarse = randomCoarse(random);
    std::fill(coarse.keys.begin(), coarse.keys.end(), keyOf(2.0F));
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const auto at = [&](float nearest) {
        return kernels::screen_span{coarse.left + 1.0F, coarse.left + 2.0F, coarse.top + 1.0F, coarse.top + 2.0F, nearest};
    };
    EXPECT_FALSE(hides(coarse, at(2.0F)));
    EXPECT_FALSE(hides(coarse, at(std::nextafter(2.0F, 0.0F))));
    EXPECT_TRUE(hides(coarse, at(2.000001F)));
    for (const float nearest : {0.0F, -0.0F, -3.0F, -infinity, nan}) EXPECT_FALSE(hides(coarse, at(nearest))) << nearest;
    // Over all of the film and more, and where an open sample is in every tile.
    std::fill(coarse.keys.begin(), coarse.keys.end(), ~0U);
    for (const float nearest : {1.0F, 1e30F, infinity}) {
        EXPECT_FALSE(hides(coarse, at(nearest)));
        EXPECT_FALSE(hides(coarse, {-infinity, infinity, -infinity, infinity, nearest}));
        EXPECT_FALSE(hides(coarse, {-1e30F, 1e30F, -1e30F, 1e30F, nearest}));
        EXPECT_FALSE(hides(coarse, {nan, nan, nan, nan, nearest}));
    }
}

}  // namespace
}  // namespace tessera::test
