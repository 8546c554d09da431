// A picture does not depend on how it was made: on method, threads, batch size or the kind of atomics, but for exact ties in depth.
#include "frames.h"
#include "picture_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

constexpr int width = 200;
constexpr int height = 120;

struct Way {
    std::string name;
    SplitMethod method = SplitMethod::bounded;
    std::uint32_t batch = 40000;
    unsigned threads = 0;
    bool emulateAtomics = false;
    bool occlusion = false;
};

std::vector<Way> ways() {
    return {
        {"bounded by 1", SplitMethod::bounded, 1, 0, false, false},
        {"bounded by 7", SplitMethod::bounded, 7, 0, false, false},
        {"bounded by 1000", SplitMethod::bounded, 1000, 0, false, false},
        {"bounded, emulated atomics", SplitMethod::bounded, 40000, 0, true, false},
        {"bounded by 300, emulated atomics", SplitMethod::bounded, 300, 0, true, false},
        {"bounded by 7, culled behind what is drawn", SplitMethod::bounded, 7, 0, false, true},
        {"bounded, culled behind what is drawn", SplitMethod::bounded, 40000, 0, false, true},
        {"local", SplitMethod::local, 40000, 0, false, false},
        {"local by 64, emulated atomics", SplitMethod::local, 64, 0, true, false},
        {"local by 64, culled behind what is drawn", SplitMethod::local, 64, 0, false, true},
        {"breadth", SplitMethod::breadth, 40000, 0, false, false},
        {"breadth, emulated atomics", SplitMethod::breadth, 40000, 0, true, false},
        {"cpu, 1 thread", SplitMethod::cpu, 40000, 1, false, false},
        {"cpu, 2 threads by 100", SplitMethod::cpu, 100, 2, false, false},
        {"cpu, 5 threads by 1000", SplitMethod::cpu, 1000, 5, true, false},
    };
}

struct Subject {
    std::string name;
    Scene scene;
    Camera camera;
    std::size_t tiesMost = 2;  // pixels that exact ties may change: where a surface folds or two cross
};

void PrintTo(const Subject& subject, std::ostream* stream) { *stream << subject.name; }

Kept drawnBy(const Way& way, Renderer& renderer, const Camera& camera, int pixelSamples) {
    RenderOptions options = pictureOptions(width, height, pixelSamples);
    options.method = way.method;
    options.batch = way.batch;
    options.threads = way.threads;
    options.emulateAtomics = way.emulateAtomics;
    options.occlusion = way.occlusion;
    return draw(renderer, camera, options);
}

class PictureOf : public testing::TestWithParam<Subject> {
protected:
    PictureOf() : renderer(testSettings()) { renderer.setScene(GetParam().scene); }

    Kept drawn(const Way& way, int pixelSamples) { return drawnBy(way, renderer, GetParam().camera, pixelSamples); }

    Renderer renderer;
};

TEST_P(PictureOf, EveryMethodBatchAndAtomicIsTheSameButForTies) {
    const Subject& subject = GetParam();
    for (const int samples : {1, 2, 3, 4}) {
        const Kept expected = drawn({}, samples);
        ASSERT_GT(expected.coveredPixels(), 1000U);
        for (const Way& way : ways()) {
            SCOPED_TRACE(way.name + ", " + std::to_string(samples) + " x " + std::to_string(samples) + " samples");
            const Kept found = drawn(way, samples);
            const Difference ties = difference(expected, found);
            EXPECT_EQ(ties.inDepth, 0U) << ties.first;
            EXPECT_LE(ties.pixels, subject.tiesMost) << ties.first;
            EXPECT_EQ(found.statistics().pixelsCovered, expected.statistics().pixelsCovered);
            // What is hidden already is neither split nor diced, and patches that miss the picture are not even bounded.
            if (way.occlusion) continue;
            const std::uint64_t processed = found.statistics().rangesProcessed + found.statistics().patchesSkipped;
            EXPECT_EQ(processed, expected.statistics().rangesProcessed + expected.statistics().patchesSkipped);
            EXPECT_EQ(found.statistics().rangesDiced, expected.statistics().rangesDiced);
        }
    }
}

Subject teapot() {
    const Scene scene = builtinScene("teapot");
    return {"teapot", scene, scene.cameras.front(), 2};
}

Subject bumpy() {
    const Scene scene = reference::sceneOf({reference::bumpyBezierMesh(31, 12)});
    return {"bumpy", scene, reference::cameraAt({0.5, 1, 5}, {0, 0, 0}, 35), 2};
}

Subject mixed() {
    const Scene scene = mixedScene();
    return {"mixed", scene, scene.cameras.front(), 2};
}

Subject throughTheNearPlane() {
    const Scene scene = reference::sceneOf({reference::bumpyBezierMesh(9, 10)});
    Camera camera = reference::cameraAt({0.1, 0.3, 0.8}, {0, 0, -0.2}, 60);
    camera.near = 0.25F;
    return {"through_the_near_plane", scene, camera, 2};
}

// Every pixel of the twins may go to either.
Subject coincident() {
    const Scene scene = coincidentScene();
    return {"coincident", scene, scene.cameras.front(), std::size_t{width} * height};
}

INSTANTIATE_TEST_SUITE_P(Scenes, PictureOf, testing::Values(teapot(), bumpy(), mixed(), throughTheNearPlane(), coincident()),
                         [](const auto& tested) { return tested.param.name; });

// Two objects of one mesh at one place have the same depths, and their patches the same parameters: only the object's own number and
// colour tell who won.
TEST(Picture, CoincidentObjectsDifferInTheirOwnPlanesOnly) {
    const Scene scene = coincidentScene();
    Renderer renderer(testSettings());
    renderer.setScene(scene);
    const Kept expected = drawnBy({}, renderer, scene.cameras.front(), 1);
    for (const Way& way : ways()) {
        SCOPED_TRACE(way.name);
        const Kept found = drawnBy(way, renderer, scene.cameras.front(), 1);
        EXPECT_EQ(difference(expected, found).inSurface, 0U);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                if (found.object(x, y) == expected.object(x, y)) continue;
                EXPECT_LE(found.object(x, y), 1);
                EXPECT_LE(expected.object(x, y), 1);
            }
        }
    }
}

// The nearest surface is seen, whatever the order of objects.
TEST(Picture, TheOrderOfObjectsChangesTheirNumbersOnly) {
    Scene scene = mixedScene();
    Renderer renderer(testSettings());
    renderer.setScene(scene);
    RenderOptions options = pictureOptions(width, height, 2);
    options.aovs = Aov::z | Aov::normal | Aov::patch | Aov::uv;
    const Kept expected = draw(renderer, scene.cameras.front(), options);
    std::reverse(scene.objects.begin(), scene.objects.end());
    renderer.setScene(scene);
    const Difference ties = difference(expected, draw(renderer, scene.cameras.front(), options));
    EXPECT_EQ(ties.inDepth, 0U) << ties.first;
    EXPECT_LE(ties.pixels, expected.coveredPixels() / 500) << ties.first;
}

}  // namespace
}  // namespace tessera::test
