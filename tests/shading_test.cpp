// Radiance and normals against formulas in double precision, at the point that a pixel's (u, v) names.
#include "frames.h"
#include "picture_scenes.h"
#include "ray_caster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

constexpr int side = 48;

// The rotation that takes +z to `direction`.
glm::quat towards(const glm::dvec3& direction) { return lookAt(glm::vec3(direction), glm::vec3(0.0F), 45.0F).transform.rotation; }

Light light(LightKind kind, const glm::dvec3& direction, const glm::vec3& color, float intensity) {
    Light result;
    result.name = "light";
    result.kind = kind;
    result.color = color;
    result.intensity = intensity;
    if (kind == LightKind::point) {
        result.transform.translation = glm::vec3(direction);
    } else {
        result.transform.rotation = towards(direction);
    }
    return result;
}

// A square of side 4 around the origin that faces along `normal`, and a camera 10 before it on the z axis.
Scene tilted(const glm::dvec3& normal, const glm::vec3& color) {
    const glm::dvec3 unit = glm::normalize(normal);
    const glm::dvec3 a = 2.0 * glm::normalize(glm::cross(glm::dvec3(0.3, 1, 0.1), unit));
    const glm::dvec3 b = glm::cross(unit, a);
    Scene scene;
    addObject(scene, bilinearPatch({-a - b, a - b, a + b, -a + b}), color);
    scene.cameras.push_back(reference::cameraAt({0, 0, 10}, {0, 0, 0}, 30));
    return scene;
}

// What a surface shows at a pixel.
struct Shown {
    glm::dvec3 radiance;
    glm::dvec3 normal;
    glm::dvec3 point;  // in the world, where (u, v) says
};

class Shading : public testing::Test {
protected:
    Shading() : renderer(testSettings()) {}

    Kept picture(const Scene& scene, bool cullBackfaces = false) {
        RenderOptions options = pictureOptions(side, side, 1);
        options.cullBackfaces = cullBackfaces;
        renderer.setScene(scene);
        return draw(renderer, scene.cameras.front(), options);
    }

    // All covered pixels of a picture.
    std::vector<Shown> shown(const Scene& scene) {
        const Kept drawn = picture(scene);
        std::vector<Shown> result;
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                if (!drawn.covered(x, y)) continue;
                const Object& object = scene.objects.at(static_cast<std::size_t>(drawn.object(x, y)));
                const Mesh& mesh = *scene.findMesh(object.mesh);
                const std::vector<glm::dvec3> points = reference::patchPoints(mesh, static_cast<std::size_t>(drawn.patch(x, y)));
                const std::span<const float> uv = drawn.at("uv", x, y), rgba = drawn.at("rgba", x, y), n = drawn.at("N", x, y);
                const glm::dvec3 local = reference::evaluate(mesh.kind, points, uv[0], uv[1]).position;
                result.push_back({{rgba[0], rgba[1], rgba[2]}, {n[0], n[1], n[2]}, reference::placement(object.transform)(local)});
            }
        }
        EXPECT_GT(result.size(), 100U);
        return result;
    }

    Renderer renderer;
};

void expectColour(const glm::dvec3& found, const glm::dvec3& expected, double tolerance) {
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[c], expected[c], tolerance) << "channel " << c;
}

TEST_F(Shading, AMatteSurfaceThatFacesADirectionalLightShowsItsColourTimesTheLights) {
    const glm::vec3 color(0.9F, 0.5F, 0.25F);
    Scene scene = tilted({0, 0, 1}, color);
    scene.lights.push_back(light(LightKind::directional, {0, 0, 1}, {1, 1, 1}, 1.0F));
    for (const Shown& at : shown(scene)) expectColour(at.radiance, color, 1e-5);
    scene.lights[0] = light(LightKind::directional, {0, 0, 1}, {0.5F, 1, 2}, 3.0F);
    for (const Shown& at : shown(scene)) expectColour(at.radiance, 3.0 * glm::dvec3(color) * glm::dvec3(0.5, 1, 2), 1e-5);
}

TEST_F(Shading, ATiltedMatteSurfaceShowsTheCosine) {
    const glm::dvec3 from = glm::normalize(glm::dvec3(0.4, 0.7, 0.9));
    for (const glm::dvec3 normal : {glm::dvec3(0, 0, 1), glm::dvec3(0.5, 0.2, 1), glm::dvec3(-0.7, -0.7, 0.8)}) {
        Scene scene = tilted(normal, {1, 1, 1});
        scene.lights.push_back(light(LightKind::directional, from, {1, 1, 1}, 1.0F));
        const double cosine = std::max(0.0, glm::dot(glm::normalize(normal), from));
        for (const Shown& at : shown(scene)) {
            expectColour(at.radiance, glm::dvec3(cosine), 2e-6);
            expectColour(at.normal, glm::normalize(normal), 2e-6);
        }
    }
}

TEST_F(Shading, APointLightFallsOffWithTheSquareOfTheDistance) {
    const glm::dvec3 place(0.5, 0.8, 2.5);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.1, 0.2, 1));
    Scene scene = tilted(normal, {1, 1, 1});
    scene.lights.push_back(light(LightKind::point, place, {1, 1, 1}, 6.0F));
    for (const Shown& at : shown(scene)) {
        const glm::dvec3 gap = place - at.point;
        const double square = glm::dot(gap, gap);
        const double expected = 6.0 * std::max(0.0, glm::dot(normal, gap) / std::sqrt(square)) / square;
        expectColour(at.radiance, glm::dvec3(expected), 1e-5 * (1 + expected));
    }
}

// At distance 1 a point light gives what a directional one of its intensity gives.
TEST_F(Shading, APointLightAtDistanceOneHasItsIntensity) {
    Scene scene = tilted({0, 0, 1}, {1, 1, 1});
    scene.lights.push_back(light(LightKind::point, {0, 0, 1}, {1, 1, 1}, 0.75F));
    double brightest = 0.0;
    for (const Shown& at : shown(scene)) brightest = std::max(brightest, at.radiance.x);
    // A pixel is 0.11 wide, so some point lies within 0.1 of the one below the light: (1 + 0.1^2)^-1.5 of it at least.
    EXPECT_GE(brightest, 0.75 * 0.985);
    EXPECT_LE(brightest, 0.75 + 1e-5);
}

TEST_F(Shading, AHemiLightIsHalfOnItsHorizon) {
    const glm::dvec3 up = glm::normalize(glm::dvec3(0.3, 1, 0.2));
    for (const glm::dvec3 normal : {glm::dvec3(0, 0.6, 1), glm::dvec3(0.3, -1.2, 1), glm::dvec3(0.1, 0.1, 1)}) {
        Scene scene = tilted(normal, {0.5F, 1, 1});
        scene.lights.push_back(light(LightKind::hemi, up, {1, 1, 0.5F}, 0.8F));
        const double share = 0.8 * (0.5 + 0.5 * glm::dot(glm::normalize(normal), up));
        for (const Shown& at : shown(scene)) expectColour(at.radiance, share * glm::dvec3(0.5, 1, 0.5), 2e-6);
    }
}

TEST_F(Shading, LightsAddUp) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.2, 0.3, 1));
    const std::vector<glm::dvec3> from{glm::normalize(glm::dvec3(1, 1, 2)), glm::normalize(glm::dvec3(-1, 0, 1))};
    Scene scene = tilted(normal, {1, 1, 1});
    scene.lights.push_back(light(LightKind::directional, from[0], {1, 0, 0}, 0.7F));
    scene.lights.push_back(light(LightKind::directional, from[1], {0, 1, 0}, 0.4F));
    const glm::dvec3 expected(0.7 * glm::dot(normal, from[0]), 0.4 * glm::dot(normal, from[1]), 0.0);
    for (const Shown& at : shown(scene)) expectColour(at.radiance, expected, 2e-6);
}

// Without lights one shines from the eye, the same at any distance.
TEST_F(Shading, WithoutLightsThereIsAHeadLight) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.5, 0.2, 1));
    const glm::dvec3 eye(6, 3, 6);
    Scene scene = tilted(normal, {0.8F, 0.8F, 0.8F});
    scene.cameras.front() = reference::cameraAt(eye, {0, 0, 0}, 30);
    for (const Shown& at : shown(scene)) {
        expectColour(at.radiance, glm::dvec3(0.8 * glm::dot(normal, glm::normalize(eye - at.point))), 1e-5);
    }
}

TEST_F(Shading, PlasticHasAWhiteHighlightAndMatteHasNone) {
    Scene scene;
    addObject(scene, closedMesh(1.5), {0.5F, 0.1F, 0.1F});
    scene.cameras.push_back(reference::cameraAt({0, 0, 10}, {0, 0, 0}, 25));
    const glm::dvec3 from = glm::normalize(glm::dvec3(1, 1, 2));
    scene.lights.push_back(light(LightKind::directional, from, {1, 1, 1}, 1.0F));
    for (const Shown& at : shown(scene)) {
        expectColour(at.radiance, glm::dvec3(0.5, 0.1, 0.1) * std::max(0.0, glm::dot(at.normal, from)), 1e-5);
    }
    scene.objects.front().material = {MaterialKind::plastic, 0.5F, 0.2F};
    double brightest = 0.0;
    for (const Shown& at : shown(scene)) {
        const double lambert = std::max(0.0, glm::dot(at.normal, from));
        const glm::dvec3 highlight = at.radiance - glm::dvec3(0.5, 0.1, 0.1) * lambert;
        // White, never negative, none where the light does not reach, and brightest along the half-way vector.
        expectColour(highlight, glm::dvec3(highlight.x), 1e-5);
        ASSERT_GE(highlight.x, -1e-5);
        ASSERT_LE(highlight.x, 0.5 * lambert + 1e-5);
        brightest = std::max(brightest, highlight.x);
        const glm::dvec3 halfWay = glm::normalize(from + glm::normalize(glm::dvec3(0, 0, 10) - at.point));
        if (glm::dot(at.normal, halfWay) < 0.7) {
            ASSERT_LE(highlight.x, 0.05);
        }
    }
    EXPECT_GE(brightest, 0.3);
}

TEST_F(Shading, NormalsTurnWithTheObjectAndFaceTheViewer) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.2, 1));
    for (const glm::quat turn : {glm::quat(1, 0, 0, 0), glm::quat(2.0F, 0.3F, -0.5F, 0.7F), glm::quat(0.1F, 0.8F, 0.4F, -0.3F)}) {
        Scene scene = tilted(normal, {1, 1, 1});
        Transform& transform = scene.objects.front().transform;
        transform.rotation = turn;
        transform.translation = {0.3F, -0.2F, 0.5F};
        glm::dvec3 expected = rotationMatrix(transform) * normal;
        for (const glm::dvec3 eye : {glm::dvec3(1, 2, 10), glm::dvec3(-8, 3, -5)}) {
            scene.cameras.front() = reference::cameraAt(eye, {0, 0, 0}, 40);
            // Two-sided: either side of the square shows the normal that points to the eye.
            const double sign = glm::dot(expected, eye - glm::dvec3(transform.translation)) < 0 ? -1.0 : 1.0;
            if (std::abs(glm::dot(expected, glm::normalize(eye))) < 0.3) continue;
            for (const Shown& at : shown(scene)) expectColour(at.normal, sign * expected, 2e-6);
        }
    }
}

TEST_F(Shading, BothSidesOfASurfaceAreLitAlike) {
    Scene front = tilted({0.2, 0.1, 1}, {1, 1, 1});
    front.lights.push_back(light(LightKind::directional, {0, 0, 1}, {1, 1, 1}, 1.0F));
    Scene back = front;
    // The same square with u reversed: du x dv points away.
    std::vector<glm::vec3>& points = back.meshes.front().points;
    for (std::size_t row = 0; row < 4; ++row)
        std::reverse(points.begin() + static_cast<long>(4 * row), points.begin() + static_cast<long>(4 * row + 4));
    const double cosine = glm::dot(glm::normalize(glm::dvec3(0.2, 0.1, 1)), glm::dvec3(0, 0, 1));
    for (const Shown& at : shown(front)) expectColour(at.radiance, glm::dvec3(cosine), 2e-6);
    for (const Shown& at : shown(back)) expectColour(at.radiance, glm::dvec3(cosine), 2e-6);
    EXPECT_EQ(picture(front, true).coveredPixels(), picture(front, false).coveredPixels());
    EXPECT_EQ(picture(back, true).coveredPixels(), 0U);
}

// Of a closed surface whose normals point outward the near side hides the far one: from outside culling changes nothing but what
// shows through cracks, from inside nothing is left. With the normals inward the far side appears in the near one's place.
TEST_F(Shading, CullingBackfacesTakesTheFarSideOnly) {
    Scene scene;
    addObject(scene, closedMesh(1.5), {1, 1, 1});
    scene.cameras.push_back(reference::cameraAt({0.5, 0.7, 8}, {0, 0, 0}, 25));
    const Kept all = picture(scene, false);
    EXPECT_LE(difference(all, picture(scene, true)).pixels, 2U);

    Scene inside = scene;
    inside.cameras.front() = reference::cameraAt({0.1, 0.2, 0}, {0.3, 0, 1}, 60);
    EXPECT_EQ(picture(inside, true).coveredPixels(), 0U);

    std::vector<glm::vec3>& points = scene.meshes.front().points;
    for (std::size_t row = 0; row < points.size(); row += 4) std::reverse(&points[row], &points[row] + 4);
    const Kept farSide = picture(scene, true);
    EXPECT_EQ(farSide.coveredPixels(), all.coveredPixels());
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            if (!all.covered(x, y)) continue;
            EXPECT_GE(farSide.z(x, y), all.z(x, y) - 1e-3F);
        }
    }
    // Its corners are 1.5 from the middle; the cubics are flatter than a sphere between them.
    EXPECT_GT(farSide.z(side / 2, side / 2) - all.z(side / 2, side / 2), 2.0F);
}

}  // namespace
}  // namespace tessera::test
