// The layouts of the kernels over a device (src/device/lanes.clh): vectors of 16 or 8 on CPUs, one value a work-item on GPUs.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "tessera/error.h"
#include "tessera/renderer.h"

namespace tessera {
namespace {

RendererSettings settingsFor(int lanes) {
    RendererSettings settings;
    settings.cacheFolder = TESSERA_TEST_CACHE;
    settings.lanes = lanes;
    return settings;
}

// The bits of all planes, one after the other.
std::vector<std::uint32_t> pictureBits(Renderer& renderer, const Camera& camera, const RenderOptions& options) {
    std::vector<std::uint32_t> bits;
    for (const Plane& plane : renderer.render(camera, options).planes) {
        for (const float value : plane.values) bits.push_back(std::bit_cast<std::uint32_t>(value));
    }
    return bits;
}

TEST(Lanes, GiveTheSamePictureToTheBit) {
    const Scene scene = builtinScene("teapot");
    RenderOptions options;
    options.mode = DiceMode::classical;
    options.width = 200;
    options.height = 113;
    options.aovs = Aov::z | Aov::normal | Aov::object | Aov::patch | Aov::uv;
    Renderer wide(settingsFor(16));
    Renderer half(settingsFor(8));
    Renderer single(settingsFor(1));
    for (Renderer* const renderer : {&wide, &half, &single}) renderer->setScene(scene);
    for (const int samples : {1, 3, 4}) {
        for (const int rate : {8, 13}) {
            options.pixelSamples = samples;
            options.diceRate = rate;
            const std::vector<std::uint32_t> expected = pictureBits(wide, scene.cameras[0], options);
            EXPECT_TRUE(pictureBits(half, scene.cameras[0], options) == expected) << samples << " samples, rate " << rate;
            EXPECT_TRUE(pictureBits(single, scene.cameras[0], options) == expected) << samples << " samples, rate " << rate;
        }
    }
}

TEST(Lanes, GiveTheSamePictureNearAndBeyondTheNearPlane) {
    const Scene scene = builtinScene("teapot");
    // Inside the teapot, with a near plane that cuts it and micropolygons of any size.
    Camera camera = lookAt({0.0F, 1.0F, 0.0F}, {1.0F, 1.2F, 0.3F}, 70.0F);
    camera.near = 0.5F;
    RenderOptions options;
    options.mode = DiceMode::classical;
    options.width = 160;
    options.height = 90;
    options.pixelSamples = 2;
    options.maxDepth = 3;
    options.aovs = Aov::z | Aov::normal;
    Renderer wide(settingsFor(16));
    Renderer single(settingsFor(1));
    wide.setScene(scene);
    single.setScene(scene);
    EXPECT_TRUE(pictureBits(single, camera, options) == pictureBits(wide, camera, options));
}

TEST(Lanes, RefusesOtherNumbers) {
    try {
        const Renderer renderer(settingsFor(3));
        FAIL() << "3 lanes were taken";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("lanes is 3"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace tessera
