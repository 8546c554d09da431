// PN triangles: control points by their properties, and the bits of edges that triangles share. Repairs: triangle_repair_test.cpp.
#include "tessera/triangles.h"
#include "triangle_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace tessera {
namespace {

constexpr double kFloat = 1e-6;  // some roundings of coordinates of size 1

double distance(const glm::vec3& a, const glm::dvec3& b) { return glm::length(glm::dvec3(a) - b); }

// A right triangle in the plane z = 0 with these normals at its corners.
TriangleMesh oneTriangle(const std::array<glm::vec3, 3>& normals) {
    TriangleMesh mesh;
    mesh.name = "one";
    mesh.positions = {{0.0F, 0.0F, 0.0F}, {3.0F, 0.0F, 0.0F}, {0.0F, 3.0F, 0.0F}};
    mesh.triangles = {{0, 1, 2}};
    mesh.normals = {normals};
    return mesh;
}

TEST(Triangles, SharedEdgesHaveTheSameBitsWhateverTheNormals) {
    for (unsigned seed = 0; seed < 12; ++seed) {
        std::mt19937 random(seed);
        TriangleMesh mesh = ring(5 + seed, 3 + seed / 2, 0.2F, seed);
        if (seed % 3 != 0) addRandomNormals(mesh, random);
        for (const bool flat : {false, true}) {
            const Mesh patches = pnMesh(unwelded(mesh, random), flat);
            EXPECT_EQ(patches.patchCount(), mesh.triangles.size());
            EXPECT_TRUE(isClosed(patches)) << "seed " << seed << (flat ? ", flat" : "");
        }
    }
}

TEST(Triangles, MeshesApartShareEdgesOfTheSameNormals) {
    std::mt19937 random(5);
    TriangleMesh whole = ring(7, 5, 0.1F, 5);
    TriangleMesh others = whole;
    addRandomNormals(others, random);
    for (const auto& [x, y, z] : whole.triangles) {  // a normal a position
        whole.normals.push_back({others.normals[x][0], others.normals[y][0], others.normals[z][0]});
    }
    TriangleMesh left = whole, right = whole;
    for (std::size_t t = whole.triangles.size(); t-- > 0;) {
        TriangleMesh& other = t % 3 == 0 ? left : right;
        other.triangles.erase(other.triangles.begin() + static_cast<std::ptrdiff_t>(t));
        other.normals.erase(other.normals.begin() + static_cast<std::ptrdiff_t>(t));
    }
    std::map<CurveBits, int> both = countCurves(pnMesh(left, false));
    for (const auto& [curve, count] : countCurves(pnMesh(right, false))) both[curve] += count;
    for (const auto& [curve, count] : both) EXPECT_EQ(count, 2);
}

TEST(Triangles, PatchesLieAsTheSceneSaysAndFaceOutward) {
    const glm::vec3 up(0.0F, 0.0F, 1.0F);
    const Mesh mesh = pnMesh(oneTriangle({up, up, up}), false);
    ASSERT_EQ(mesh.kind, PatchKind::pn);
    ASSERT_EQ(mesh.points.size(), 16U);
    // All normals square to the triangle: a plane, with points a unit apart.
    const std::array<glm::vec3, 10> expected{glm::vec3{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 1, 0},
                                             {1, 1, 0},          {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {0, 3, 0}};
    for (std::size_t k = 0; k < 10; ++k) EXPECT_LT(distance(mesh.points[k], glm::dvec3(expected[k])), kFloat) << k;
    for (std::size_t k = 10; k < 16; ++k) EXPECT_LT(distance(mesh.points[k], glm::dvec3(up)), kFloat) << k;
}

TEST(Triangles, CurvesLeaveTheirEndsSquareToTheNormals) {
    std::mt19937 random(3);
    TriangleMesh mesh = oneTriangle({});
    mesh.normals.clear();
    addRandomNormals(mesh, random);
    const Mesh patch = pnMesh(mesh, false);
    const std::array<std::array<std::size_t, 3>, 6> ends{{{0, 1, 0}, {0, 4, 0}, {3, 2, 1}, {3, 6, 1}, {9, 7, 2}, {9, 8, 2}}};
    for (const auto& [corner, inner, which] : ends) {
        const glm::dvec3 leaving = glm::dvec3(patch.points[inner]) - glm::dvec3(patch.points[corner]);
        const glm::dvec3 normal(mesh.normals[0][which]);
        EXPECT_NEAR(glm::dot(leaving, normal), 0.0, kFloat) << corner << " to " << inner;
    }
    // And the inner point is the third of the side, moved along the normal alone.
    const glm::dvec3 moved = glm::dvec3(patch.points[1]) - glm::dvec3(1.0, 0.0, 0.0);
    EXPECT_LT(glm::length(glm::cross(moved, glm::dvec3(mesh.normals[0][0]))), kFloat);
}

TEST(Triangles, CentreLiesHalfAsFarAgainAsTheEdgesPoints) {
    std::mt19937 random(4);
    TriangleMesh mesh = oneTriangle({});
    mesh.normals.clear();
    addRandomNormals(mesh, random);
    const std::vector<glm::vec3> p = pnMesh(mesh, false).points;
    glm::dvec3 edges(0.0);
    for (const std::size_t k : {1U, 2U, 4U, 6U, 7U, 8U}) edges += glm::dvec3(p[k]) / 6.0;
    const glm::dvec3 corners = (glm::dvec3(p[0]) + glm::dvec3(p[3]) + glm::dvec3(p[9])) / 3.0;
    EXPECT_LT(distance(p[5], edges * 1.5 - corners * 0.5), kFloat);
}

TEST(Triangles, EdgesWhoseNormalsDifferAreTheMeanOfBothSides) {
    // Two triangles over the side from (0,0,0) to (3,0,0), one with normals that lift it, one with normals that leave it.
    const glm::vec3 up(0.0F, 0.0F, 1.0F), leanLeft(-0.6F, 0.0F, 0.8F), leanRight(0.6F, 0.0F, 0.8F);
    TriangleMesh mesh = oneTriangle({leanLeft, leanRight, up});
    mesh.positions.emplace_back(0.0F, -3.0F, 0.0F);
    mesh.triangles.push_back({0, 3, 1});
    mesh.normals.push_back({up, up, up});
    const double lifted = 3.0 * 0.6 * 0.8 / 3.0;  // alone, the first would lift its points by so much
    const Mesh patches = pnMesh(mesh, false);
    EXPECT_NEAR(patches.points[1].z, lifted / 2.0, kFloat);
    EXPECT_NEAR(patches.points[2].z, lifted / 2.0, kFloat);
    EXPECT_EQ(bits(patches.points[1]), bits(patches.points[16 + 4]));  // the second has it from C to A
    EXPECT_EQ(bits(patches.points[2]), bits(patches.points[16 + 7]));
}

TEST(Triangles, NormalsOfTheFacesLeaveASolidFlat) {
    TriangleMesh mesh = cube();
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::vec3& origin = mesh.positions[a];
        mesh.normals.emplace_back().fill(glm::cross(mesh.positions[b] - origin, mesh.positions[c] - origin));
    }
    const Mesh curved = pnMesh(mesh, false);
    const Mesh flat = pnMesh(mesh, true);
    ASSERT_EQ(curved.points.size(), flat.points.size());
    for (std::size_t k = 0; k < flat.points.size(); ++k) EXPECT_LT(distance(curved.points[k], glm::dvec3(flat.points[k])), kFloat) << k;
}

TEST(Triangles, FlatPatchesAreThePlaneWithItsNormal) {
    std::mt19937 random(8);
    TriangleMesh mesh = ring(6, 4, 0.1F, 8);
    addRandomNormals(mesh, random);
    const Mesh patches = pnMesh(mesh, true);
    for (std::size_t patch = 0; patch < patches.patchCount(); ++patch) {
        const glm::vec3* p = &patches.points[16 * patch];
        const glm::dvec3 a(p[0]), b(p[3]), c(p[9]);
        const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
        for (std::size_t k = 10; k < 16; ++k) EXPECT_LT(distance(p[k], normal), kFloat);
        EXPECT_LT(distance(p[1], (2.0 * a + b) / 3.0), kFloat);
        EXPECT_LT(distance(p[8], (b + 2.0 * c) / 3.0), kFloat);
        EXPECT_LT(distance(p[4], (2.0 * a + c) / 3.0), kFloat);
        EXPECT_LT(distance(p[5], (a + b + c) / 3.0), kFloat);
    }
}

TEST(Triangles, MiddleNormalsFollowBends) {
    // Both ends lean forward: the curve goes up, comes down and goes up again, so that it leans back half-way.
    const glm::vec3 lean(-0.6F, 0.0F, 0.8F);
    const Mesh bent = pnMesh(oneTriangle({lean, lean, lean}), false);
    EXPECT_LT(distance(bent.points[11], {0.6, 0.0, 0.8}), kFloat);
    // Square to the side from A to C nothing leans along it.
    EXPECT_LT(distance(bent.points[13], glm::dvec3(lean)), kFloat);
    // Ends that lean apart: upright half-way.
    const Mesh domed = pnMesh(oneTriangle({lean, {0.6F, 0.0F, 0.8F}, lean}), false);
    EXPECT_LT(distance(domed.points[11], {0.0, 0.0, 1.0}), kFloat);
}

TEST(Triangles, ComputedNormalsDoNotDependOnHowFacesAreCut) {
    // By angle every corner of a cube looks along its diagonal; by count or area, diagonals of faces would sway it.
    TriangleRepairs repairs;
    const Mesh patches = pnMesh(cube(), false, &repairs);
    EXPECT_EQ(repairs.computedNormals, 36U);
    for (std::size_t patch = 0; patch < patches.patchCount(); ++patch) {
        const glm::vec3* p = &patches.points[16 * patch];
        for (const auto& [corner, normal] : {std::pair{0, 10}, std::pair{3, 12}, std::pair{9, 15}}) {
            EXPECT_LT(distance(p[normal], glm::normalize(glm::dvec3(p[corner]))), kFloat) << "patch " << patch;
        }
    }
}

TEST(Triangles, OnlyNormalsThatAreNoneAreComputed) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    TriangleMesh mesh = oneTriangle({glm::vec3(0.0F, 0.5F, 0.5F), glm::vec3(0.0F), glm::vec3(nan, 0.0F, 1.0F)});
    TriangleRepairs repairs;
    const Mesh patch = pnMesh(mesh, false, &repairs);
    EXPECT_EQ(repairs.computedNormals, 2U);
    EXPECT_LT(distance(patch.points[10], {0.0, std::sqrt(0.5), std::sqrt(0.5)}), kFloat);
    EXPECT_LT(distance(patch.points[12], {0.0, 0.0, 1.0}), kFloat);
    EXPECT_LT(distance(patch.points[15], {0.0, 0.0, 1.0}), kFloat);
}

TEST(Triangles, BuiltInSceneIsClosedAndValid) {
    const Scene scene = builtinScene("pn");
    scene.validate();
    EXPECT_EQ(scene.objects.size(), 3U);
    EXPECT_FALSE(scene.cameras.empty());
    EXPECT_FALSE(scene.lights.empty());
    for (const Mesh& mesh : scene.meshes) {
        EXPECT_TRUE(isClosed(mesh)) << mesh.name;
        EXPECT_GT(signedVolume(mesh), 0.0) << mesh.name;
    }
}

}  // namespace
}  // namespace tessera
