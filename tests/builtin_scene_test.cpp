// Built-in scenes: whole, closed where they are solid, lit and in the picture.
#include "exact_patches.h"
#include "seen.h"
#include "tessera/error.h"
#include "tessera/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tessera {
namespace {

using test::placedPoints;
using test::seenBy;

TEST(BuiltinScene, TeapotIsWholeAndStandsOnTheGround) {
    EXPECT_TRUE(isBuiltinScene("teapot"));
    const Scene scene = builtinScene("teapot");
    EXPECT_NO_THROW(scene.validate());
    EXPECT_EQ(scene.placedPatchCount(), 32U);
    const Bounds bounds = worldBounds(scene);
    EXPECT_NEAR(bounds.lower.y, 0.0, 1e-5);  // stands on the ground, y up
    EXPECT_NEAR(bounds.upper.y, 3.15, 1e-5);
}

TEST(BuiltinScene, EachIsValidLitAndInThePicture) {
    for (const std::string_view name : builtinSceneNames()) {
        EXPECT_TRUE(isBuiltinScene(name));
        const Scene scene = builtinScene(name);
        EXPECT_EQ(scene.name, name);
        EXPECT_NO_THROW(scene.validate());
        EXPECT_FALSE(scene.lights.empty()) << name;
        const Camera* camera = scene.findCamera("camera");
        ASSERT_NE(camera, nullptr) << name;
        double highest = 0.0;
        for (const glm::dvec3& point : placedPoints(scene)) {
            const glm::dvec3 seen = seenBy(*camera, point);
            EXPECT_LT(std::abs(seen.x), 0.98 * 1280.0 / 720.0) << name;
            EXPECT_LT(std::abs(seen.y), 0.98) << name;
            EXPECT_GT(seen.z, camera->near) << name;
            highest = std::max(highest, std::abs(seen.y));
        }
        EXPECT_GT(highest, 0.5) << name;
    }
}

TEST(BuiltinScene, SolidsAreClosedToTheBitAndFaceOutward) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> solids{
        {"sphere", {"sphere"}}, {"torus", {"torus"}}, {"quadrics", {"cone", "cylinder", "dome"}}, {"nurbs", {"vase", "tray"}}};
    for (const auto& [name, meshes] : solids) {
        const Scene scene = builtinScene(name);
        for (const std::string& one : meshes) {
            const Mesh* mesh = scene.findMesh(one);
            ASSERT_NE(mesh, nullptr) << one;
            EXPECT_EQ(mesh->kind, PatchKind::rational) << one;
            EXPECT_EQ(test::countBorders(*mesh).open, 0U) << one;
            EXPECT_GT(test::volume(*mesh, 8), 0.1) << one;
        }
    }
}

// The enclosed volume, by the divergence theorem on a fine grid: positive only where du x dv points outwards.
TEST(BuiltinScene, TeapotsBodyFacesOutwards) {
    const Scene scene = builtinScene("teapot");
    const std::vector<glm::vec3>& points = scene.meshes[0].points;
    const auto at = [&](std::size_t patch, double u, double v) {
        const auto bernstein = [](double t) {
            return std::array<double, 4>{(1 - t) * (1 - t) * (1 - t), 3 * t * (1 - t) * (1 - t), 3 * t * t * (1 - t), t * t * t};
        };
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < 16; ++i) sum += bernstein(u)[i % 4] * bernstein(v)[i / 4] * glm::dvec3(points[patch * 16 + i]);
        return sum;
    };
    double volume = 0.0;
    constexpr int kSteps = 16;
    for (std::size_t patch = 0; patch < 32; ++patch) {
        for (int i = 0; i < kSteps * kSteps; ++i) {
            const double u = (i % kSteps + 0.5) / kSteps;
            const double v = std::floor(static_cast<double>(i) / kSteps) / kSteps + 0.5 / kSteps;
            const double h = 0.5 / kSteps;
            const glm::dvec3 normal = glm::cross(at(patch, u + h, v) - at(patch, u - h, v), at(patch, u, v + h) - at(patch, u, v - h));
            volume += glm::dot(at(patch, u, v), normal) / 3.0;
        }
    }
    EXPECT_GT(volume, 20.0);
    EXPECT_LT(volume, 40.0);
}

TEST(BuiltinScene, UnknownNameIsAnErrorThatNamesTheKnownOnes) {
    EXPECT_FALSE(isBuiltinScene("teacup"));
    try {
        static_cast<void>(builtinScene("teacup"));
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("'teacup'"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("teapot"), std::string::npos);
    }
}

}  // namespace
}  // namespace tessera
