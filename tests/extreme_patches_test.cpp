// Patches whose control points say little of what is drawn: borders by records far from the patch's own, and borders that are one point.
#include "frames.h"
#include "picture_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tessera::test {
namespace {

// A camera that sees a square `size` wide around (x, y) of the plane z = 0.
Camera cameraOver(double x, double y, double size) {
    const auto fovy = static_cast<float>(glm::degrees(2.0 * std::atan(0.5 * size)));
    Camera camera =
        lookAt({static_cast<float>(x), static_cast<float>(y), 1.0F}, {static_cast<float>(x), static_cast<float>(y), 0.0F}, fovy);
    camera.name = "over";
    return camera;
}

TEST(ExtremePatches, ABorderDrawnByARecordIsSeenWhereThePatchItselfIsNot) {
    Scene scene;
    Mesh mesh = bilinearPatch({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}});
    EdgeRecord edge;
    edge.points = {{{0, 0, 0}, {1.0F / 3, -0.6F, 0}, {2.0F / 3, -0.6F, 0}, {1, 0, 0}}};
    mesh.edges = {edge};
    addObject(scene, std::move(mesh), glm::vec3(1.0F));
    Renderer renderer(testSettings());
    renderer.setScene(scene);
    for (const SplitMethod method : {SplitMethod::bounded, SplitMethod::breadth, SplitMethod::cpu}) {
        RenderOptions options = pictureOptions(32, 32, 1);
        options.method = method;
        // Coarse, so that the micropolygons beside the border reach far down to it.
        options.shadingRate = 4096.0F;
        EXPECT_EQ(draw(renderer, cameraOver(0.5, -0.2, 0.1), options).coveredPixels(), 32U * 32U) << name(method);
        // Beyond the curve, whose lowest point is -0.45, there is nothing.
        EXPECT_EQ(draw(renderer, cameraOver(0.5, -0.6, 0.1), options).coveredPixels(), 0U) << name(method);
    }
}

// A bag: all four borders are the origin, the inside swells out to a ball of radius 4/9 or so. Nothing but the inside has a length.
Mesh bag() {
    Mesh mesh;
    mesh.name = "bag";
    mesh.points.assign(16, glm::vec3(0.0F));
    mesh.points[5] = {-2.0F, -2.0F, 0.0F};
    mesh.points[6] = {2.0F, -2.0F, 0.0F};
    mesh.points[9] = {-2.0F, 2.0F, 0.0F};
    mesh.points[10] = {2.0F, 2.0F, 0.0F};
    return mesh;
}

TEST(ExtremePatches, AnInsideIsCutFinelyThoughAllBordersArePoints) {
    Scene scene;
    addObject(scene, bag(), glm::vec3(1.0F));
    Renderer renderer(testSettings());
    renderer.setScene(scene);
    RenderOptions options = pictureOptions(256, 256, 1);
    options.gridSize = 8;
    const Kept fine = draw(renderer, cameraOver(0.0, 0.0, 1.5), options);
    EXPECT_GT(fine.coveredPixels(), 1000U);
    // At most a pixel each: as many as it covers at least.
    EXPECT_GT(fine.statistics().micropolygons, fine.coveredPixels());
}

}  // namespace
}  // namespace tessera::test
