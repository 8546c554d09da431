// The mesh benchmark's scenes: valid, as large as the paper's, and closed where they should be.
#include "mesh/mesh_scenes.h"
#include "mesh/closed_meshes.h"
#include "tessera/error.h"
#include "tessera/scene.h"
#include "tessera/weld.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace tessera::bench {
namespace {

// Six times the volume that the corners of a PN mesh's triangles enclose; above 0 where they are seen from outside.
double enclosed(const Mesh& mesh) {
    double sum = 0;
    constexpr std::size_t points = pointsPerPatch(PatchKind::pn);
    for (std::size_t i = 0; i < mesh.points.size(); i += points) {
        const glm::dvec3 a(mesh.points[i]);
        const glm::dvec3 b(mesh.points[i + 3]);
        const glm::dvec3 c(mesh.points[i + 9]);
        sum += glm::dot(a, glm::cross(b, c));
    }
    return sum;
}

// Euler number of a closed triangle mesh, of its base triangles' corners.
long eulerNumber(const Mesh& mesh) {
    std::set<std::vector<float>> corners;
    constexpr std::size_t points = pointsPerPatch(PatchKind::pn);
    for (std::size_t i = 0; i < mesh.points.size(); i += points) {
        for (const std::size_t corner : std::array<std::size_t, 3>{0, 3, 9}) {
            const glm::vec3& at = mesh.points[i + corner];
            corners.insert({at.x, at.y, at.z});
        }
    }
    const auto triangles = static_cast<long>(mesh.patchCount());
    return static_cast<long>(corners.size()) - 3 * triangles / 2 + triangles;
}

void expectClosed(const Mesh& mesh) {
    Scene alone;
    alone.meshes = {mesh};
    Object object;
    object.name = object.mesh = mesh.name;
    alone.objects = {object};
    const WeldReport report = weld(alone, 0.0);
    EXPECT_EQ(report.boundaryEdges, 0U) << mesh.name;
    EXPECT_EQ(report.overusedEdges, 0U) << mesh.name;
    EXPECT_EQ(report.degenerateEdges, 0U) << mesh.name;
    EXPECT_GT(enclosed(mesh), 0.0) << mesh.name;
}

TEST(MeshScenes, AreValidLitAndHaveTheCountsAndCamerasSaid) {
    const std::vector<MeshTrial> trials = meshTrials("");
    EXPECT_EQ(trials.size(), 7U);
    std::set<std::string> names;
    for (const MeshTrial& trial : trials) {
        const Scene scene = trial.make();
        EXPECT_NO_THROW(scene.validate()) << trial.name;
        EXPECT_EQ(scene.placedPatchCount(), trial.patches) << trial.name;
        EXPECT_NE(scene.findCamera(trial.camera), nullptr) << trial.name;
        EXPECT_FALSE(scene.lights.empty()) << trial.name;
        EXPECT_TRUE(names.insert(trial.name).second) << trial.name;
    }
}

TEST(MeshScenes, TrianglesAreThoseOfThePaperAndClosed) {
    for (const Scene& scene : {doubleTorus(), starField(), zoo()}) {
        for (const Mesh& mesh : scene.meshes) expectClosed(mesh);
    }
    EXPECT_EQ(eulerNumber(doubleTorus().meshes.front()), -2);
    EXPECT_EQ(eulerNumber(starField().meshes.front()), 2);
    const Scene animals = zoo();
    EXPECT_EQ(animals.meshes.size(), 11U);
    for (const Mesh& mesh : animals.meshes) EXPECT_EQ(eulerNumber(mesh), mesh.name == "knot" ? 0 : 2) << mesh.name;
}

TEST(MeshScenes, SpheresAreClosed) {
    for (const Mesh& mesh : sphereCloud().meshes) {
        Scene alone;
        alone.meshes = {mesh};
        EXPECT_EQ(weld(alone, 0.0).boundaryEdges, 0U) << mesh.name;
    }
}

TEST(MeshScenes, TeaTableStandsOnItsOwnPatches) {
    const Scene scene = teaTable();
    std::set<PatchKind> kinds;
    for (const Mesh& mesh : scene.meshes) kinds.insert(mesh.kind);
    EXPECT_EQ(kinds, (std::set<PatchKind>{PatchKind::bezier, PatchKind::rational}));
    std::set<std::string> objects;
    for (const Object& object : scene.objects) EXPECT_TRUE(objects.insert(object.name).second) << object.name;
}

TEST(MeshScenes, HerdIsEightOfOneWithoutTouching) {
    const Scene single = builtinScene("teapot");
    const Scene eight = herd(single);
    EXPECT_NO_THROW(eight.validate());
    EXPECT_EQ(eight.placedPatchCount(), 8 * single.placedPatchCount());
    EXPECT_EQ(eight.meshes.size(), single.meshes.size());
    const Bounds one = worldBounds(single);
    const Bounds all = worldBounds(eight);
    EXPECT_GT(all.upper.x - all.lower.x, 4.0F * (one.upper.x - one.lower.x));
    EXPECT_GT(all.upper.z - all.lower.z, 2.0F * (one.upper.z - one.lower.z));
    EXPECT_THROW(static_cast<void>(herd(Scene{})), Error);
}

}  // namespace
}  // namespace tessera::bench
