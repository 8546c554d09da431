// Pictures that were looked at and found good, kept in tests/golden: what is rendered today must look the same.
// Run with TESSERA_UPDATE_GOLDEN=1 to write them anew after a change that is meant to be seen; then look at them.
#include "frames.h"
#include "picture_scenes.h"
#include "run_program.h"

#include "formats/image_file.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

constexpr int width = 160;
constexpr int height = 90;

struct Subject {
    std::string name;
    DiceMode mode;
    Scene scene;
    Camera camera;
};

void PrintTo(const Subject& subject, std::ostream* stream) { *stream << subject.name; }

// Linear light, three channels a pixel.
std::vector<double> readPicture(const std::filesystem::path& path) {
    const auto input = OIIO::ImageInput::open(path.string());
    if (!input) throw std::runtime_error("cannot read " + path.string());
    const OIIO::ImageSpec& spec = input->spec();
    EXPECT_EQ(spec.width, width);
    EXPECT_EQ(spec.height, height);
    std::vector<float> values(static_cast<std::size_t>(spec.width * spec.height * spec.nchannels));
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data())) throw std::runtime_error(input->geterror());
    std::vector<double> linear;
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (k % static_cast<std::size_t>(spec.nchannels) > 2) continue;
        const auto s = static_cast<double>(values[k]);
        linear.push_back(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
    }
    return linear;
}

class Golden : public testing::TestWithParam<Subject> {};

// Shading differs between devices by roundings of 1e-5, which is a step of the 8-bit file at most: 1/255 of sRGB, whose slope is 2.3 at
// white, or 0.01 of linear light. Vertices may snap to the next 1/1024 pixel, which moves single samples across edges: 1/16 of the pixel
// each, between colours that are less than 1 apart. Two of them, in one pixel of a hundred, are more than rounding explains.
TEST_P(Golden, ThePictureLooksAsItDid) {
    const Subject& subject = GetParam();
    Renderer renderer(testSettings());
    renderer.setScene(subject.scene);
    RenderOptions options;
    options.mode = subject.mode;
    options.width = width;
    options.height = height;
    options.background = {0.18F, 0.2F, 0.24F, 1.0F};
    const Frame frame = renderer.render(subject.camera, options);
    const std::filesystem::path golden = std::filesystem::path(TESSERA_GOLDEN_FOLDER) / (subject.name + ".png");
    if (std::getenv("TESSERA_UPDATE_GOLDEN") != nullptr) {
        writeImage(golden, frame, {});
        GTEST_SKIP() << golden << " was written anew: look at it";
    }
    const ScratchFolder folder;
    writeImage(folder.path() / "now.png", frame, {});
    const std::vector<double> expected = readPicture(golden);
    const std::vector<double> found = readPicture(folder.path() / "now.png");
    ASSERT_EQ(found.size(), expected.size());
    std::size_t moved = 0;
    double largest = 0.0;
    for (std::size_t pixel = 0; pixel < expected.size(); pixel += 3) {
        double off = 0.0;
        for (std::size_t c = pixel; c < pixel + 3; ++c) off = std::max(off, std::abs(found[c] - expected[c]));
        moved += off > 0.01 ? 1U : 0U;
        largest = std::max(largest, off);
    }
    EXPECT_LE(moved, static_cast<std::size_t>(width * height / 100));
    EXPECT_LE(largest, 2.0 / 16.0 + 0.01);
}

Subject teapot() {
    const Scene scene = builtinScene("teapot");
    return {"teapot", DiceMode::classical, scene, scene.cameras.front()};
}

// Bezier and Gregory patches, matte and plastic, a sun and a sky.
Subject mixed() {
    const Scene scene = mixedScene();
    return {"mixed", DiceMode::classical, scene, scene.cameras.front()};
}

// The inside of the same, from among the patches: cut off at the near plane.
Subject within() {
    const Scene scene = mixedScene();
    Camera camera = reference::cameraAt({0.3, 0.3, 1.2}, {0, 0, -0.2}, 70);
    camera.near = 0.3F;
    return {"within", DiceMode::classical, scene, camera};
}

// What a user sees first of each kind of patch.
Subject watertight(const std::string& builtin) {
    const Scene scene = builtinScene(builtin);
    return {"watertight_" + builtin, DiceMode::watertight, scene, scene.cameras.front()};
}

INSTANTIATE_TEST_SUITE_P(Scenes, Golden,
                         testing::Values(teapot(), mixed(), within(), watertight("teapot"), watertight("sphere"), watertight("torus"),
                                         watertight("quadrics"), watertight("nurbs"), watertight("pn")),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace tessera::test
