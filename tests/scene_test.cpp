// Scenes: look-ups, transforms, bounds, the checks of Scene::validate and made cameras.
#include "tessera/scene.h"
#include "scene/text.h"
#include "scene/validate.h"
#include "seen.h"
#include "tessera/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace tessera {
namespace {

using test::placedPoints;
using test::seenBy;

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

// The same with a rational mesh of two patches, a pn triangle, and edge records on the former.
Scene mixedScene() {
    Scene scene = smallScene();
    scene.meshes[0].kind = PatchKind::rational;
    scene.meshes[0].weights.assign(32, 1.0F);
    EdgeRecord edge;
    edge.side = 2;
    scene.meshes[0].edges.push_back(edge);
    edge.patch = 1;
    edge.side = 0;
    edge.level = 2;
    edge.index = 3;
    edge.cuts = 8;
    scene.meshes[0].edges.push_back(edge);
    Mesh triangle;
    triangle.name = "t";
    triangle.kind = PatchKind::pn;
    triangle.points.assign(16, glm::vec3(1.0F));
    edge = EdgeRecord{};
    edge.side = 3;
    triangle.edges.push_back(edge);
    scene.meshes.push_back(triangle);
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

void expectComplaints(const Scene& sound, const std::vector<Break>& breaks) {
    ASSERT_EQ(complaint(sound), "");
    for (const Break& one : breaks) {
        Scene scene = sound;
        one.apply(scene);
        const std::string message = complaint(scene);
        EXPECT_EQ(message.rfind("small: ", 0), 0U) << one.name << ": " << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << one.name;
        for (const std::string& part : one.said) EXPECT_NE(message.find(part), std::string::npos) << one.name << ": " << message;
    }
}

TEST(Validate, NamesWhatIsWrongAndWhere) {
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
    expectComplaints(smallScene(), breaks);
}

TEST(Validate, NamesWeightsThatAreWrong) {
    const std::vector<Break> breaks{
        {"zero", [](Scene& s) { s.meshes[0].weights[19] = 0.0F; }, {"mesh 'm'", "patch 1", "point 3", "weight 0 "}},
        {"below zero", [](Scene& s) { s.meshes[0].weights[0] = -1.0F; }, {"mesh 'm'", "patch 0", "point 0", "weight -1"}},
        {"nan", [](Scene& s) { s.meshes[0].weights[31] = kNan; }, {"mesh 'm'", "patch 1", "point 15", "weight nan"}},
        {"infinite", [](Scene& s) { s.meshes[0].weights[1] = kInfinity; }, {"mesh 'm'", "patch 0", "point 1", "weight inf"}},
        {"small", [](Scene& s) { s.meshes[0].weights[1] = 9e-7F; }, {"mesh 'm'", "patch 0", "point 1", "1e-6"}},
        {"great", [](Scene& s) { s.meshes[0].weights[1] = 1.1e6F; }, {"mesh 'm'", "patch 0", "point 1", "1e6"}},
        {"missing", [](Scene& s) { s.meshes[0].weights.pop_back(); }, {"mesh 'm'", "31 weights", "32 points"}},
        {"out of place", [](Scene& s) { s.meshes[0].kind = PatchKind::bezier; }, {"mesh 'm'", "weights", "bezier"}},
        {"of a pn", [](Scene& s) { s.meshes[1].weights.assign(16, 1.0F); }, {"mesh 't'", "weights", "pn"}},
    };
    expectComplaints(mixedScene(), breaks);
}

TEST(Validate, TellsNormalsOfTrianglesFromPoints) {
    const std::vector<Break> breaks{
        {"point", [](Scene& s) { s.meshes[1].points[9].x = 2e9F; }, {"mesh 't'", "patch 0", "point 9", "1e9"}},
        {"normal", [](Scene& s) { s.meshes[1].points[10].x = kNan; }, {"mesh 't'", "patch 0", "point 10", "normal"}},
    };
    expectComplaints(mixedScene(), breaks);
    Scene scene = mixedScene();
    scene.meshes[1].points[15].x = 1e30F;
    EXPECT_EQ(complaint(scene), "");
}

TEST(Validate, NamesEdgeRecordsThatBreakTheirRules) {
    const std::vector<Break> breaks{
        {"patch", [](Scene& s) { s.meshes[0].edges[1].patch = 2; }, {"mesh 'm'", "edge record of patch 2, side 0", "2 patches"}},
        {"side", [](Scene& s) { s.meshes[0].edges[1].side = 4; }, {"mesh 'm'", "patch 1, side 4", "rational"}},
        {"pn side", [](Scene& s) { s.meshes[1].edges[0].side = 2; }, {"mesh 't'", "patch 0, side 2", "pn"}},
        {"point", [](Scene& s) { s.meshes[0].edges[0].points[3].z = kNan; }, {"mesh 'm'", "patch 0, side 2", "nan"}},
        {"weight", [](Scene& s) { s.meshes[0].edges[0].weights[2] = 0.0F; }, {"mesh 'm'", "patch 0, side 2", "weight 0 "}},
        {"cuts", [](Scene& s) { s.meshes[0].edges[1].cuts = 9; }, {"mesh 'm'", "patch 1, side 0", "cut 9 times"}},
        {"level", [](Scene& s) { s.meshes[0].edges[1].cuts = 1; }, {"mesh 'm'", "patch 1, side 0", "level 2"}},
        {"index", [](Scene& s) { s.meshes[0].edges[1].index = 4; }, {"mesh 'm'", "patch 1, side 0", "part 4 of 4"}},
        {"order", [](Scene& s) { std::swap(s.meshes[0].edges[0], s.meshes[0].edges[1]); }, {"mesh 'm'", "patch 0, side 2", "order"}},
        {"twin", [](Scene& s) { s.meshes[0].edges.push_back(s.meshes[0].edges[1]); }, {"mesh 'm'", "patch 1, side 0", "two"}},
    };
    expectComplaints(mixedScene(), breaks);
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

}  // namespace
}  // namespace tessera
