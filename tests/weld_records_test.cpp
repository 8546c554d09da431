// The edge records that weld() makes: neighbours of other kind, weights or level draw the same bits along their whole border.
#include "tessera/weld.h"

#include "weld_models.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace tessera::test {
namespace {

constexpr double kTolerance = 1e-5;

void addObject(Scene& scene, Mesh mesh) {
    mesh.name = "mesh " + std::to_string(scene.meshes.size());
    Object object;
    object.name = object.mesh = mesh.name;
    scene.meshes.push_back(std::move(mesh));
    scene.objects.push_back(object);
}

// What every record must be, whoever uses it.
void expectValid(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        std::int64_t before = -1;
        for (const EdgeRecord& record : mesh.edges) {
            const std::int64_t place = 4 * static_cast<std::int64_t>(record.patch) + record.side;
            EXPECT_LT(before, place);
            before = place;
            EXPECT_LT(record.patch, mesh.patchCount());
            EXPECT_LT(record.side, 4U);
            EXPECT_LE(record.cuts, 8U);
            EXPECT_LE(record.level, record.cuts);
            EXPECT_LT(record.index, 1U << record.level);
            for (const float weight : record.weights) EXPECT_GT(weight, 0.0F);
        }
    }
}

TEST(WeldRecords, MixedKindsAndWeightsDrawTheSameBits) {
    std::mt19937 random(11);
    for (int run = 0; run < 30; ++run) {
        Model model = torusModel(6, 5, true, random);
        turn(model, random);
        std::vector<PatchPlace> places;
        Scene scene = sceneOf(model, random, places);
        disturb(scene, 0.3, kTolerance, random);
        const WeldReport report = weld(scene, kTolerance);
        expectValid(scene);
        EXPECT_EQ(openPlaces(model, scene, places), 0U);
        EXPECT_EQ(report.boundaryEdges, 0U);
        EXPECT_EQ(report.matchedEdges, report.edges);
        EXPECT_GT(report.recordedEdges, 0U);
        EXPECT_LT(report.recordedEdges, report.edges);
    }
}

TEST(WeldRecords, HalvesQuartersAndMixedLevelsDrawTheSameBits) {
    std::mt19937 random(12);
    for (int run = 0; run < 60; ++run) {
        Model model = torusModel(5, 4, run % 2 == 1, random);
        for (int cut = 0; cut < 12; ++cut) {
            if (run % 3 == 0) turn(model, random);
            halve(model, random() % model.patches.size());
        }
        turn(model, random);
        std::vector<PatchPlace> places;
        Scene scene = sceneOf(model, random, places);
        disturb(scene, 0.3, kTolerance, random);
        EXPECT_GT(openPlaces(model, scene, places), 0U);
        const WeldReport report = weld(scene, kTolerance);
        expectValid(scene);
        EXPECT_EQ(openPlaces(model, scene, places), 0U) << run;
        EXPECT_EQ(report.boundaryEdges, 0U) << run;
        EXPECT_EQ(report.matchedEdges, report.edges);
        EXPECT_LE(report.largestGap, 4.0 * report.tolerance);
    }
}

// A patch over [0, 1]^2 and, above it, parts of the same width; none of them the whole.
Scene coarseBelow(const std::vector<std::array<double, 2>>& parts) {
    Scene scene;
    scene.name = "levels";
    Mesh coarse;
    const auto height = [](double x) { return x * x * x - 0.4 * x; };
    const auto polar = [&](double a, double b, double c) { return a * b * c - 0.4 * (a + b + c) / 3.0; };
    const auto addPatch = [&](Mesh& mesh, double x0, double x1, double y0, double y1) {
        const std::array<double, 4> z{polar(x0, x0, x0), polar(x0, x0, x1), polar(x0, x1, x1), polar(x1, x1, x1)};
        for (int k = 0; k < 16; ++k) {
            const int column = k % 4, row = k / 4;
            mesh.points.emplace_back(x0 + (x1 - x0) * column / 3.0, y0 + (y1 - y0) * row / 3.0, z[static_cast<std::size_t>(column)]);
        }
    };
    EXPECT_NEAR(height(0.5), polar(0.5, 0.5, 0.5), 1e-12);
    addPatch(coarse, 0.0, 1.0, -1.0, 0.0);
    addObject(scene, coarse);
    Mesh fine;
    for (const auto& [x0, x1] : parts) addPatch(fine, x0, x1, 0.0, 0.5);
    addObject(scene, fine);
    return scene;
}

TEST(WeldRecords, EveryUserHoldsTheCoarseCurveAndTheFinestCuts) {
    Scene scene = coarseBelow({{0.0, 0.5}, {0.5, 0.75}, {0.75, 0.875}, {0.875, 1.0}});
    const WeldReport report = weld(scene, kTolerance);
    expectValid(scene);
    ASSERT_EQ(scene.meshes[0].edges.size(), 1U);
    ASSERT_EQ(scene.meshes[1].edges.size(), 4U);
    const EdgeRecord& coarse = scene.meshes[0].edges[0];
    EXPECT_EQ(coarse.side, 2U);
    EXPECT_EQ(coarse.level, 0U);
    EXPECT_EQ(coarse.cuts, 3U);
    const std::array<std::array<std::uint32_t, 2>, 4> expected{{{1, 0}, {2, 2}, {3, 6}, {3, 7}}};
    for (std::size_t k = 0; k < 4; ++k) {
        const EdgeRecord& fine = scene.meshes[1].edges[k];
        EXPECT_EQ(fine.patch, k);
        EXPECT_EQ(fine.side, 0U);
        EXPECT_EQ(fine.level, expected[k][0]);
        EXPECT_EQ(fine.index, expected[k][1]);
        EXPECT_FALSE(fine.reversed);
        EXPECT_EQ(fine.cuts, 3U);
        EXPECT_EQ(fine.points, coarse.points);
        EXPECT_EQ(fine.weights, coarse.weights);
    }
    EXPECT_EQ(report.recordedEdges, 5U);
    EXPECT_EQ(report.matchedEdges, 5U + 6U);  // and both users of each of the three borders between the fine ones
}

TEST(WeldRecords, HangingCornersLieOnTheCoarseCurveToTheBit) {
    std::mt19937 random(13);
    for (int run = 0; run < 20; ++run) {
        Scene scene = coarseBelow({{0.0, 0.5}, {0.5, 0.75}, {0.75, 1.0}});
        std::swap(scene.meshes[0], scene.meshes[1]);
        disturb(scene, 0.3, kTolerance, random);
        weld(scene, kTolerance);
        ASSERT_EQ(scene.meshes[0].edges.size(), 3U);
        for (const std::size_t part : {0U, 1U}) {
            const glm::vec3 place = drawnPoint(scene.meshes[1], 0, 2, part == 0 ? 0.5F : 0.75F);
            EXPECT_EQ(borderOf(scene.meshes[0], part, 0)[3], place);
            EXPECT_EQ(borderOf(scene.meshes[0], part + 1, 0)[0], place);
        }
    }
}

TEST(WeldRecords, TheEighthLevelIsTheFinest) {
    for (const int level : {8, 9}) {
        std::vector<std::array<double, 2>> parts;
        parts.reserve(static_cast<std::size_t>(level) + 1);
        for (int k = 0; k < level; ++k) parts.push_back({1.0 - std::ldexp(1.0, -k), 1.0 - std::ldexp(1.0, -k - 1)});
        parts.push_back({1.0 - std::ldexp(1.0, -level), 1.0});
        Scene scene = coarseBelow(parts);
        const WeldReport report = weld(scene, kTolerance);
        expectValid(scene);
        if (level == 9) {
            EXPECT_EQ(report.recordedEdges, 0U);
            continue;
        }
        ASSERT_EQ(scene.meshes[0].edges.size(), 1U);
        EXPECT_EQ(scene.meshes[0].edges[0].cuts, 8U);
        EXPECT_EQ(scene.meshes[1].edges.size(), 9U);
        EXPECT_EQ(scene.meshes[1].edges.back().index, 255U);
    }
}

TEST(WeldRecords, ACoarseBorderCoveredInPartIsABoundaryWithARecord) {
    Scene scene = coarseBelow({{0.5, 1.0}});
    const WeldReport report = weld(scene, kTolerance);
    ASSERT_EQ(scene.meshes[0].edges.size(), 1U);
    EXPECT_EQ(scene.meshes[0].edges[0].cuts, 1U);
    ASSERT_EQ(scene.meshes[1].edges.size(), 1U);
    EXPECT_EQ(scene.meshes[1].edges[0].level, 1U);
    EXPECT_EQ(scene.meshes[1].edges[0].index, 1U);
    EXPECT_EQ(report.matchedEdges, 1U);
    EXPECT_EQ(report.boundaryEdges, 7U);
}

// The second of two fine patches has no part in the curve: were the first to draw their common corner by it, their own edge would open.
TEST(WeldRecords, ACornerThatAPatchWithoutTheCurveSharesIsNotDrawnByTheCurve) {
    Scene bent = coarseBelow({{0.0, 0.5}, {0.5, 0.75}, {0.75, 1.0}});
    bent.meshes[1].points[16 + 1].z += 0.01F;
    const WeldReport report = weld(bent, kTolerance);
    ASSERT_EQ(bent.meshes[1].edges.size(), 0U);
    EXPECT_EQ(bent.meshes[0].edges.size(), 0U);
    EXPECT_EQ(report.matchedEdges, 4U);

    Scene fan = coarseBelow({{0.0, 0.5}, {0.5, 1.0}});
    std::vector<glm::vec3>& points = fan.meshes[1].points;
    const glm::vec3 middle = points[3];
    for (std::size_t k = 4; k < 16; k += 4) points[k + 3].x -= 0.1F;
    for (std::size_t k = 0; k < 16; ++k) {
        const std::size_t row = 4 * (k / 4), column = k % 4;
        const float across = static_cast<float>(column) / 3.0F;
        points.push_back(k < 4 ? middle : points[row + 3] * (1.0F - across) + points[16 + row] * across);
    }
    EXPECT_EQ(weld(fan, kTolerance).recordedEdges, 0U);
}

TEST(WeldRecords, PatchesThatOnlyTouchOrCutElsewhereGetNone) {
    Scene third = coarseBelow({{0.0, 1.0 / 3.0}, {1.0 / 3.0, 1.0}});
    EXPECT_EQ(weld(third, kTolerance).recordedEdges, 0U);
    Scene bent = coarseBelow({{0.0, 0.5}, {0.5, 1.0}});
    bent.meshes[1].points[1].z += 0.01F;
    bent.meshes[1].points[16 + 2].z += 0.01F;
    EXPECT_EQ(weld(bent, kTolerance).recordedEdges, 0U);
}

// Around a corner that lies inside a coarser border all patches have a record side there, so that they draw it alike.
TEST(WeldRecords, AllPatchesAroundAHangingCornerHaveTheCoarseCurve) {
    std::mt19937 random(14);
    for (int run = 0; run < 20; ++run) {
        Model model = torusModel(4, 4, run % 2 == 0, random);
        for (int cut = 0; cut < 8; ++cut) {
            turn(model, random);
            halve(model, random() % model.patches.size());
        }
        std::vector<PatchPlace> places;
        Scene scene = sceneOf(model, random, places);
        disturb(scene, 0.3, kTolerance, random);
        weld(scene, kTolerance);
        std::map<int, std::size_t> hanging, around;
        constexpr std::array<std::array<std::size_t, 2>, 4> ends{{{0, 1}, {1, 2}, {3, 2}, {0, 3}}};
        for (std::size_t p = 0; p < model.patches.size(); ++p) {
            for (std::size_t corner = 0; corner < 4; ++corner) ++around[model.patches[p].corners[corner]];
            for (const EdgeRecord& record : scene.meshes[places[p].mesh].edges) {
                if (record.patch != places[p].patch) continue;
                const std::uint32_t last = (1U << record.level) - 1;
                const auto [begin, end] = ends[record.side];
                if (record.index > 0) ++hanging[model.patches[p].corners[record.reversed ? end : begin]];
                if (record.index < last) ++hanging[model.patches[p].corners[record.reversed ? begin : end]];
            }
        }
        EXPECT_FALSE(hanging.empty());
        for (const auto& [vertex, count] : hanging) EXPECT_EQ(count, around[vertex]) << run;
    }
}

// The net of a patch whose border `side` runs along `curve`.
Mesh patchAlong(PatchKind kind, std::size_t side, const std::array<glm::vec3, 4>& curve, bool against, const glm::vec3& away) {
    Mesh mesh;
    mesh.kind = kind;
    std::array<glm::vec3, 4> along = curve;
    if (against) std::reverse(along.begin(), along.end());
    mesh.points.assign(pointsPerPatch(kind), glm::vec3(0.0F));
    constexpr std::array<std::array<float, 2>, 10> triangle{
        {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {0, 1}, {1, 1}, {2, 1}, {0, 2}, {1, 2}, {0, 3}}};
    for (std::size_t k = 0; k < mesh.points.size(); ++k) {
        const bool pn = kind == PatchKind::pn;
        if (pn && k >= 10) break;
        const std::size_t column = k % 4, row = k / 4;
        const float u = pn ? triangle[k][0] : static_cast<float>(column), v = pn ? triangle[k][1] : static_cast<float>(row);
        const std::array<float, 4> from{v, pn ? 3 - u - v : 3 - u, 3 - v, u}, place{u, v, u, v};
        const auto at = static_cast<std::size_t>(place[side]);
        mesh.points[k] = along[at] + away * from[side] * (1.0F + 0.1F * place[side] * (3.0F - place[side]));
    }
    if (kind == PatchKind::rational) mesh.weights.assign(16, 2.5F);
    return mesh;
}

TEST(WeldRecords, TrianglesMatchEveryKindOnEverySideEitherWay) {
    const std::array<glm::vec3, 4> curve{glm::vec3(0, 0, 0), glm::vec3(1, 0.3F, 0.2F), glm::vec3(2, 0.5F, -0.4F), glm::vec3(3, 0, 0)};
    std::mt19937 random(15);
    for (const std::size_t side : {0U, 1U, 3U}) {
        for (const PatchKind kind : {PatchKind::bezier, PatchKind::rational, PatchKind::pn}) {
            for (std::size_t other = 0; other < 4; ++other) {
                if (kind == PatchKind::pn && other == 2) continue;
                for (const bool against : {false, true}) {
                    Scene scene;
                    addObject(scene, patchAlong(PatchKind::pn, side, curve, false, {0.1F, -1, 0.2F}));
                    addObject(scene, patchAlong(kind, other, curve, against, {0.1F, 1, 0.1F}));
                    for (Mesh& mesh : scene.meshes) {
                        for (glm::vec3& point : mesh.points) point.x += 1e-6F * static_cast<float>(random() % 10);
                    }
                    const WeldReport report = weld(scene, kTolerance);
                    expectValid(scene);
                    EXPECT_EQ(report.matchedEdges, 2U);
                    EXPECT_EQ(report.recordedEdges, kind == PatchKind::rational ? 2U : 0U);
                    for (int k = 0; k <= 16; ++k) {
                        const float t = static_cast<float>(k) / 16.0F;
                        EXPECT_EQ(drawnPoint(scene.meshes[0], 0, side, t), drawnPoint(scene.meshes[1], 0, other, against ? 1.0F - t : t));
                    }
                }
            }
        }
    }
}

TEST(WeldRecords, WeightsThatDifferByMoreThanAFactorAreAnotherCurve) {
    const std::array<glm::vec3, 4> curve{glm::vec3(0, 0, 0), glm::vec3(1, 0.3F, 0.2F), glm::vec3(2, 0.5F, -0.4F), glm::vec3(3, 0, 0)};
    const auto matched = [&](float factor, float bend) {
        Scene scene;
        addObject(scene, patchAlong(PatchKind::rational, 0, curve, false, {0, 1, 0}));
        addObject(scene, patchAlong(PatchKind::rational, 2, curve, false, {0, -1, 0}));
        scene.meshes[0].weights[1] = 1.7F;
        scene.meshes[1].weights[13] = 1.7F * bend;
        for (float& weight : scene.meshes[1].weights) weight *= factor;
        const WeldReport report = weld(scene, kTolerance);
        return std::array<std::size_t, 2>{report.matchedEdges, report.recordedEdges};
    };
    EXPECT_EQ(matched(1.0F, 1.0F), (std::array<std::size_t, 2>{2, 0}));
    EXPECT_EQ(matched(3.1F, 1.0F), (std::array<std::size_t, 2>{2, 2}));
    EXPECT_EQ(matched(3.1F, 1.000005F), (std::array<std::size_t, 2>{2, 2}));
    EXPECT_EQ(matched(1.0F, 1.001F), (std::array<std::size_t, 2>{0, 0}));
}

TEST(WeldRecords, ExistingRecordsAreReplaced) {
    Scene scene = coarseBelow({{0.0, 0.5}, {0.5, 1.0}});
    scene.meshes[0].edges.resize(7);
    scene.meshes[1].edges.resize(7);
    EXPECT_EQ(weld(scene, kTolerance).recordedEdges, 3U);
    EXPECT_EQ(scene.meshes[0].edges.size(), 1U);
    EXPECT_EQ(scene.meshes[1].edges.size(), 2U);
}

}  // namespace
}  // namespace tessera::test
