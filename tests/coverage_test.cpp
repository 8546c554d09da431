// Nothing is lost: not at the depth limit, not at the near plane, not behind the eye.
#include "frames.h"
#include "picture.h"
#include "picture_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

using reference::cameraAt;

// Whether all pixels within `reach` of (x, y) are covered.
bool deepInside(const Kept& picture, int x, int y, int reach) {
    for (int j = -reach; j <= reach; ++j) {
        for (int i = -reach; i <= reach; ++i) {
            if (x + i < 0 || y + j < 0 || x + i >= picture.width() || y + j >= picture.height()) continue;
            if (!picture.covered(x + i, y + j)) return false;
        }
    }
    return true;
}

// Pixels that `shallow` leaves open although `deep` covers them and all around them; and the other way round.
int openPixels(const Kept& deep, const Kept& shallow, int reach) {
    int open = 0;
    for (int y = 0; y < deep.height(); ++y)
        for (int x = 0; x < deep.width(); ++x) open += deepInside(deep, x, y, reach) && !shallow.covered(x, y) ? 1 : 0;
    return open;
}

// At the limit a range is diced whatever its size. At depth d and rate 8 a patch, some 80 pixels wide, has chords of 80 / 8 / 2^(d/2)
// pixels or less; where ranges of two levels meet, the coarser chord leaves the finer one by its sag, which for a quarter turn over a patch
// is a 1/100 of the chord: pinholes of a tenth of a pixel along few borders, and as many again at silhouettes' chords.
TEST(DepthLimit, DrawsWhatItWouldHaveSplit) {
    Renderer renderer(testSettings());
    const Scene scene = builtinScene("teapot");
    renderer.setScene(scene);
    RenderOptions options = pictureOptions(200, 120, 1);
    options.mode = DiceMode::classical;
    const Kept deep = draw(renderer, scene.cameras.front(), options);
    const auto area = static_cast<double>(deep.coveredPixels());
    for (const SplitMethod method : {SplitMethod::cpu, SplitMethod::breadth, SplitMethod::bounded}) {
        for (int depth = 0; depth <= 6; ++depth) {
            SCOPED_TRACE(std::string(name(method)) + ", depth " + std::to_string(depth));
            options.method = method;
            options.maxDepth = depth;
            const Kept shallow = draw(renderer, scene.cameras.front(), options);
            const int open = openPixels(deep, shallow, 1);
            EXPECT_LE(open, 3);
            EXPECT_LE(openPixels(shallow, deep, 1), 3);
            EXPECT_NEAR(static_cast<double>(shallow.coveredPixels()), area, 0.02 * area);
            ::testing::Test::RecordProperty(std::string(name(method)) + std::to_string(depth), open);
            if (depth == 0) {
                EXPECT_EQ(shallow.statistics().rangesDiced, 32U);
                EXPECT_EQ(shallow.statistics().rangesProcessed, 32U);
            }
        }
    }
}

// An endless ground, nearly: a square around the eye, a unit below it.
Scene ground(double reach) {
    Scene scene;
    addObject(scene, bilinearPatch({{{-reach, -1, reach}, {reach, -1, reach}, {reach, -1, -reach}, {-reach, -1, -reach}}}), {1, 1, 1});
    return scene;
}

struct GroundView {
    std::string name;
    double pitch;  // of the view below the horizon, degrees
    double roll;
    double heading;
    float near;
    int maxDepth;
};

Camera groundCamera(const GroundView& view) {
    Camera camera;
    const auto turn = [](double degrees, const glm::dvec3& axis) { return glm::angleAxis(glm::radians(degrees), axis); };
    const glm::dquat rotation = turn(view.heading, {0, 1, 0}) * turn(-view.pitch, {1, 0, 0}) * turn(view.roll, {0, 0, 1});
    camera.transform.rotation = glm::quat(rotation);
    camera.near = view.near;
    camera.fovy = 60.0F;
    return camera;
}

// Counts pixels that a ground out to `reach` covers with a pixel to spare and that are open, and those that it can't cover and
// that are not.
int wrongPixels(const Kept& picture, const Camera& camera, double reach) {
    const reference::View view(camera, picture.width(), picture.height());
    const auto sees = [&](double x, double y) {
        const reference::Ray ray = view.ray(x, y);
        if (!(ray.direction.y < 0.0)) return false;
        const double t = -1.0 / ray.direction.y;
        const bool within = std::abs(t * ray.direction.x) < reach && std::abs(t * ray.direction.z) < reach;
        return within && t > view.near();  // t is the distance along the view axis
    };
    int wrong = 0;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            const bool here = sees(x + 0.5, y + 0.5);
            bool even = true;
            for (const double down : {-0.5, 0.5, 1.5})
                for (const double right : {-0.5, 0.5, 1.5}) even = even && sees(x + right, y + down) == here;
            wrong += even && picture.covered(x, y) != here ? 1 : 0;
        }
    }
    return wrong;
}

// A plane has no sag, so there are no cracks: what the ground covers is covered, from the horizon to the bottom edge.
TEST(NearPlane, AGroundThroughTheEyeReachesTheBottomOfThePicture) {
    Renderer renderer(testSettings());
    constexpr double reach = 50;
    renderer.setScene(ground(reach));
    const std::vector<GroundView> views{{"level", 0, 0, 0, 0.01F, 23},
                                        {"down", 20, 0, 0, 0.01F, 23},
                                        {"rolled", 10, 30, 77, 0.01F, 23},
                                        {"upside down", 5, 180, 200, 0.1F, 23},
                                        {"straight down", 90, 0, 10, 0.1F, 23},
                                        {"far near plane", 15, 5, 30, 1.5F, 23},
                                        {"depth 0", 20, 0, 0, 0.01F, 0},
                                        {"depth 3", 20, 10, 45, 0.01F, 3},
                                        {"depth 9", 3, 10, 45, 0.001F, 9},
                                        {"far near plane, depth 0", 15, 5, 30, 1.5F, 0},
                                        {"far near plane, depth 3", 40, 25, 80, 1.2F, 3},
                                        {"depth 24", 3, 1, 5, 0.001F, 24}};
    for (const GroundView& view : views) {
        for (const SplitMethod method : {SplitMethod::cpu, SplitMethod::bounded}) {
            SCOPED_TRACE(view.name + ", " + std::string(name(method)));
            RenderOptions options = pictureOptions(160, 120, 1);
            options.mode = DiceMode::classical;
            options.maxDepth = view.maxDepth;
            options.method = method;
            const Camera camera = groundCamera(view);
            const Kept picture = draw(renderer, camera, options);
            EXPECT_GT(picture.coveredPixels(), 2000U);
            EXPECT_EQ(wrongPixels(picture, camera, reach), 0);
        }
    }
}

TEST(NearPlane, DepthIsNeverNearerThanIt) {
    Renderer renderer(testSettings());
    renderer.setScene(ground(50));
    const Camera camera = groundCamera({"", 60, 20, 0, 1.05F, 23});
    const Kept picture = draw(renderer, camera, pictureOptions(160, 120, 1));
    float nearest = std::numeric_limits<float>::infinity();
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) nearest = std::min(nearest, picture.z(x, y));
    EXPECT_GE(nearest, camera.near * (1 - 1e-6F));
    EXPECT_LE(nearest, camera.near * 1.01F);
}

// Cracks are where a range borders on one of half its size, a polyline of sides of 8 / 8 = 1 pixel on one of half of them: seen from
// inside a sphere these leave each other by the sag of a pixel's chord, 1 / (8 R) pixels with a radius of curvature of R pixels,
// over the length of such borders, which is less than that of all borders: area / 4. R is at least 100 here (half the
// picture's height at 90 degrees is 60, and a cubed sphere of single cubics is flatter than a sphere in the middle and up to
// twice as bent at its edges): 1/400 of a pixel or so over 4800 pixels of borders, a dozen samples at the very most.
TEST(Cracks, InsideAClosedSurfaceTheBackgroundShowsThroughCracksOnly) {
    Renderer renderer(testSettings());
    Scene scene;
    addObject(scene, closedMesh(3.0), {1, 1, 1});
    renderer.setScene(scene);
    const std::vector<glm::dvec3> targets{{1, 0, 0}, {-1, 0.1, 0}, {0.1, 0.99, 0}, {0, -1, 0.2}, {0.2, 0.1, 1}, {0.5, 0.4, -1}, {1, 1, 1}};
    for (const int depth : {0, 2, 23}) {
        for (const glm::dvec3& target : targets) {
            RenderOptions options = pictureOptions(160, 120, 1);
            options.mode = DiceMode::classical;
            options.maxDepth = depth;
            Camera camera = cameraAt({0.3, -0.2, 0.1}, glm::dvec3(0.3, -0.2, 0.1) + target, 90);
            const Kept picture = draw(renderer, camera, options);
            const std::size_t open = std::size_t{160} * 120 - picture.coveredPixels();
            EXPECT_LE(open, 12U);
            EXPECT_EQ(picture.statistics().pixelsCovered, picture.coveredPixels());
        }
    }
}

// Undivided patches share their borders' vertices to the bit, on the careful path too, which draws what is nearer than the near
// plane or far outside the picture.
TEST(Cracks, PatchesOfEqualRatesHaveNone) {
    Renderer renderer(testSettings());
    Scene scene;
    addObject(scene, closedMesh(3.0), {1, 1, 1});
    renderer.setScene(scene);
    reference::Random random(5);
    for (int k = 0; k < 20; ++k) {
        RenderOptions options = pictureOptions(160, 120, 1);
        options.mode = DiceMode::classical;
        options.maxDepth = 0;
        options.diceRate = 1 + k;
        const glm::dvec3 eye = random.inCube(0.8);
        const Kept picture = draw(renderer, cameraAt(eye, eye + random.inCube(1.0), 70), options);
        EXPECT_EQ(picture.coveredPixels(), 160U * 120U) << "view " << k;
    }
}

}  // namespace
}  // namespace tessera::test
