// Watertight mode has no cracks: over closed solids nothing of the background shows where the solid certainly is, and nothing of a
// solid's far side where its near side certainly is. A background pixel is told by its alpha, which is below 1.
#include "closed_models.h"
#include "frames.h"
#include "leaks.h"

#include <gtest/gtest.h>

#include <array>
#include <ostream>
#include <string>
#include <vector>

namespace tessera::test {

static void PrintTo(const ClosedModel& model, std::ostream* stream) { *stream << model.name; }

namespace {

constexpr int side = 128;  // pixels, both ways
constexpr std::array methods{SplitMethod::bounded, SplitMethod::breadth, SplitMethod::cpu};

RenderOptions watertightOptions() {
    RenderOptions options = pictureOptions(side, side, 1);
    options.mode = DiceMode::watertight;
    options.background = {1.0F, 0.0F, 1.0F, 0.0F};
    return options;
}

class Watertight : public testing::TestWithParam<ClosedModel> {
protected:
    Watertight() : renderer(testSettings()) { renderer.setScene(GetParam().scene); }

    Renderer renderer;
};

// Views, methods, samples, grids and rates in turn, so that most pairs of them occur.
TEST_P(Watertight, ShowsNothingThroughAClosedModel) {
    const Scene& scene = GetParam().scene;
    const reference::RayCaster caster(scene);
    constexpr std::array kinds{ViewKind::near, ViewKind::far, ViewKind::grazing, ViewKind::throughNearPlane};
    constexpr std::array gridSizes{2, 4, 8, 16, 32};
    constexpr std::array shadingRates{1.0F, 4.0F, 0.25F};
    int covered = 0;
    for (std::size_t k = 0; k < 20; ++k) {
        RenderOptions options = watertightOptions();
        options.pixelSamples = k % 4 == 3 ? 2 : 1;
        options.method = methods[k % methods.size()];
        options.gridSize = gridSizes[k % gridSizes.size()];
        options.shadingRate = shadingRates[k / 3 % shadingRates.size()];
        const Camera camera = randomView(scene, kinds[(k + k / 4) % kinds.size()], 1000 + k);
        const Leaks leaks = leaksOf(draw(renderer, camera, options), caster, camera);
        SCOPED_TRACE("view " + std::to_string(k) + ", " + std::string(name(options.method)) + ", grid " + std::to_string(options.gridSize) +
                     ", rate " + std::to_string(options.shadingRate) + ", " + std::to_string(options.pixelSamples) +
                     " samples: " + leaks.first);
        EXPECT_EQ(leaks.open, 0);
        EXPECT_EQ(leaks.through, 0);
        covered += leaks.covered;
    }
    EXPECT_GT(covered, 20 * 1000);
}

// From around the middle nothing but the solid can be seen, however coarse its micropolygons are, and wherever they are measured.
// A torus has no inside around its middle.
TEST_P(Watertight, EnclosesTheEyeAtAnyRate) {
    if (GetParam().name == "torus") GTEST_SKIP() << "the middle of a torus is outside";
    const Scene& scene = GetParam().scene;
    for (std::size_t k = 0; k < 12; ++k) {
        RenderOptions options = watertightOptions();
        options.method = methods[k % methods.size()];
        options.gridSize = 1 << (k % 6);
        options.shadingRate = std::array{4.0F, 1.0F, 65536.0F, 64.0F}[k / 3 % 4];
        if (k % 2 == 1) options.dicingCamera = randomView(scene, k % 4 == 1 ? ViewKind::throughNearPlane : ViewKind::far, 3000 + k);
        const Kept picture = draw(renderer, randomView(scene, ViewKind::inside, 2000 + k), options);
        EXPECT_EQ(picture.coveredPixels(), std::size_t{side} * side)
            << "view " << k << ", " << name(options.method) << ", grid " << options.gridSize << ", rate " << options.shadingRate;
    }
}

struct Way {
    std::string name;
    SplitMethod method;
    std::uint32_t batch;
    bool emulateAtomics;
    int lanes;  // 0: the device's own
    bool occlusion;
};

std::vector<Way> ways() {
    return {{"bounded by 1", SplitMethod::bounded, 1, false, 0, false},
            {"bounded by 7", SplitMethod::bounded, 7, false, 0, false},
            {"bounded by 300, emulated atomics", SplitMethod::bounded, 300, true, 0, false},
            {"bounded by 7, culled behind what is drawn", SplitMethod::bounded, 7, false, 0, true},
            {"local", SplitMethod::local, 40000, false, 0, false},
            {"local by 64, culled behind what is drawn", SplitMethod::local, 64, false, 0, true},
            {"1 lane, local", SplitMethod::local, 64, false, 1, false},
            {"1 lane by 7, culled behind what is drawn", SplitMethod::bounded, 7, false, 1, true},
            {"breadth", SplitMethod::breadth, 40000, false, 0, false},
            {"cpu", SplitMethod::cpu, 40000, false, 0, false},
            {"cpu by 50", SplitMethod::cpu, 50, false, 0, false},
            {"8 lanes", SplitMethod::bounded, 40000, false, 8, false},
            {"8 lanes, cpu", SplitMethod::cpu, 40000, false, 8, false},
            {"1 lane", SplitMethod::bounded, 40000, false, 1, false},
            {"1 lane, breadth", SplitMethod::breadth, 40000, false, 1, false}};
}

// Exact ties in depth are where a surface folds over: few pixels of a silhouette.
constexpr std::size_t mostTies = 4;

TEST(WatertightPicture, IsTheSameByEveryMethodBatchAndLanesButForTies) {
    std::array<Renderer, 3> renderers{Renderer(testSettings()), Renderer(testSettings()), Renderer(testSettings())};
    for (const int lanes : {1, 8}) {
        RendererSettings settings = testSettings();
        settings.lanes = lanes;
        renderers[lanes == 1 ? 1 : 2] = Renderer(settings);
    }
    std::uint64_t seed = 4000;
    for (const ClosedModel& model : closedModels()) {
        for (Renderer& renderer : renderers) renderer.setScene(model.scene);
        for (const ViewKind kind : {ViewKind::near, ViewKind::throughNearPlane}) {
            const Camera camera = randomView(model.scene, kind, ++seed);
            RenderOptions options = watertightOptions();
            options.pixelSamples = 1 + static_cast<int>(seed % 3);
            options.occlusion = false;
            const Kept expected = draw(renderers[0], camera, options);
            EXPECT_GT(expected.coveredPixels(), 100U);
            for (const Way& way : ways()) {
                SCOPED_TRACE(model.name + ", " + way.name);
                options.method = way.method;
                options.batch = way.batch;
                options.emulateAtomics = way.emulateAtomics;
                options.occlusion = way.occlusion;
                const Kept found = draw(renderers[way.lanes == 0 ? 0 : (way.lanes == 1 ? 1 : 2)], camera, options);
                const Difference ties = difference(expected, found);
                EXPECT_EQ(ties.inDepth, 0U) << ties.first;
                EXPECT_LE(ties.pixels, mostTies) << ties.first;
                if (way.occlusion) continue;
                EXPECT_EQ(found.statistics().rangesDiced, expected.statistics().rangesDiced);
                EXPECT_EQ(found.statistics().micropolygons, expected.statistics().micropolygons);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Models, Watertight, testing::ValuesIn(closedModels()), [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace tessera::test
