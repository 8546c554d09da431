// Scenes: look-ups, transforms, bounds, the checks of Scene::validate, made cameras and the built-in scenes.
#include "tessera/scene.h"
#include "scene/text.h"
#include "scene/validate.h"
#include "tessera/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace tessera {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Two patches spread over the box (0,0,0) to (1,2,3), one object, one light, one camera.
Scene smallScene() {
    Scene scene;
    scene.name = "small";
    Mesh mesh;
    mesh.name = "m";
    for (int i = 0; i < 32; ++i) {
        const float t = static_cast<float>(i) / 31.0F;
        mesh.points.emplace_back(t, 2.0F * t, 3.0F * t);
    }
    scene.meshes.push_back(mesh);
    Object object;
    object.name = "o";
    object.mesh = "m";
    scene.objects.push_back(object);
    Light light;
    light.name = "l";
    scene.lights.push_back(light);
    Camera camera;
    camera.name = "c";
    scene.cameras.push_back(camera);
    return scene;
}

// What validate says about `scene`; empty where it is content.
std::string complaint(const Scene& scene) {
    try {
        scene.validate();
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

// A point as `camera` sees it: x and y over half the picture's height, z the distance along the view axis.
glm::dvec3 seenBy(const Camera& camera, const glm::dvec3& point) {
    const glm::dvec3 eye = glm::transpose(rotationMatrix(camera.transform)) * (point - glm::dvec3(camera.transform.translation));
    const double scale = 1.0 / (-eye.z * std::tan(glm::radians(static_cast<double>(camera.fovy)) * 0.5));
    return {eye.x * scale, eye.y * scale, -eye.z};
}

std::vector<glm::dvec3> placedPoints(const Scene& scene) {
    std::vector<glm::dvec3> points;
    for (const Object& object : scene.objects) {
        for (const glm::vec3& point : scene.findMesh(object.mesh)->points) {
            points.emplace_back(matrix(object.transform) * glm::dvec4(glm::dvec3(point), 1.0));
        }
    }
    return points;
}

TEST(Transform, RotatesThenTranslatesWhateverTheQuaternionsLength) {
    Transform transform;
    transform.translation = {10.0F, 0.0F, 0.0F};
    for (const float length : {1.0F, 3.0F, 1e-20F, 1e20F, std::numeric_limits<float>::denorm_min()}) {
        transform.rotation = glm::quat(length, 0.0F, 0.0F, length);  // a quarter turn about z
        const glm::dvec4 moved = matrix(transform) * glm::dvec4(1.0, 0.0, 0.0, 1.0);
        EXPECT_NEAR(moved.x, 10.0, 1e-12) << length;
        EXPECT_NEAR(moved.y, 1.0, 1e-12) << length;
        EXPECT_NEAR(moved.z, 0.0, 1e-12) << length;
    }
}

TEST(Scene, FindsByNameAndCountsPlacedPatches) {
    Scene scene = smallScene();
    EXPECT_EQ(scene.findMesh("m"), scene.meshes.data());
    EXPECT_EQ(scene.findMesh("x"), nullptr);
    EXPECT_EQ(scene.findCamera("c"), scene.cameras.data());
    EXPECT_EQ(scene.findCamera(""), nullptr);
    EXPECT_EQ(scene.placedPatchCount(), 2U);
    scene.objects.push_back(scene.objects.front());
    EXPECT_EQ(scene.placedPatchCount(), 4U);
    scene.objects.clear();
    EXPECT_EQ(scene.placedPatchCount(), 0U);
}

TEST(Bounds, HoldEveryObjectWhereItStands) {
    Scene scene = smallScene();
    Object second = scene.objects.front();
    second.transform.translation = {0.0F, 0.0F, 100.0F};
    second.transform.rotation = glm::quat(1.0F, 0.0F, 0.0F, 1.0F);  // x to y, y to -x
    scene.objects.push_back(second);
    const Bounds bounds = worldBounds(scene);
    EXPECT_FALSE(bounds.empty());
    const glm::vec3 lower(-2.0F, 0.0F, 0.0F);
    const glm::vec3 upper(1.0F, 2.0F, 103.0F);
    EXPECT_LT(glm::length(bounds.lower - lower), 1e-5F);
    EXPECT_LT(glm::length(bounds.upper - upper), 1e-5F);
    scene.objects.clear();
    EXPECT_TRUE(worldBounds(scene).empty());
}

struct Break {
    const char* name;
    std::function<void(Scene&)> apply;
    std::vector<std::string> said;  // parts of the message
};

TEST(Validate, NamesWhatIsWrongAndWhere) {
    ASSERT_EQ(complaint(smallScene()), "");
    const std::vector<Break> breaks{
        {"nan", [](Scene& s) { s.meshes[0].points[19].y = kNan; }, {"mesh 'm'", "patch 1", "point 3", "nan"}},
        {"infinity", [](Scene& s) { s.meshes[0].points[0].z = -kInfinity; }, {"mesh 'm'", "patch 0", "point 0", "-inf"}},
        {"too far", [](Scene& s) { s.meshes[0].points[31].x = 1.1e9F; }, {"mesh 'm'", "patch 1", "point 15", "1e9"}},
        {"point count", [](Scene& s) { s.meshes[0].points.pop_back(); }, {"mesh 'm'", "31 points", "16", "bezier"}},
        {"other kind", [](Scene& s) { s.meshes[0].kind = PatchKind::gregory; }, {"mesh 'm'", "32 points", "20", "gregory"}},
        {"no kind", [](Scene& s) { s.meshes[0].kind = static_cast<PatchKind>(7); }, {"mesh 'm'", "kind"}},
        {"twin mesh", [](Scene& s) { s.meshes.push_back(s.meshes[0]); }, {"mesh 'm'", "twice"}},
        {"no mesh", [](Scene& s) { s.objects[0].mesh = "q"; }, {"object 'o'", "'q'"}},
        {"object rotation", [](Scene& s) { s.objects[0].transform.rotation = glm::quat(0, 0, 0, 0); }, {"object 'o'", "zero length"}},
        {"object place", [](Scene& s) { s.objects[0].transform.translation.x = 2e9F; }, {"object 'o'", "translation", "2e+09"}},
        {"object colour", [](Scene& s) { s.objects[0].color.g = kNan; }, {"object 'o'", "colour", "nan"}},
        {"material", [](Scene& s) { s.objects[0].material.kind = static_cast<MaterialKind>(9); }, {"object 'o'", "material"}},
        {"specular", [](Scene& s) { s.objects[0].material.specular = 1.5F; }, {"object 'o'", "specular 1.5"}},
        {"roughness", [](Scene& s) { s.objects[0].material.roughness = 0.0F; }, {"object 'o'", "roughness 0 "}},
        {"light rotation", [](Scene& s) { s.lights[0].transform.rotation.x = kNan; }, {"light 'l'", "rotation"}},
        {"light colour", [](Scene& s) { s.lights[0].color.r = kInfinity; }, {"light 'l'", "colour"}},
        {"intensity", [](Scene& s) { s.lights[0].intensity = kNan; }, {"light 'l'", "intensity"}},
        {"light kind", [](Scene& s) { s.lights[0].kind = static_cast<LightKind>(3); }, {"light 'l'", "kind"}},
        {"near", [](Scene& s) { s.cameras[0].near = 0.0F; }, {"camera 'c'", "near", "0"}},
        {"near nan", [](Scene& s) { s.cameras[0].near = kNan; }, {"camera 'c'", "near", "nan"}},
        {"far", [](Scene& s) { s.cameras[0].far = kInfinity; }, {"camera 'c'", "far"}},
        {"fovy 0", [](Scene& s) { s.cameras[0].fovy = 0.0F; }, {"camera 'c'", "field of view"}},
        {"fovy 180", [](Scene& s) { s.cameras[0].fovy = 180.0F; }, {"camera 'c'", "field of view of 180"}},
        {"camera place", [](Scene& s) { s.cameras[0].transform.translation.z = kNan; }, {"camera 'c'", "translation"}},
    };
    for (const Break& one : breaks) {
        Scene scene = smallScene();
        one.apply(scene);
        const std::string message = complaint(scene);
        EXPECT_EQ(message.rfind("small: ", 0), 0U) << one.name << ": " << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << one.name;
        for (const std::string& part : one.said) EXPECT_NE(message.find(part), std::string::npos) << one.name << ": " << message;
    }
}

TEST(Validate, AcceptsTheLimitsThemselves) {
    Scene scene = smallScene();
    scene.meshes[0].points[0] = {1e9F, -1e9F, 0.0F};
    scene.cameras[0].near = std::numeric_limits<float>::denorm_min();
    scene.cameras[0].fovy = 179.9F;
    scene.objects[0].material = {MaterialKind::plastic, 0.0F, 1.0F};
    EXPECT_EQ(complaint(scene), "");
}

TEST(Text, QuotesNamesOnOneLineOfBoundedLength) {
    EXPECT_EQ(quotedName("plain"), "'plain'");
    EXPECT_EQ(quotedName("a\nb\x7F"), "'a\\x0ab\\x7f'");
    EXPECT_EQ(quotedName("\xC3\xA9"), "'\xC3\xA9'");
    EXPECT_LT(quotedName(std::string(100000, 'x')).size(), 100U);
}

TEST(Text, TellsUtf8FromOtherBytes) {
    for (const std::string good :
         {"", "a", "\xC2\x80", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEE\x80\x80", "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"}) {
        EXPECT_TRUE(isUtf8(good)) << testing::PrintToString(good);
    }
    for (const std::string bad : {"\x80", "\xC0\x80", "\xC1\xBF", "\xC3", "\xC3(", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xE2\x82",
                                  "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xFF", "a\xE2\x28\xA1"}) {
        EXPECT_FALSE(isUtf8(bad)) << testing::PrintToString(bad);
    }
}

TEST(LookAt, PutsTheTargetInTheMiddleWithYUp) {
    const Camera camera = lookAt({3.0F, 4.0F, 5.0F}, {1.0F, 1.0F, -1.0F}, 50.0F);
    EXPECT_EQ(camera.fovy, 50.0F);
    const glm::dvec3 target = seenBy(camera, {1.0, 1.0, -1.0});
    EXPECT_NEAR(target.x, 0.0, 1e-6);
    EXPECT_NEAR(target.y, 0.0, 1e-6);
    EXPECT_NEAR(target.z, 7.0, 1e-5);
    const glm::dvec3 above = seenBy(camera, {1.0, 1.5, -1.0});
    EXPECT_NEAR(above.x, 0.0, 1e-6);
    EXPECT_GT(above.y, 0.01);
    EXPECT_GT(seenBy(camera, {2.0, 1.0, -1.3}).x, 0.01);  // not mirrored
}

TEST(LookAt, TakesZForUpWhereTheViewIsVertical) {
    for (const float height : {5.0F, -5.0F}) {
        const Camera camera = lookAt({0.0F, height, 0.0F}, {0.0F, 0.0F, 0.0F}, 50.0F);
        EXPECT_NEAR(seenBy(camera, {0.0, 0.0, 0.0}).z, 5.0, 1e-5);
        EXPECT_GT(seenBy(camera, {0.0, 0.0, 1.0}).y, 0.1);
    }
}

TEST(LookAt, RefusesWhatGivesNoView) {
    EXPECT_THROW(static_cast<void>(lookAt({1, 2, 3}, {1, 2, 3}, 50.0F)), Error);
    EXPECT_THROW(static_cast<void>(lookAt({1, 2, kNan}, {1, 2, 3}, 50.0F)), Error);
    EXPECT_THROW(static_cast<void>(lookAt({1, 2, 4}, {1, 2, 3}, 0.0F)), Error);
    EXPECT_THROW(static_cast<void>(lookAt({1, 2, 4}, {1, 2, 3}, 180.0F)), Error);
}

struct Placement {
    const char* name;
    glm::vec3 scale;
    glm::vec3 offset;
};

TEST(FramingCamera, SeesAllOfAnySceneEvenInASquarePicture) {
    const std::vector<Placement> placements{
        {"as it is", {1, 1, 1}, {0, 0, 0}},
        {"tiny", {1e-12F, 1e-12F, 1e-12F}, {0, 0, 0}},
        {"huge", {3e8F, 3e8F, 3e8F}, {0, 0, 0}},
        {"flat", {1, 0, 1}, {5, 5, 5}},
        {"flat, upright", {1, 1, 0}, {0, 0, 0}},
        {"line", {0, 1, 0}, {0, 0, 0}},
        {"a point", {0, 0, 0}, {0, 0, 0}},
        {"a point elsewhere", {0, 0, 0}, {3, -7, 1000}},
        {"tiny and far away", {1e-3F, 1e-3F, 1e-3F}, {9e8F, 9e8F, -9e8F}},
        {"long", {1e6F, 1e-3F, 1e-3F}, {0, 0, 0}},
    };
    for (const Placement& placement : placements) {
        for (const float fovy : {0.5F, 45.0F, 120.0F, 179.0F}) {
            Scene scene = smallScene();
            for (glm::vec3& point : scene.meshes[0].points) point = point * placement.scale + placement.offset;
            const Camera camera = framingCamera(scene, fovy);
            EXPECT_NO_THROW(validateCamera(camera, "framing")) << placement.name;
            for (const glm::dvec3& point : placedPoints(scene)) {
                const glm::dvec3 seen = seenBy(camera, point);
                EXPECT_GT(seen.z, camera.near) << placement.name << " " << fovy;
                EXPECT_LT(seen.z, camera.far) << placement.name << " " << fovy;
                EXPECT_LE(std::max(std::abs(seen.x), std::abs(seen.y)), 1.0) << placement.name << " " << fovy;
            }
        }
    }
}

TEST(FramingCamera, FillsThePictureAndLooksFromAbove) {
    const Scene scene = builtinScene("teapot");
    const Camera camera = framingCamera(scene, 40.0F);
    double widest = 0.0;
    for (const glm::dvec3& point : placedPoints(scene)) widest = std::max(widest, std::abs(seenBy(camera, point).x));
    EXPECT_GT(widest, 0.6);
    EXPECT_GT(camera.transform.translation.y, worldBounds(scene).upper.y);
}

TEST(FramingCamera, IsValidForAnEmptyScene) {
    const Camera camera = framingCamera(Scene{}, 45.0F);
    EXPECT_NO_THROW(validateCamera(camera, "framing"));
    EXPECT_LT(glm::length(glm::dvec2(seenBy(camera, glm::dvec3(0.0)))), 1e-6);
    EXPECT_NO_THROW(validateCamera(framingCamera(Scene{}, std::numeric_limits<float>::denorm_min()), "framing"));
    EXPECT_THROW(static_cast<void>(framingCamera(Scene{}, 0.0F)), Error);
}

TEST(BuiltinScene, TeapotIsWholeValidAndInThePicture) {
    EXPECT_TRUE(isBuiltinScene("teapot"));
    const Scene scene = builtinScene("teapot");
    EXPECT_EQ(complaint(scene), "");
    EXPECT_EQ(scene.placedPatchCount(), 32U);
    const Camera* camera = scene.findCamera("camera");
    ASSERT_NE(camera, nullptr);
    const Bounds bounds = worldBounds(scene);
    EXPECT_NEAR(bounds.lower.y, 0.0, 1e-5);  // stands on the ground, y up
    EXPECT_NEAR(bounds.upper.y, 3.15, 1e-5);
    for (const glm::dvec3& point : placedPoints(scene)) {
        const glm::dvec3 seen = seenBy(*camera, point);
        EXPECT_LT(std::abs(seen.x), 0.98 * 1280.0 / 720.0);
        EXPECT_LT(std::abs(seen.y), 0.98);
        EXPECT_GT(seen.z, camera->near);
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
