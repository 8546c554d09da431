// Watertight to the bit, on the device: neighbours draw the same vertices along their borders, whatever their kinds, directions, levels and
// rates; and around closed models nothing stays open, by any method.
#include "border_models.h"
#include "border_segments.h"
#include "closed_models.h"
#include "quad_rig.h"
#include "split_adversary.h"
#include "weld_models.h"

#include "tessera/weld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tessera::splitting {
namespace {

using reference::Random;

std::uint32_t below(Random& random, std::uint32_t end) { return static_cast<std::uint32_t>(random.unit() * end); }

// A camera that has all of the scene in sight.
Camera wholeView(const Scene& scene, Random& random) {
    const Bounds bounds = worldBounds(scene);
    const glm::dvec3 middle = 0.5 * (glm::dvec3(bounds.lower) + glm::dvec3(bounds.upper));
    const double radius = 0.5 * glm::distance(glm::dvec3(bounds.lower), glm::dvec3(bounds.upper));
    const glm::dvec3 away = glm::normalize(random.inCube(1.0) + glm::dvec3(1e-3, 0.0, 0.0));
    return reference::cameraAt(middle + 3.0 * radius * away, middle, 45);
}

// A view to measure edges from, of a scene that it crosses. What lies beside the eye is the larger, the nearer the near plane is.
Camera dicingView(const Scene& scene, test::ViewKind kind, std::uint64_t seed) {
    Camera camera = test::randomView(scene, kind, seed);
    camera.near = 0.5F;
    return camera;
}

// Grids and rates so that the picture is some `across` largest grids wide.
RenderOptions optionsOf(double across, Random& random) {
    RenderOptions options;
    options.mode = DiceMode::watertight;
    options.width = options.height = 64 << below(random, 4);
    options.pixelSamples = 1;
    options.gridSize = 1 << below(random, 6);
    const double length = options.width / (across * options.gridSize);
    options.shadingRate = static_cast<float>(std::clamp(length * length, 0.0625, 65536.0));
    return options;
}

struct Diced {
    std::vector<quad_range> ranges;
    std::vector<Border> borders;
};

Diced diceAll(QuadRig& rig, std::uint32_t p = 1000) {
    const QuadsFound found = findBounded(rig, p);
    return {found.diced, rig.borders(found.diced)};
}

// How often each rate occurs on edges of diced ranges.
void countRates(const Diced& diced, std::array<std::size_t, 8>& rates) {
    for (const quad_range& range : diced.ranges)
        for (std::uint32_t k = 0; k < 4; ++k) ++rates.at(byteOf(range.rates, k));
}

// The vertices that one side draws on the shared border, by their place on its curve. Fails where a place has two.
using Drawn = std::map<std::uint64_t, Position>;

struct SideDrawn {
    Drawn all;      // on the curve; also of ranges that are flat: all their corners on the border, and no part of it
    Drawn outline;  // at the ends of segments which the side's ranges do not cancel among themselves
};

SideDrawn drawnOnSide(const QuadRig& rig, const SharedBorder& shared, std::size_t side, const Diced& diced) {
    SideDrawn drawn;
    std::map<std::array<std::uint64_t, 2>, int> times;
    const std::vector<std::size_t>& users = shared.onEachSide.at(side);
    for (std::size_t r = 0; r < diced.ranges.size(); ++r) {
        const std::size_t number = rig.host().placed[diced.ranges[r].patch_index].object;
        if (std::find(users.begin(), users.end(), number) == users.end()) continue;
        const BorderUser& user = shared.users[number];
        const Border& border = diced.borders[r];
        for (std::size_t k = 0; k < border.size(); ++k) {
            const BorderVertex& vertex = border[k];
            const BorderVertex& next = border[(k + 1) % border.size()];
            if (!onBorder(user, vertex.u, vertex.v)) continue;
            const std::uint64_t here = alongCurve(user, vertex.u, vertex.v);
            const auto [at, isNew] = drawn.all.emplace(here, vertex.position);
            EXPECT_TRUE(isNew || at->second == vertex.position) << "two vertices in one place";
            if (!onBorder(user, next.u, next.v)) continue;
            const std::uint64_t there = alongCurve(user, next.u, next.v);
            if (here != there) ++times[{std::min(here, there), std::max(here, there)}];
        }
    }
    for (const auto& [segment, count] : times) {
        if (count % 2 == 0) continue;
        for (const std::uint64_t end : segment) drawn.outline.emplace(end, drawn.all.at(end));
    }
    return drawn;
}

std::set<Position> positionsOf(const Drawn& drawn) {
    std::set<Position> positions;
    for (const auto& [at, position] : drawn) positions.insert(position);
    return positions;
}

struct Counts {
    std::array<std::size_t, 8> rates{};
    std::size_t vertices = 0;
};

void expectBothSidesAlike(QuadRig& rig, BorderLook look, int runs, std::uint64_t seed, Counts& counts) {
    Random random(seed);
    for (int run = 0; run < runs && !::testing::Test::HasFailure(); ++run) {
        const SharedBorder shared = sharedBorder(look, random);
        shared.scene.validate();
        RenderOptions options = optionsOf(random.between(0.1, 12.0), random);
        // From the midst of the patches edges pass the near plane.
        if (run % 3 == 2) {
            options.dicingCamera = reference::cameraAt(random.inCube(0.8), random.inCube(0.8), random.between(30, 90));
            options.dicingCamera->near = static_cast<float>(random.between(0.1, 0.6));
        }
        rig.place(shared.scene, wholeView(shared.scene, random), options);
        const Diced diced = diceAll(rig);
        SCOPED_TRACE("run " + std::to_string(run) + ": " + shared.text + "grid " + std::to_string(options.gridSize) + ", rate " +
                     std::to_string(options.shadingRate) + ", width " + std::to_string(options.width));
        const SideDrawn first = drawnOnSide(rig, shared, 0, diced);
        const SideDrawn second = drawnOnSide(rig, shared, 1, diced);
        if (shared.onePoint) {
            EXPECT_EQ(positionsOf(first.all).size(), 1U);
            EXPECT_EQ(positionsOf(first.all), positionsOf(second.all));
        } else {
            ASSERT_GE(first.outline.size(), 2U);
            EXPECT_EQ(first.outline, second.outline);
        }
        counts.vertices += first.outline.size();
        countRates(diced, counts.rates);
    }
}

void expectAllRates(const Counts& counts) {
    for (std::size_t rate = RATE_ONE; rate <= RATE_ONE + 5; ++rate) EXPECT_GT(counts.rates[rate], 500U) << "rate " << rate;
}

TEST(EdgeBits, BothSidesOfASharedBorderDrawTheSameVertices) {
    QuadRig rig(kernelSources());
    Counts counts;
    expectBothSidesAlike(rig, BorderLook::own, 150, 1, counts);
    expectAllRates(counts);
    EXPECT_GT(counts.vertices, 1000U);
}

TEST(EdgeBits, ABorderThatIsAPointIsThatPointOnBothSides) {
    QuadRig rig(kernelSources());
    Counts counts;
    expectBothSidesAlike(rig, BorderLook::onePoint, 60, 2, counts);
    expectAllRates(counts);
    EXPECT_GT(counts.rates[RATE_ZERO], 500U);
}

TEST(EdgeBits, PatchesOfAnyKindAndLevelDrawTheirRecordsAlike) {
    QuadRig rig(kernelSources());
    Counts counts;
    expectBothSidesAlike(rig, BorderLook::recorded, 150, 3, counts);
    expectAllRates(counts);
    EXPECT_GT(counts.vertices, 1000U);
}

TEST(EdgeBits, OneLaneAndTheShapeOfGpusDrawTheSameVertices) {
    for (QuadRig& rig : std::array{QuadRig(kernelSources(), Shape::gpu), QuadRig(kernelSources(), Shape::native, 1)}) {
        Counts counts;
        expectBothSidesAlike(rig, BorderLook::own, 25, 4, counts);
        expectBothSidesAlike(rig, BorderLook::recorded, 25, 5, counts);
    }
}

// The walk around a range is the outline of its grid, and what the host says of its edges.
void expectOutlines(const QuadRig& rig, const Diced& diced) {
    for (std::size_t r = 0; r < diced.ranges.size(); r += 1 + diced.ranges.size() / 300) {
        const quad_range& range = diced.ranges[r];
        const std::uint32_t columns = 1U << byteOf(range.sizes, 2);
        const std::uint32_t rows = 1U << byteOf(range.sizes, 3);
        const std::uint32_t side = columns + 1;
        std::set<std::uint32_t> places;
        std::uint32_t last = side;  // the walk ends below the first corner
        for (const BorderVertex& vertex : diced.borders[r]) {
            const std::uint32_t column = vertex.place % side;
            const std::uint32_t row = vertex.place / side;
            ASSERT_TRUE(column == 0 || column == columns || row == 0 || row == rows);
            ASSERT_TRUE(places.insert(vertex.place).second);
            const std::uint32_t step = std::max(last, vertex.place) - std::min(last, vertex.place);
            ASSERT_TRUE(step == 1 || step == side);
            last = vertex.place;
        }
        ASSERT_EQ(diced.borders[r].front().place, 0U);
        ASSERT_EQ(diced.borders[r][1].place, 1U);
        std::vector<HostVertex> expected;
        for (int k = 0; k < 4; ++k) {
            const std::vector<HostVertex> edge = edgeVerticesOnHost(rig.frame(), rig.host(), range, k);
            expected.insert(expected.end(), edge.begin(), edge.end());
        }
        const auto samePlace = [](const auto& a, const auto& b) { return a.u == b.u && a.v == b.v; };
        expected.erase(std::unique(expected.begin(), expected.end(), samePlace), expected.end());
        if (expected.size() > 1 && samePlace(expected.front(), expected.back())) expected.pop_back();
        Border found = diced.borders[r];
        found.erase(std::unique(found.begin(), found.end(), samePlace), found.end());
        if (found.size() > 1 && samePlace(found.front(), found.back())) found.pop_back();
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t k = 0; k < found.size(); ++k) {
            ASSERT_TRUE(samePlace(found[k], expected[k]));
            for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(std::bit_cast<float>(found[k].position[c]), expected[k].position[c]);
        }
    }
}

bool isOriented(const std::string& model) { return model == "sphere" || model == "torus" || model.starts_with("pn_"); }

TEST(EdgeBits, ClosedModelsHaveNoOpenSegment) {
    QuadRig rig(kernelSources());
    Random random(6);
    Counts counts;
    for (const test::ClosedModel& model : test::closedModels()) {
        for (int view = 0; view < 6; ++view) {
            RenderOptions options = optionsOf(view >= 3 ? random.between(0.5, 4.0) : random.between(1.0, 20.0), random);
            const auto kind = view % 2 == 0 ? test::ViewKind::throughNearPlane : test::ViewKind::inside;
            if (view >= 3) options.dicingCamera = dicingView(model.scene, kind, 100 + static_cast<std::uint64_t>(view));
            rig.place(model.scene, wholeView(model.scene, random), options);
            const Diced diced = diceAll(rig);
            SCOPED_TRACE(model.name + ", view " + std::to_string(view) + ", grid " + std::to_string(options.gridSize) + ", rate " +
                         std::to_string(options.shadingRate));
            EXPECT_EQ(openSegments(diced.borders), 0U);
            EXPECT_TRUE(!isOriented(model.name) || unorientedSegments(diced.borders) == 0);
            expectOutlines(rig, diced);
            countRates(diced, counts.rates);
        }
    }
    expectAllRates(counts);
    EXPECT_GT(counts.rates[RATE_ZERO], 500U);
}

// Patches of every kind and of several levels, disturbed in the last bits and mended by weld().
TEST(EdgeBits, WeldedModelsHaveNoOpenSegment) {
    QuadRig rig(kernelSources());
    Random random(7);
    std::mt19937 shuffle(7);
    for (int run = 0; run < 16; ++run) {
        test::Model model = run % 4 == 3 ? test::ballModel(4, 3, shuffle) : test::torusModel(4, 3, run % 2 == 0, shuffle);
        for (std::size_t cut = 0; cut < 8 && run % 3 != 2; ++cut) test::halve(model, shuffle() % model.patches.size());
        test::turn(model, shuffle);
        std::vector<test::PatchPlace> places;
        Scene scene = test::sceneOf(model, shuffle, places);
        test::disturb(scene, 0.3, 1e-5, shuffle);
        const WeldReport report = weld(scene, 1e-5);
        ASSERT_EQ(report.boundaryEdges, 0U);
        for (int view = 0; view < 3; ++view) {
            rig.place(scene, wholeView(scene, random), optionsOf(random.between(1.0, 20.0), random));
            const Diced diced = diceAll(rig);
            EXPECT_EQ(openSegments(diced.borders), 0U) << "run " << run << ", view " << view;
            expectOutlines(rig, diced);
        }
    }
}

// Whether both ends lie beyond one plane of the view: then the range beyond the segment may have been culled.
bool outOfView(const frame_params& frame, const std::array<Position, 2>& ends) {
    std::array<bool, 5> beyond{true, true, true, true, true};
    for (const Position& end : ends) {
        const auto at = [&](std::size_t c) { return static_cast<double>(std::bit_cast<float>(end[c])); };
        const double x = at(0) * static_cast<double>(frame.focal), y = at(1) * static_cast<double>(frame.focal), z = at(2);
        const double slack = 1e-5 * (std::abs(x) + std::abs(y) + std::abs(z) * frame.width);
        const std::array<double, 5> inside{x + 0.5 * frame.width * z, 0.5 * frame.width * z - x, y + 0.5 * frame.height * z,
                                           0.5 * frame.height * z - y, z - static_cast<double>(frame.near_plane)};
        for (std::size_t k = 0; k < 5; ++k) beyond[k] = beyond[k] && inside[k] < (k < 4 ? slack : 1e-5);
    }
    return std::find(beyond.begin(), beyond.end(), true) != beyond.end();
}

// What is culled is all that opens a model, and its borders are out of sight.
TEST(EdgeBits, ClosedModelsOpenOnlyOutOfView) {
    QuadRig rig(kernelSources());
    Random random(8);
    std::size_t open = 0;
    for (const test::ClosedModel& model : test::closedModels()) {
        std::uint64_t seed = 200;
        for (const auto kind : {test::ViewKind::near, test::ViewKind::grazing, test::ViewKind::throughNearPlane, test::ViewKind::inside}) {
            RenderOptions options = optionsOf(random.between(4.0, 20.0), random);
            options.width = options.height = 128;
            rig.place(model.scene, test::randomView(model.scene, kind, ++seed), options);
            for (const Segment& segment : segmentsOf(diceAll(rig).borders)) {
                if (segment.times % 2 == 0) continue;
                ++open;
                ASSERT_TRUE(outOfView(rig.frame(), segment.ends)) << model.name << ", seed " << seed;
            }
        }
    }
    EXPECT_GT(open, 5000U);
}

TEST(EdgeBits, EveryMethodFindsTheSameRanges) {
    QuadRig rig(kernelSources());
    Random random(9);
    for (const test::ClosedModel& model : test::closedModels()) {
        SCOPED_TRACE(model.name);
        RenderOptions options = optionsOf(1.0, random);
        options.dicingCamera = dicingView(model.scene, test::ViewKind::throughNearPlane, 300);
        for (const bool apart : {false, true}) {
            if (!apart) options.dicingCamera.reset();
            rig.place(model.scene, test::randomView(model.scene, test::ViewKind::near, 301), options);
            const QuadsFound expected = findOnHost(rig, 1);
            const auto expectSame = [&](const QuadsFound& found, const std::string& method) {
                EXPECT_TRUE(same(sorted(found.diced), sorted(expected.diced))) << method;
                EXPECT_EQ(found.processed, expected.processed) << method;
                EXPECT_EQ(found.culled, expected.culled) << method;
            };
            expectSame(findOnHost(rig, 3), "cpu, 3 threads");
            expectSame(findBreadth(rig), "breadth");
            for (const std::uint32_t p : {1U, 7U, 1000U, 40000U})
                if (p > 1 || expected.processed < 3000) expectSame(findBounded(rig, p), "bounded by " + std::to_string(p));
        }
    }
}

// Rates that are hashes of what an edge measures: still the same on both its sides, else without sense.
KernelSources hashedRates() {
    return replaced(kernelSources(),
                    {{"split/quad_measure.clh", "uint rate = rate_of_length(frame, edge_length(frame, longest, bulge));",
                      "uint hash = as_uint(length) * 2654435769u; hash ^= hash >> 15; hash *= 2246822519u;"
                      "uint rate = (hash & 0x30000u) == 0u ? RATE_ONE : RATE_ONE + (hash >> 20) % (frame->grid_bits + 4u);"}});
}

TEST(EdgeBits, RatesMadeToDoHarmOpenNothing) {
    QuadRig rig(hashedRates());
    Random random(10);
    std::uint32_t cutsMost = 0;
    for (const test::ClosedModel& model : test::closedModels()) {
        for (const std::uint32_t level : {1U, 3U, 5U}) {
            rig.place(model.scene, wholeView(model.scene, random), optionsOf(4.0, random));
            rig.setLevelMost(level);
            const Diced diced = diceAll(rig);
            EXPECT_EQ(openSegments(diced.borders), 0U) << model.name << ", level " << level;
            for (const quad_range& range : diced.ranges) {
                ASSERT_LE(std::max(byteOf(range.sizes, 0), byteOf(range.sizes, 1)), level);
                cutsMost = std::max(cutsMost, cutsOf(range));
            }
        }
    }
    EXPECT_GE(cutsMost, 8U);
}

}  // namespace
}  // namespace tessera::splitting
