// Crop windows: the pixels of the full picture, to the bit, and windows that share an edge tile it.
#include "frames.h"
#include "picture_scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

using Window = std::array<float, 4>;  // x0, x1, y0, y1

Kept cropped(Renderer& renderer, const Camera& camera, RenderOptions options, const Window& window) {
    options.crop = window;
    return draw(renderer, camera, options);
}

std::vector<Window> windows() {
    return {{0.0F, 1.0F, 0.0F, 1.0F},     {0.25F, 0.75F, 0.25F, 0.75F}, {0.0F, 0.31F, 0.4F, 1.0F}, {0.5F, 0.505F, 0.5F, 0.508F},
            {0.333F, 0.336F, 0.0F, 1.0F}, {0.1F, 0.9F, 0.61F, 0.63F},   {0.0F, 0.01F, 0.0F, 0.01F}};
}

std::string textOf(const Window& window) {
    std::string text;
    for (const float edge : window) text += (text.empty() ? "" : ", ") + std::to_string(edge);
    return text;
}

class CropOf : public testing::TestWithParam<int> {};

TEST_P(CropOf, AWindowHoldsThePixelsOfTheFullPicture) {
    Renderer renderer(testSettings());
    for (const Scene& scene : {builtinScene("teapot"), mixedScene()}) {
        renderer.setScene(scene);
        for (const int samples : {1, 2, 3, 4}) {
            RenderOptions options = pictureOptions(203, 121, samples);
            options.method = static_cast<SplitMethod>(GetParam());
            options.threads = 1;  // ties go by the order of ranges, which several threads share out otherwise for fewer ranges
            const Kept whole = draw(renderer, scene.cameras.front(), options);
            for (const Window& window : windows()) {
                SCOPED_TRACE(std::to_string(samples) + " x " + std::to_string(samples) + " samples, window " + textOf(window));
                expectSameBits(whole, cropped(renderer, scene.cameras.front(), options, window));
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, CropOf, testing::Values(0, 1, 2),
                         [](const auto& tested) { return std::string(name(static_cast<SplitMethod>(tested.param))); });

// What crosses the near plane takes another path to the film.
TEST(Crop, HoldsForPatchesThroughTheNearPlane) {
    Renderer renderer(testSettings());
    const Scene scene = reference::sceneOf({reference::bumpyBezierMesh(9, 10)});
    Camera camera = reference::cameraAt({0.1, 0.3, 0.8}, {0, 0, -0.2}, 60);
    camera.near = 0.25F;
    renderer.setScene(scene);
    const RenderOptions options = pictureOptions(203, 121, 2);
    const Kept whole = draw(renderer, camera, options);
    for (const Window& window : windows()) {
        SCOPED_TRACE(textOf(window));
        expectSameBits(whole, cropped(renderer, camera, options, window));
    }
}

// RenderMan's rule: a window holds the pixels from ceil(size x0) to ceil(size x1) - 1.
TEST(Crop, WindowsThatShareEdgesTileThePicture) {
    Renderer renderer(testSettings());
    const Scene scene = builtinScene("teapot");
    renderer.setScene(scene);
    const std::vector<float> across{0.0F, 0.1F, 0.3333F, 0.5F, 0.71F, 1.0F};
    const std::vector<float> down{0.0F, 0.02F, 0.45F, 0.8F, 1.0F};
    const RenderOptions options = pictureOptions(97, 61, 2);
    const Kept whole = draw(renderer, scene.cameras.front(), options);
    std::vector<int> timesSeen(std::size_t{97} * 61, 0);
    for (std::size_t i = 0; i + 1 < across.size(); ++i) {
        for (std::size_t j = 0; j + 1 < down.size(); ++j) {
            const Kept part = cropped(renderer, scene.cameras.front(), options, {across[i], across[i + 1], down[j], down[j + 1]});
            EXPECT_EQ(part.x0(), static_cast<int>(std::ceil(97.0 * static_cast<double>(across[i]))));
            EXPECT_EQ(part.y0(), static_cast<int>(std::ceil(61.0 * static_cast<double>(down[j]))));
            expectSameBits(whole, part);
            for (int y = part.y0(); y < part.y0() + part.height(); ++y)
                for (int x = part.x0(); x < part.x0() + part.width(); ++x)
                    ++timesSeen[static_cast<std::size_t>(y) * 97 + static_cast<std::size_t>(x)];
        }
    }
    for (const int times : timesSeen) EXPECT_EQ(times, 1);
}

TEST(Crop, AFrameTellsItsWindowAndTheFullSize) {
    Renderer renderer(testSettings());
    const Scene scene = builtinScene("teapot");
    renderer.setScene(scene);
    RenderOptions options = pictureOptions(100, 50, 1);
    options.crop = {0.1F, 0.4F, 0.5F, 1.0F};
    const Frame frame = renderer.render(scene.cameras.front(), options);
    // 0.1F and 0.4F are a little more than a tenth and two fifths.
    EXPECT_EQ(frame.x0, 11);
    EXPECT_EQ(frame.width, 30);
    EXPECT_EQ(frame.y0, 25);
    EXPECT_EQ(frame.height, 25);
    EXPECT_EQ(frame.fullWidth, 100);
    EXPECT_EQ(frame.fullHeight, 50);
    for (const Plane& plane : frame.planes) EXPECT_EQ(plane.values.size(), static_cast<std::size_t>(plane.channels) * 30 * 25);
}

// The largest picture there is, a little of it at a time.
TEST(Crop, AWindowOfTheLargestPictureIsRendered) {
    Renderer renderer(testSettings());
    const Screen screen(65536, 65536);
    Scene scene;
    const auto corner = [&screen](double x, double y) { return screen.at(x, y, 500); };  // what is beyond 1000 is culled
    addObject(scene, bilinearPatch({corner(60000, 60000), corner(60032, 60000), corner(60032, 60032), corner(60000, 60032)}), {1, 1, 1});
    renderer.setScene(scene);
    RenderOptions options = pictureOptions(65536, 65536, 1);
    options.crop = {59990.0F / 65536.0F, 60050.0F / 65536.0F, 59990.0F / 65536.0F, 60050.0F / 65536.0F};
    const Kept picture = draw(renderer, screen.camera(), options);
    ASSERT_EQ(picture.width(), 60);
    int wrong = 0;
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 60; ++x) wrong += picture.covered(x, y) != (x >= 10 && x < 42 && y >= 10 && y < 42) ? 1 : 0;
    EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace tessera::test
