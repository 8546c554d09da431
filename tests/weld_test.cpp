// weld(): what it snaps, collapses and matches, and what it says of that.
#include "tessera/weld.h"

#include "tessera/error.h"
#include "weld_models.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

constexpr double kTolerance = 1e-5;

Scene sceneOf(std::vector<Mesh> meshes) {
    Scene scene;
    scene.name = "test";
    scene.meshes = std::move(meshes);
    for (std::size_t k = 0; k < scene.meshes.size(); ++k) {
        scene.meshes[k].name = "mesh " + std::to_string(k);
        Object object;
        object.name = object.mesh = scene.meshes[k].name;
        scene.objects.push_back(object);
    }
    return scene;
}

// A flat patch with corners at (x, y) and (x + w, y + h).
void addFlat(Mesh& mesh, double x, double y, double w, double h) {
    for (int k = 0; k < 16; ++k) {
        const int column = k % 4, row = k / 4;
        const glm::dvec3 point(x + w * column / 3.0, y + h * row / 3.0, 0.25 * column);
        mesh.points.emplace_back(point.x, point.y, 0.0);
    }
}

// Two unit squares side by side, `gap` apart.
Mesh twoSquares(double gap) {
    Mesh mesh;
    addFlat(mesh, 0.0, 0.0, 1.0, 1.0);
    addFlat(mesh, 1.0 + gap, 0.0, 1.0, 1.0);
    return mesh;
}

bool sameBits(const glm::vec3& a, const glm::vec3& b) {
    return std::bit_cast<std::array<std::uint32_t, 3>>(a) == std::bit_cast<std::array<std::uint32_t, 3>>(b);
}

bool sameBits(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const glm::vec3& p, const glm::vec3& q) { return sameBits(p, q); });
}

TEST(Weld, NeighboursThatDifferInTheLastBitsDrawTheSameBordersAfterwards) {
    std::mt19937 random(1);
    for (int run = 0; run < 20; ++run) {
        Model model = torusModel(6, 4, false, random);
        turn(model, random);
        std::vector<PatchPlace> places;
        Scene scene = sceneOf(model, random, places);
        disturb(scene, 0.3, kTolerance, random);
        EXPECT_GT(openPlaces(model, scene, places), 0U);
        const WeldReport report = weld(scene, kTolerance);
        EXPECT_EQ(openPlaces(model, scene, places), 0U);
        EXPECT_EQ(report.edges, 4 * model.patches.size());
        EXPECT_EQ(report.matchedEdges, report.edges);
        EXPECT_EQ(report.boundaryEdges, 0U);
        EXPECT_EQ(report.recordedEdges, 0U);
        EXPECT_GT(report.snappedPoints, 0U);
        EXPECT_LE(report.largestGap, 4.0 * report.tolerance);
    }
}

TEST(Weld, PolesOfAWeldedBallAreOnePointToTheBit) {
    std::mt19937 random(2);
    for (int run = 0; run < 20; ++run) {
        Model model = ballModel(5, 3, random);
        turn(model, random);
        std::vector<PatchPlace> places;
        Scene scene = sceneOf(model, random, places);
        disturb(scene, 0.14, kTolerance, random);
        const WeldReport report = weld(scene, kTolerance);
        EXPECT_EQ(openPlaces(model, scene, places), 0U);
        EXPECT_EQ(report.degenerateEdges, 10U);
        EXPECT_EQ(report.collapsedEdges, 10U);
        EXPECT_EQ(report.edges, 4 * model.patches.size() - 10);
        EXPECT_EQ(report.boundaryEdges, 0U);
        std::size_t poles = 0;
        for (std::size_t p = 0; p < model.patches.size(); ++p) {
            for (std::size_t side = 0; side < 4; ++side) {
                const auto border = borderOf(scene.meshes[places[p].mesh], places[p].patch, side);
                if (glm::distance(border[0], border[3]) > 1e-3F) continue;
                ++poles;
                for (const glm::vec3& point : border) EXPECT_TRUE(sameBits(point, border[0]));
            }
        }
        EXPECT_EQ(poles, 10U);
    }
}

TEST(Weld, InnerControlPointsAndUnmatchedBordersStayAsTheyAre) {
    Scene scene = sceneOf({twoSquares(1e-6)});
    const std::vector<glm::vec3> before = scene.meshes[0].points;
    const WeldReport report = weld(scene, kTolerance);
    const std::vector<glm::vec3>& after = scene.meshes[0].points;
    EXPECT_EQ(report.snappedPoints, 4U);
    EXPECT_NEAR(report.largestGap, 1e-6, 1e-7);
    for (std::size_t k = 0; k < before.size(); ++k) {
        const bool shared = k >= 16 && k % 4 == 0;
        EXPECT_EQ(sameBits(before[k], after[k]), !shared) << k;
    }
}

TEST(Weld, WhatIsFartherApartThanTheToleranceStaysOpenAndIsHintedAt) {
    const double gap = 3.0 * kTolerance * std::sqrt(5.0);
    Scene scene = sceneOf({twoSquares(gap)});
    const std::vector<glm::vec3> before = scene.meshes[0].points;
    const WeldReport report = weld(scene, kTolerance);
    EXPECT_TRUE(sameBits(before, scene.meshes[0].points));
    EXPECT_EQ(report.matchedEdges, 0U);
    EXPECT_EQ(report.boundaryEdges, 8U);
    EXPECT_EQ(report.largestGap, 0.0);
    EXPECT_NEAR(report.nearestMiss, gap, 0.01 * gap);
    Scene apart = sceneOf({twoSquares(0.5)});
    EXPECT_EQ(weld(apart, kTolerance).nearestMiss, 0.0);
}

TEST(Weld, ABorderWithTheSameEndsButAnotherCurveIsNoNeighbour) {
    Mesh mesh = twoSquares(0.0);
    mesh.points[16 + 4].x += 0.01F;
    Scene scene = sceneOf({mesh});
    const WeldReport report = weld(scene, 1e-3);
    EXPECT_EQ(report.boundaryEdges, 8U);
    EXPECT_NEAR(report.nearestMiss, 0.01, 1e-4);
}

TEST(Weld, ToleranceZeroMatchesEqualBordersAndMovesNothing) {
    Scene scene = sceneOf({twoSquares(0.0)});
    const std::vector<glm::vec3> before = scene.meshes[0].points;
    const WeldReport report = weld(scene, 0.0);
    EXPECT_EQ(report.matchedEdges, 2U);
    EXPECT_EQ(report.boundaryEdges, 6U);
    EXPECT_EQ(report.snappedPoints, 0U);
    EXPECT_TRUE(sameBits(before, scene.meshes[0].points));
    Scene apart = sceneOf({twoSquares(2e-7)});
    EXPECT_EQ(weld(apart, 0.0).matchedEdges, 0U);
}

TEST(Weld, NegativeZeroIsZeroAndGetsItsBits) {
    Mesh mesh = twoSquares(0.0);
    for (glm::vec3& point : mesh.points) point.x -= 1.0F;
    for (std::size_t k = 3; k < 16; k += 4) mesh.points[k].x = -0.0F;
    Scene scene = sceneOf({mesh});
    const WeldReport report = weld(scene, 0.0);
    EXPECT_EQ(report.matchedEdges, 2U);
    EXPECT_EQ(report.snappedPoints, 0U);
    for (std::size_t k = 3; k < 16; k += 4) EXPECT_TRUE(sameBits(scene.meshes[0].points[k], scene.meshes[0].points[13 + k]));
    EXPECT_FALSE(std::signbit(scene.meshes[0].points[3].x));
}

TEST(Weld, MeshesAreWeldedWhereTheirObjectsStandAlike) {
    const auto halves = [] {
        std::vector<Mesh> meshes(2);
        addFlat(meshes[0], 0.0, 0.0, 1.0, 1.0);
        addFlat(meshes[1], 1.0 + 1e-6, 0.0, 1.0, 1.0);
        return sceneOf(std::move(meshes));
    };
    Scene together = halves();
    EXPECT_EQ(weld(together, kTolerance).matchedEdges, 2U);
    EXPECT_TRUE(sameBits(together.meshes[0].points[3], together.meshes[1].points[0]));
    Scene moved = halves();
    moved.objects[1].transform.translation.y = 1e-30F;
    EXPECT_EQ(weld(moved, kTolerance).matchedEdges, 0U);
    Scene unplaced = halves();
    unplaced.objects.pop_back();
    EXPECT_EQ(weld(unplaced, kTolerance).matchedEdges, 0U);
    EXPECT_EQ(weld(unplaced, kTolerance).edges, 8U);
    // A third place, shared by both, puts them in one group.
    Scene linked = halves();
    linked.objects[1].transform.translation.y = 5.0F;
    linked.objects.push_back(linked.objects[0]);
    linked.objects.back().mesh = linked.meshes[1].name;
    EXPECT_EQ(weld(linked, kTolerance).matchedEdges, 2U);
}

TEST(Weld, ASmallMeshBesideALargeOneKeepsItsOwnTolerance) {
    for (const std::size_t large : {0U, 1U}) {
        std::vector<Mesh> meshes(2);
        addFlat(meshes[large], 0.0, 0.0, 1000.0, 1000.0);
        addFlat(meshes[1 - large], 0.002, 0.002, 0.001, 0.001);  // smaller than the large mesh's tolerance of 0.014
        addFlat(meshes[1 - large], 0.003 + 5e-9, 0.002, 0.001, 0.001);
        Scene scene = sceneOf(std::move(meshes));
        const WeldReport report = weld(scene, kTolerance);
        EXPECT_EQ(report.degenerateEdges, 0U);
        EXPECT_EQ(report.matchedEdges, 2U);
        EXPECT_NEAR(report.tolerance, 1000.0 * std::sqrt(2.0) * kTolerance, 1e-6);
        EXPECT_LE(report.largestGap, 1e-7);
    }
}

TEST(Weld, PointsWithACommonNeighbourMeetThoughTheyAreFartherApart) {
    Mesh mesh = twoSquares(0.0);
    addFlat(mesh, 0.0, 0.0, 1.0, 1.0);
    for (std::size_t k = 0; k < 16; ++k) mesh.points[32 + k].z = static_cast<float>(3 - k % 4);
    const auto step = static_cast<float>(0.8 * kTolerance * diagonal(mesh));
    for (std::size_t k = 0; k < 16; ++k) {
        mesh.points[16 + k].x += 2.0F * step;
        mesh.points[32 + k].x += step;
    }
    Scene scene = sceneOf({mesh});
    EXPECT_EQ(weld(scene, kTolerance).matchedEdges, 3U);
}

TEST(Weld, ALongChainOfNearPointsDrawsNothingFarAway) {
    Mesh mesh;
    addFlat(mesh, 0.0, 0.0, 1.0, 1.0);
    for (int k = 0; k < 100; ++k) addFlat(mesh, 0.5 + 0.7e-3 * k, 2.0, 0.7e-3, 0.5);
    Scene scene = sceneOf({mesh});
    const double tolerance = 1e-3 / diagonal(mesh);
    const WeldReport report = weld(scene, tolerance);
    EXPECT_LE(report.largestGap, 4e-3);
    EXPECT_GT(report.snappedPoints, 0U);
    // Every copy of a corner went the same way: the long borders between slivers still match.
    EXPECT_EQ(report.boundaryEdges, report.edges - report.matchedEdges);
    for (std::size_t k = 1; k < 100; ++k) {
        const auto right = borderOf(scene.meshes[0], k, 1), left = borderOf(scene.meshes[0], k + 1, 3);
        for (std::size_t p = 0; p < 4; ++p) EXPECT_TRUE(sameBits(right[p], left[p])) << k;
    }
}

TEST(Weld, ThreePatchesOnAnEdgeMatchAndAreCounted) {
    Mesh mesh = twoSquares(1e-6);
    addFlat(mesh, 1.0 - 1e-6, 0.0, 1.0, 1.0);
    for (std::size_t k = 32; k < 48; ++k)
        mesh.points[k] = {mesh.points[k].x, mesh.points[k].y, 2.0F * (mesh.points[k].x - mesh.points[32].x)};
    Scene scene = sceneOf({mesh});
    const WeldReport report = weld(scene, kTolerance);
    EXPECT_EQ(report.overusedEdges, 3U);
    EXPECT_EQ(report.matchedEdges, 3U);
    for (std::size_t p = 0; p < 4; ++p) {
        EXPECT_TRUE(sameBits(borderOf(scene.meshes[0], 0, 1)[p], borderOf(scene.meshes[0], 1, 3)[p]));
        EXPECT_TRUE(sameBits(borderOf(scene.meshes[0], 0, 1)[p], borderOf(scene.meshes[0], 2, 3)[p]));
    }
}

TEST(Weld, ResultsDoNotChangeWhenWeldedAgain) {
    std::mt19937 random(5);
    Model model = torusModel(5, 5, true, random);
    turn(model, random);
    std::vector<PatchPlace> places;
    Scene scene = sceneOf(model, random, places);
    disturb(scene, 0.3, kTolerance, random);
    const WeldReport first = weld(scene, kTolerance);
    const Scene once = scene;
    const WeldReport second = weld(scene, kTolerance);
    EXPECT_EQ(second.matchedEdges, first.matchedEdges);
    EXPECT_EQ(second.recordedEdges, first.recordedEdges);
    EXPECT_EQ(second.snappedPoints, 0U);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        EXPECT_TRUE(sameBits(scene.meshes[m].points, once.meshes[m].points));
        EXPECT_EQ(scene.meshes[m].edges.size(), once.meshes[m].edges.size());
    }
}

TEST(Weld, TolerancesOutsideTheirRangeAreRefused) {
    for (const double tolerance : {-1e-9, 0.2, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Scene scene = sceneOf({twoSquares(0.0)});
        try {
            (void)weld(scene, tolerance);
            ADD_FAILURE() << tolerance;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("0 to 0.1"), std::string::npos);
            EXPECT_NE(std::string(error.what()).find("test"), std::string::npos);
        }
    }
}

TEST(Weld, EmptyAndPointlikeMeshesAreNoTrouble) {
    Mesh point;
    point.points.assign(32, glm::vec3(1e9F, -1e9F, 3.0F));
    Mesh thin;  // far out, and flat but for the least of numbers
    thin.points.assign(16, glm::vec3(1e9F, 0.0F, 0.0F));
    for (std::size_t k = 0; k < 16; ++k) thin.points[k].y = static_cast<float>(k) * 1e-40F;
    Scene scene = sceneOf({Mesh{}, point, thin});
    for (const double tolerance : {0.0, 1e-300, 1e-5, 0.1}) {
        const WeldReport report = weld(scene, tolerance);
        EXPECT_EQ(report.edges + report.degenerateEdges, 12U);
    }
    Scene empty;
    EXPECT_EQ(weld(empty, kTolerance).edges, 0U);
}

// Were points compared with all others near them, this would take hours.
TEST(Weld, ManySliversAroundOnePoleCloseTheCircle) {
    constexpr int kSlivers = 40000;
    std::mt19937 random(7);
    Mesh mesh;
    for (int s = 0; s < kSlivers; ++s) {
        for (int k = 0; k < 16; ++k) {
            const int step = 3 * s + k % 4, row = k / 4;
            const double angle = 2.0 * std::numbers::pi * (step % (3 * kSlivers)) / (3 * kSlivers), radius = row / 3.0;
            mesh.points.emplace_back(glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), 0.0));
        }
    }
    Scene scene = sceneOf({mesh});
    disturb(scene, 1e-6, random);
    const WeldReport report = weld(scene, 5e-6);
    EXPECT_EQ(report.degenerateEdges, static_cast<std::size_t>(kSlivers));
    EXPECT_EQ(report.matchedEdges, static_cast<std::size_t>(2 * kSlivers));
    EXPECT_EQ(report.boundaryEdges, static_cast<std::size_t>(kSlivers));
    for (std::size_t s = 0; s < kSlivers; ++s) {
        const auto pole = borderOf(scene.meshes[0], s, 0), right = borderOf(scene.meshes[0], s, 1);
        const auto left = borderOf(scene.meshes[0], (s + 1) % kSlivers, 3);
        for (std::size_t p = 0; p < 4; ++p) {
            ASSERT_TRUE(sameBits(pole[p], left[0]));
            ASSERT_TRUE(sameBits(right[p], left[p])) << s;
        }
    }
}

TEST(Weld, TheTeapotIsClosedButForItsKnownRims) {
    Scene scene = builtinScene("teapot");
    const WeldReport clean = weld(scene, kTolerance);
    std::mt19937 random(9);
    disturb(scene, 0.25, kTolerance, random);
    const WeldReport report = weld(scene, kTolerance);
    EXPECT_EQ(report.matchedEdges, clean.matchedEdges);
    EXPECT_EQ(report.boundaryEdges, clean.boundaryEdges);
    EXPECT_EQ(report.degenerateEdges, clean.degenerateEdges);
    EXPECT_GT(report.snappedPoints, 0U);
    EXPECT_LE(report.largestGap, clean.tolerance * 2.0);
}

}  // namespace
}  // namespace tessera::test
