// Which patches are turned so that neighbours agree, and what turning does to triangles and normals.
#include "mesh/orientation.h"
#include "mesh_kept.h"
#include "sample_meshes.h"
#include "tessera/surfaces.h"
#include "tessera/weld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace tessera::test {
namespace {

// u and v change places: the same surface the other way round.
void flip(Mesh& mesh, std::size_t patch) {
    for (std::size_t v = 0; v < 4; ++v) {
        for (std::size_t u = 0; u < v; ++u) {
            std::swap(mesh.points[16 * patch + 4 * v + u], mesh.points[16 * patch + 4 * u + v]);
            if (!mesh.weights.empty()) std::swap(mesh.weights[16 * patch + 4 * v + u], mesh.weights[16 * patch + 4 * u + v]);
        }
    }
}

Scene ball(const std::set<std::size_t>& flipped) {
    Mesh mesh = sphere("ball", 1.0, -1.0, 1.0);
    for (const std::size_t patch : flipped) flip(mesh, patch);
    return reference::sceneOf({mesh});
}

std::set<std::size_t> turnedOf(const Scene& scene) {
    const std::vector<std::uint32_t> bits = turnedPatches(scene);
    std::set<std::size_t> turned;
    const std::size_t patches = scene.placedPatchCount();
    for (std::size_t k = 0; k < patches; ++k)
        if ((bits.at(k / 32) >> (k % 32) & 1U) != 0) turned.insert(k);
    return turned;
}

glm::dvec3 vectorOf(const float* at) { return {at[0], at[1], at[2]}; }

// The least of normal x position over the vertices of a ball, and of triangles' own normals x position.
std::pair<double, double> leastOutward(const KeptMesh& mesh) {
    double ofNormals = 1e9, ofTriangles = 1e9;
    for (const MeshVertex& v : mesh.vertices) ofNormals = std::min(ofNormals, glm::dot(vectorOf(v.normal), vectorOf(v.position)));
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const auto corner = [&](std::size_t c) { return vectorOf(mesh.vertices[mesh.indices[t + c]].position); };
        const glm::dvec3 across = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
        ofTriangles = std::min(ofTriangles, glm::dot(across, corner(0) + corner(1) + corner(2)));
    }
    return {ofNormals, ofTriangles};
}

TEST(Orientation, LeavesPatchesThatAgree) {
    EXPECT_TRUE(turnedOf(ball({})).empty());
    EXPECT_TRUE(turnedOf(reference::sceneOf({torus("ring", 1.0, 0.3)})).empty());
    EXPECT_TRUE(turnedOf(ball({0, 1, 2, 3, 4, 5, 6, 7})).empty()) << "all run the other way: so be it";
    EXPECT_TRUE(turnedPatches(Scene()).empty());
}

TEST(Orientation, TurnsTheFewerOfAPiece) {
    EXPECT_EQ(turnedOf(ball({2, 5})), (std::set<std::size_t>{2, 5}));
    EXPECT_EQ(turnedOf(ball({1, 2, 3, 5, 6, 7})), (std::set<std::size_t>{0, 4}));
    EXPECT_EQ(turnedOf(ball({0, 3, 4, 6})), (std::set<std::size_t>{1, 2, 5, 7})) << "of equally many those without the first";
}

TEST(Orientation, LooksAtEachPieceByItself) {
    Scene scene = ball({2});
    scene.objects.push_back({"other", {{5.0F, 0.0F, 0.0F}}, scene.meshes[0].name, glm::vec3(1.0F), {}});
    EXPECT_EQ(turnedOf(scene), (std::set<std::size_t>{2, 10}));
}

TEST(Orientation, DoesNotMindAOneSidedSurface) {
    // A strip of three patches whose ends meet half turned.
    const std::array<glm::vec3, 4> low{glm::vec3(1, 0, 0), glm::vec3(-0.5, 0.866, 0), glm::vec3(-0.5, -0.866, 0), glm::vec3(1, 0, 1)};
    const std::array<glm::vec3, 4> high{glm::vec3(1, 0, 1), glm::vec3(-0.5, 0.866, 1), glm::vec3(-0.5, -0.866, 1), glm::vec3(1, 0, 0)};
    std::vector<std::array<glm::vec3, 4>> quads;
    for (std::size_t k = 0; k < 3; ++k) quads.push_back({low[k], low[k + 1], high[k + 1], high[k]});
    EXPECT_LE(turnedOf(reference::sceneOf({bilinearMesh("strip", quads)})).size(), 1U);
}

// Where each looked at all the others it would be 3 * 10^11 steps, beyond the suite's limit on time.
TEST(Orientation, ManyCopiesInOnePlaceDecideNothingAndSoon) {
    Scene scene = ball({2});
    scene.objects.resize(80000, scene.objects[0]);
    EXPECT_EQ(turnedPatches(scene), std::vector<std::uint32_t>(8 * 80000 / 32));
}

TEST(Orientation, TurnsTrianglesAndNormalsOutward) {
    Tessellator tessellator(meshTestSettings());
    for (const std::set<std::size_t>& flipped : {std::set<std::size_t>{}, {2}, {1, 4, 7}}) {
        tessellator.setScene(ball(flipped));
        for (const double tolerance : {0.3, 0.05, 0.001}) {
            TessellateOptions options;
            options.tolerance = tolerance;
            const auto [normals, triangles] = leastOutward(keep(tessellator.tessellate(options)));
            EXPECT_GT(normals, 0.99) << tolerance;
            EXPECT_GT(triangles, 0.0) << tolerance;
        }
        tessellator.setScene(ball(flipped), Orientation::asGiven);
        TessellateOptions options;
        options.tolerance = 0.01;
        const auto [normals, triangles] = leastOutward(keep(tessellator.tessellate(options)));
        EXPECT_EQ(normals < 0, !flipped.empty());
        EXPECT_EQ(triangles < 0, !flipped.empty());
    }
}

}  // namespace
}  // namespace tessera::test
