// Bad triangle meshes: what is repaired, what is told, and what is refused.
#include "tessera/triangles.h"
#include "triangle_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace tessera {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TriangleRepairs repairsOf(const TriangleMesh& mesh, bool flat = false) {
    TriangleRepairs repairs;
    static_cast<void>(pnMesh(mesh, flat, &repairs));
    return repairs;
}

// What pnMesh says; empty where it is content.
std::string complaint(const TriangleMesh& mesh) {
    try {
        static_cast<void>(pnMesh(mesh, false));
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

void requireValid(const Mesh& mesh) {
    Scene scene;
    scene.meshes.push_back(mesh);
    scene.validate();
    for (std::size_t k = 0; k < mesh.points.size(); ++k) {
        if (k % 16 < 10) continue;
        EXPECT_NEAR(glm::length(glm::dvec3(mesh.points[k])), 1.0, 1e-5) << "a normal of patch " << k / 16;
    }
}

TEST(TriangleRepair, EqualPositionsBecomeOneZerosOfBothSignsToo) {
    std::mt19937 random(1);
    EXPECT_EQ(repairsOf(unwelded(cube(), random)).weldedPositions, 28U);
    TriangleMesh mesh = ring(5, 4, 0.0F, 0);
    for (glm::vec3& position : mesh.positions) position.x = 0.0F;
    TriangleMesh loose = unwelded(mesh, random);
    for (std::size_t i = 0; i < loose.positions.size(); i += 2) loose.positions[i].x = -0.0F;
    EXPECT_EQ(repairsOf(loose).boundaryEdges, repairsOf(mesh).boundaryEdges);
    for (const glm::vec3& point : pnMesh(loose, true).points) EXPECT_EQ(bits(point), bits(point + 0.0F));
}

TEST(TriangleRepair, AClosedMeshHasNothingToRepair) {
    const TriangleRepairs repairs = repairsOf(ring(6, 5, 0.1F, 2));
    EXPECT_EQ(repairs.weldedPositions + repairs.droppedNotFinite + repairs.droppedBadIndex + repairs.droppedDegenerate, 0U);
    EXPECT_EQ(repairs.droppedDuplicates + repairs.flippedTriangles + repairs.unorientedEdges, 0U);
    EXPECT_EQ(repairs.nonManifoldEdges + repairs.boundaryEdges, 0U);
}

TEST(TriangleRepair, WhatCannotBeDrawnIsLeftOutAndCounted) {
    TriangleMesh mesh = cube();
    mesh.positions.emplace_back(kNan, 0.0F, 0.0F);
    mesh.positions.emplace_back(0.0F, 2e9F, 0.0F);
    mesh.positions.emplace_back(0.0F, 0.0F, std::numeric_limits<float>::infinity());
    for (const std::uint32_t bad : {8U, 9U, 10U}) mesh.triangles.push_back({0, bad, 1});
    mesh.triangles.push_back({0, 1, 11});
    mesh.triangles.push_back({0xFFFFFFFFU, 1, 2});
    mesh.triangles.push_back({5, 5, 2});
    mesh.triangles.push_back({0, 2, 1});  // as the first
    mesh.triangles.push_back({2, 0, 1});  // as the first, other way round
    const TriangleRepairs repairs = repairsOf(mesh);
    EXPECT_EQ(repairs.droppedNotFinite, 3U);
    EXPECT_EQ(repairs.droppedBadIndex, 2U);
    EXPECT_EQ(repairs.droppedDegenerate, 1U);
    EXPECT_EQ(repairs.droppedDuplicates, 2U);
    EXPECT_TRUE(isClosed(pnMesh(mesh, false)));
}

TEST(TriangleRepair, MeshesWithNothingToDrawAreErrorsThatNameThem) {
    TriangleMesh empty;
    empty.name = "nothing\nat all";
    TriangleMesh broken = cube();
    broken.positions.assign(8, glm::vec3(kNan));
    TriangleMesh line;
    line.name = "line";
    line.positions = {{0.0F, 0.0F, 0.0F}, {1.0F, 2.0F, 3.0F}, {2.0F, 4.0F, 6.0F}};
    line.triangles = {{0, 1, 2}};
    TriangleMesh odd = cube();
    odd.normals.resize(3);
    for (const TriangleMesh& mesh : {empty, broken, line, odd}) {
        const std::string message = complaint(mesh);
        EXPECT_EQ(message.rfind("mesh '", 0), 0U) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
    EXPECT_NE(complaint(odd).find("3 triples of normals for 12 triangles"), std::string::npos) << complaint(odd);
}

TEST(TriangleRepair, NeighboursAreTurnedTheWayOfTheGreaterPart) {
    for (unsigned seed = 0; seed < 10; ++seed) {
        std::mt19937 random(seed);
        TriangleMesh mesh = ring(8, 6, 0.1F, seed);
        const TriangleMesh whole = mesh;
        std::size_t turned = 0;
        for (std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
            if (random() % 3 != 0) continue;
            std::swap(triangle[random() % 2], triangle[2]);
            ++turned;
        }
        TriangleRepairs repairs;
        const Mesh patches = pnMesh(mesh, false, &repairs);
        EXPECT_EQ(repairs.flippedTriangles, turned) << "seed " << seed;
        EXPECT_EQ(repairs.unorientedEdges, 0U);
        EXPECT_NEAR(signedVolume(patches), signedVolume(pnMesh(whole, false)), 1e-4) << "seed " << seed;
        EXPECT_TRUE(isClosed(patches));
    }
}

TEST(TriangleRepair, EachPieceIsTurnedByItself) {
    // Two cubes, one wholly inside out: it is as its maker wanted it.
    TriangleMesh mesh = cube();
    const std::size_t count = mesh.triangles.size();
    for (std::size_t i = 0; i < 8; ++i) mesh.positions.push_back(mesh.positions[i] + glm::vec3(5.0F, 0.0F, 0.0F));
    for (std::size_t t = 0; t < count; ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        mesh.triangles.push_back({c + 8, b + 8, a + 8});
    }
    EXPECT_EQ(repairsOf(mesh).flippedTriangles, 0U);
    std::swap(mesh.triangles[count + 4][0], mesh.triangles[count + 4][1]);
    EXPECT_EQ(repairsOf(mesh).flippedTriangles, 1U);
}

TEST(TriangleRepair, NormalsOfTurnedTrianglesLookToTheNewFront) {
    std::mt19937 random(6);
    TriangleMesh mesh = cube();
    for (const auto& triangle : mesh.triangles) {
        std::array<glm::vec3, 3>& normals = mesh.normals.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) normals[k] = mesh.positions[triangle[k]];
    }
    const auto turn = [&](std::size_t t) {
        std::swap(mesh.triangles[t][0], mesh.triangles[t][2]);
        std::swap(mesh.normals[t][0], mesh.normals[t][2]);
    };
    turn(3);  // its normals are right
    turn(7);  // its normals go with its wrong side
    for (glm::vec3& normal : mesh.normals[7]) normal = -normal;
    const Mesh patches = pnMesh(mesh, false);
    for (std::size_t patch = 0; patch < patches.patchCount(); ++patch) {
        const glm::vec3* p = &patches.points[16 * patch];
        EXPECT_LT(glm::length(glm::dvec3(p[10]) - glm::normalize(glm::dvec3(p[0]))), 1e-6) << patch;
        EXPECT_LT(glm::length(glm::dvec3(p[12]) - glm::normalize(glm::dvec3(p[3]))), 1e-6) << patch;
        EXPECT_LT(glm::length(glm::dvec3(p[15]) - glm::normalize(glm::dvec3(p[9]))), 1e-6) << patch;
    }
}

TEST(TriangleRepair, OneSidedSurfacesAreToldAndStillMeet) {
    constexpr std::uint32_t kLength = 12;
    TriangleMesh mesh;
    mesh.name = "moebius";
    for (std::uint32_t i = 0; i < kLength; ++i) {
        const double a = 6.283185307179586 * i / kLength;
        const glm::dvec3 out(std::cos(a), std::sin(a), 0.0);
        const glm::dvec3 across = std::cos(a / 2.0) * glm::dvec3(0.0, 0.0, 1.0) + std::sin(a / 2.0) * out;
        mesh.positions.emplace_back(2.0 * out - 0.5 * across);
        mesh.positions.emplace_back(2.0 * out + 0.5 * across);
        const bool last = i + 1 == kLength;
        const std::uint32_t here = 2 * i, low = last ? 1 : here + 2, high = last ? 0 : here + 3;
        mesh.triangles.push_back({here, low, high});
        mesh.triangles.push_back({here, high, here + 1});
    }
    TriangleRepairs repairs;
    const Mesh patches = pnMesh(mesh, false, &repairs);
    EXPECT_EQ(repairs.unorientedEdges, 1U);
    EXPECT_EQ(repairs.boundaryEdges, 2U * kLength);
    int inner = 0;
    for (const auto& [curve, count] : countCurves(patches)) inner += count == 2 ? 1 : 0;
    EXPECT_EQ(inner, 2 * static_cast<int>(kLength));
}

TEST(TriangleRepair, EdgesOfManyTrianglesAreToldAndAreOneCurve) {
    std::mt19937 random(9);
    TriangleMesh mesh;
    mesh.name = "book";
    mesh.positions = {{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}};
    for (std::uint32_t page = 0; page < 5; ++page) {
        mesh.positions.emplace_back(std::cos(static_cast<float>(page)), std::sin(static_cast<float>(page)), 0.5F);
        mesh.triangles.push_back(page % 2 == 0 ? std::array<std::uint32_t, 3>{0, 1, page + 2}
                                               : std::array<std::uint32_t, 3>{1, 0, page + 2});
    }
    addRandomNormals(mesh, random);
    TriangleRepairs repairs;
    const std::map<CurveBits, int> curves = countCurves(pnMesh(mesh, false, &repairs));
    EXPECT_EQ(repairs.nonManifoldEdges, 1U);
    EXPECT_EQ(repairs.boundaryEdges, 10U);
    EXPECT_EQ(repairs.flippedTriangles, 0U);
    EXPECT_EQ(curves.size(), 11U);
}

TEST(TriangleRepair, ThreeCornersOnALineKeepTheirNeighboursTogether) {
    // A cube with a corner on the middle of one edge, which only one of its faces has: a triangle without area closes the gap.
    TriangleMesh mesh = cube();
    mesh.positions.emplace_back(0.0F, 1.0F, 1.0F);  // between 6 and 7
    mesh.triangles[3] = {5, 7, 8};
    mesh.triangles.push_back({5, 8, 6});
    mesh.triangles.push_back({8, 7, 6});
    for (const bool flat : {false, true}) {
        TriangleRepairs repairs;
        const Mesh patches = pnMesh(mesh, flat, &repairs);
        EXPECT_EQ(repairs.droppedDegenerate, 0U);
        EXPECT_EQ(repairs.boundaryEdges, 0U);
        EXPECT_TRUE(isClosed(patches));
        requireValid(patches);
    }
}

TEST(TriangleRepair, NormalsThatCancelAreThoseOfTheFace) {
    // Around the tip of a double cone all directions even out.
    TriangleMesh mesh;
    mesh.name = "tip";
    mesh.positions = {{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {-1, 0, -1}, {0, -1, -1}};
    mesh.triangles = {{0, 1, 2}, {0, 4, 3}};
    const Mesh patches = pnMesh(mesh, false);
    requireValid(patches);
    for (std::size_t patch = 0; patch < 2; ++patch) {
        const glm::vec3* p = &patches.points[16 * patch];
        const glm::dvec3 face = glm::normalize(glm::cross(glm::dvec3(p[3] - p[0]), glm::dvec3(p[9] - p[0])));
        EXPECT_LT(glm::length(glm::dvec3(p[10]) - face), 1e-6);
    }
}

TEST(TriangleRepair, SizesAtTheLimitsStayInside) {
    std::mt19937 random(11);
    for (const float size : {1e9F, 1e-38F, 1e-42F}) {
        TriangleMesh mesh = cube();
        for (glm::vec3& position : mesh.positions) position *= size;
        addRandomNormals(mesh, random);
        for (std::array<glm::vec3, 3>& normals : mesh.normals) normals[0] *= 1e38F, normals[1] *= 1e-40F;
        const Mesh patches = pnMesh(mesh, false);
        requireValid(patches);
        EXPECT_TRUE(isClosed(patches)) << size;
    }
}

TEST(TriangleRepair, SliversWithoutNumberGetThrough) {
    // A fan of slivers around one edge and one of slivers around one position: what a search among neighbours would take ages for.
    constexpr std::uint32_t kCount = 100000;
    TriangleMesh mesh;
    mesh.name = "slivers";
    mesh.positions = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}};
    for (std::uint32_t i = 0; i < kCount; ++i) {
        mesh.positions.emplace_back(0.5F, 1e-6F * static_cast<float>(i + 1), 1e-9F);
        mesh.triangles.push_back({0, 1, i + 2});
        mesh.triangles.push_back({0, i + 2, i + 1});
    }
    TriangleRepairs repairs;
    const Mesh patches = pnMesh(mesh, false, &repairs);
    EXPECT_EQ(repairs.nonManifoldEdges, kCount - 1);
    EXPECT_EQ(repairs.droppedDuplicates, 1U);
    requireValid(patches);
}

}  // namespace
}  // namespace tessera
