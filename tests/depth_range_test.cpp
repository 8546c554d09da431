// Depths at the ends of what the film can tell apart: micropolygons that reach from close by to far away.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tessera/renderer.h"

namespace tessera {
namespace {

// A flat ground as one patch, out to `reach` units each way, seen from one unit above it.
Scene endlessGround(float reach) {
    Mesh mesh;
    mesh.name = "ground";
    for (int v = 0; v < 4; ++v) {
        for (int u = 0; u < 4; ++u) {
            const float x = reach * (2.0F * static_cast<float>(u) / 3.0F - 1.0F);
            const float z = reach * (2.0F * static_cast<float>(v) / 3.0F - 1.0F);
            mesh.points.emplace_back(x, 0.0F, z);
        }
    }
    Scene scene;
    scene.name = "endless ground";
    scene.meshes = {mesh};
    Object object;
    object.name = object.mesh = "ground";
    scene.objects = {object};
    scene.cameras = {lookAt({0.3F, 1.0F, 0.2F}, {0.3F, 0.0F, -3.0F}, 60.0F)};
    return scene;
}

RenderOptions coarse(int width, int height, bool emulate) {
    RenderOptions options;
    options.mode = DiceMode::classical;
    options.width = width;
    options.height = height;
    options.pixelSamples = 1;
    options.maxDepth = 0;
    options.diceRate = 1;
    options.emulateAtomics = emulate;
    options.aovs = Aov::z;
    return options;
}

class DepthRange : public ::testing::TestWithParam<float> {
protected:
    DepthRange() {
        RendererSettings settings;
        settings.cacheFolder = TESSERA_TEST_CACHE;
        renderer_ = Renderer(settings);
    }
    Renderer renderer_;
};

TEST_P(DepthRange, CoveredPixelsHaveAFiniteDepthNoNearerThanNear) {
    const Scene scene = endlessGround(GetParam());
    renderer_.setScene(scene);
    for (const bool emulate : {false, true}) {
        const Frame frame = renderer_.render(scene.cameras[0], coarse(320, 201, emulate));
        const auto rgba = frame.plane("rgba")->values;
        const auto z = frame.plane("Z")->values;
        ASSERT_GT(frame.statistics.pixelsCovered, 0U);
        for (std::size_t k = 0; k < z.size(); ++k) {
            if (rgba[4 * k + 3] == 0.0F) continue;
            ASSERT_TRUE(std::isfinite(z[k])) << "pixel " << k;
            ASSERT_GE(z[k], 0.999F * scene.cameras[0].near) << "pixel " << k;
        }
    }
}

TEST_P(DepthRange, BothKindsOfAtomicsCoverTheSamePixelsAndLeaveNothing) {
    const Scene scene = endlessGround(GetParam());
    renderer_.setScene(scene);
    for (const int width : {1, 7, 64}) {
        const auto wide = renderer_.render(scene.cameras[0], coarse(width, 207, false)).statistics.pixelsCovered;
        EXPECT_EQ(renderer_.render(scene.cameras[0], coarse(width, 207, true)).statistics.pixelsCovered, wide);
        RenderOptions other = coarse(width, 207, false);
        other.diceRate = 8;
        const auto after = renderer_.render(scene.cameras[0], other).statistics.pixelsCovered;
        RendererSettings settings;
        settings.cacheFolder = TESSERA_TEST_CACHE;
        Renderer fresh(settings);
        fresh.setScene(scene);
        EXPECT_EQ(fresh.render(scene.cameras[0], other).statistics.pixelsCovered, after);
    }
}

INSTANTIATE_TEST_SUITE_P(Reaches, DepthRange, ::testing::Values(10.0F, 1.0e4F, 1.0e9F));

}  // namespace
}  // namespace tessera
