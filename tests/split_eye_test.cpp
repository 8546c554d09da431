// Eye-splits: planes that pass the eye, from far in front to far behind. The paper's program lost them; here nothing may be lost.
#include "split_rig.h"

#include "sample_meshes.h"

#include "render/split_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

namespace tessera::splitting {
namespace {

using reference::Random;

constexpr int width = 320;
constexpr int height = 180;

// A parallelogram: the point at (u, v) is corner + u along + v across.
struct Sheet {
    glm::dvec3 corner;
    glm::dvec3 along;
    glm::dvec3 across;

    [[nodiscard]] glm::dvec3 normal() const { return glm::normalize(glm::cross(along, across)); }
};

Scene sceneOf(const Sheet& sheet) {
    Mesh mesh;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) mesh.points.emplace_back(sheet.corner + i / 3.0 * sheet.along + j / 3.0 * sheet.across);
    return reference::sceneOf({mesh});
}

// A ground `below` the eye at the origin, `reach` each way, turned about the vertical and tilted.
Sheet ground(double below, double turn, double tilt, double reach) {
    const glm::dvec3 along(std::cos(turn), std::sin(tilt), std::sin(turn));
    const glm::dvec3 across(-std::sin(turn), 0.0, std::cos(turn));
    const glm::dvec3 up = glm::normalize(glm::cross(across, along));
    return {-below * up - reach * (along + across), 2.0 * reach * along, 2.0 * reach * across};
}

struct Hit {
    double u, v, depth;
};

// Where the ray through the picture's point (x, y) meets the sheet. The camera is Camera{} at the origin, looking along -z.
std::optional<Hit> cast(const Sheet& sheet, const frame_params& frame, double x, double y) {
    const auto focal = static_cast<double>(frame.focal);
    const glm::dvec3 ray((x - width / 2.0) / focal, (height / 2.0 - y) / focal, -1.0);
    const double depth = glm::dot(sheet.normal(), sheet.corner) / glm::dot(sheet.normal(), ray);
    if (!std::isfinite(depth)) return std::nullopt;
    const glm::dvec3 offset = depth * ray - sheet.corner;
    // In the plane's own axes, which need not be at right angles.
    const glm::dmat2 gram(glm::dot(sheet.along, sheet.along), glm::dot(sheet.along, sheet.across), glm::dot(sheet.along, sheet.across),
                          glm::dot(sheet.across, sheet.across));
    const glm::dvec2 uv = glm::inverse(gram) * glm::dvec2(glm::dot(offset, sheet.along), glm::dot(offset, sheet.across));
    return Hit{uv.x, uv.y, depth};
}

// The ranges that were diced, to be asked whether one of them holds a point. Of one patch.
class Diced {
public:
    explicit Diced(const std::vector<range_t>& ranges) {
        for (const range_t& range : ranges) sides_.insert(key(range.u_side, range.v_side));
    }
    [[nodiscard]] bool holds(double u, double v) const {
        for (std::uint32_t i = 0; i <= 24; ++i) {
            for (std::uint32_t j = 0; j <= 24; ++j) {
                if (sides_.contains(key(side(i, u), side(j, v)))) return true;
            }
        }
        return false;
    }

private:
    [[nodiscard]] static std::uint64_t key(std::uint32_t u, std::uint32_t v) { return (std::uint64_t{u} << 32U) | v; }
    [[nodiscard]] static std::uint32_t side(std::uint32_t level, double t) {
        return (level << SIDE_LEVEL_SHIFT) | static_cast<std::uint32_t>(std::ldexp(t, static_cast<int>(level)));
    }
    std::unordered_set<std::uint64_t> sides_;
};

RenderOptions optionsOf(int depth) {
    RenderOptions options;
    options.mode = DiceMode::classical;
    options.width = width;
    options.height = height;
    options.maxDepth = depth;
    return options;
}

// Splits the scene that is placed to the end, p ranges at a time. Fails where an iteration works on nothing, and where the work does not
// end: these pictures have fewer than 30000 ranges.
std::vector<range_t> diceAll(SplitRig& rig, std::uint32_t p) {
    const Outcome expected = depthFirst(rig.patches().patches, rig.hostBound(), 200'000);
    SplitPass pass(rig, {p, p, p}, 64);
    std::vector<range_t> diced;
    std::uint64_t processed = 0;
    while (!pass.over() && !::testing::Test::HasFailure()) {
        pass.step();
        EXPECT_GT(pass.processed(), processed);
        EXPECT_LE(pass.processed(), expected.processed);
        processed = pass.processed();
        const StackVerdict verdict = judge(pass.stack(), p, static_cast<int>(rig.frame().max_depth));
        EXPECT_TRUE(verdict.ordered && verdict.bounded && verdict.summed && verdict.shallow);
        const std::vector<range_t> ready = pass.takeReady();
        diced.insert(diced.end(), ready.begin(), ready.end());
    }
    EXPECT_EQ(processed, expected.processed);
    EXPECT_TRUE(same(sorted(diced), sorted(expected.diced)));
    EXPECT_EQ(areaOf(diced) + expected.culledArea, 1.0) << "diced and culled ranges must make up the patch";
    EXPECT_NEAR(static_cast<double>(pass.state().area_done), 1.0, 1e-4);
    return diced;
}

// Rays through the picture that meet the sheet in sight meet a range that was diced.
void expectSeenIsDiced(const SplitRig& rig, const Sheet& sheet, const std::vector<range_t>& ranges, int least) {
    const Diced diced(ranges);
    Random random(61);
    int met = 0;
    for (int k = 0; k < 4000; ++k) {
        // Every tenth ray through the bottom row, where the ground is nearest.
        const double x = random.between(0, width);
        const double y = k % 10 == 0 ? height - 0.5 : random.between(0, height);
        const std::optional<Hit> hit = cast(sheet, rig.frame(), x, y);
        const double near = 1.001 * static_cast<double>(rig.frame().near_plane);
        if (!hit || hit->depth < near || hit->u < 0.0 || hit->u >= 1.0 || hit->v < 0.0 || hit->v >= 1.0) continue;
        ++met;
        ASSERT_TRUE(diced.holds(hit->u, hit->v)) << "nothing at pixel (" << x << ", " << y << "), u " << hit->u << ", v " << hit->v;
    }
    EXPECT_GE(met, least);
}

struct Case {
    double below, turn, tilt;
    int leastRays;  // of 4000 that meet the sheet in sight
};

// From a ground well below to one that the eye almost lies in, and one that rises in front.
std::vector<Case> cases() {
    return {{2, 0, 0, 1500}, {1, 0.3, 0.2, 1500}, {0.3, 0.8, -0.1, 1500}, {0.02, 0.1, 0, 1000}, {0.5, 1.3, -1.2, 3000}};
}

TEST(EyeSplit, WhatIsSeenOfAPlaneThatPassesTheEyeIsDiced) {
    SplitRig rig(kernelSources());
    for (const Case& c : cases()) {
        for (const int depth : {0, 4, 11, 23, 24}) {
            SCOPED_TRACE(std::to_string(c.below) + " below the eye, depth " + std::to_string(depth));
            const Sheet sheet = ground(c.below, c.turn, c.tilt, 300);
            rig.place(sceneOf(sheet), Camera{}, optionsOf(depth));
            const std::vector<range_t> diced = diceAll(rig, 500);
            expectSeenIsDiced(rig, sheet, diced, c.leastRays);
        }
    }
}

// The eye in the plane itself: it is seen edge-on, and splitting must end all the same.
TEST(EyeSplit, PlaneThroughTheEyeEnds) {
    SplitRig rig(kernelSources());
    for (const double turn : {0.0, 0.4, 1.1}) {
        for (const double tilt : {0.0, 0.7}) {
            rig.place(sceneOf(ground(0.0, turn, tilt, 300)), Camera{}, optionsOf(23));
            const std::vector<range_t> diced = diceAll(rig, 500);
            EXPECT_GT(diced.size(), 10U);
        }
    }
}

// The original halved the shorter side, made slivers down to the depth limit and dropped them. From an eye well above the ground no
// range comes near that limit, and the sides of a range differ by what perspective asks for alone.
TEST(EyeSplit, HalvesLongerSidesAndLeavesNoSlivers) {
    SplitRig rig(kernelSources());
    for (const double turn : {0.0, 0.3, 0.8}) {
        rig.place(sceneOf(ground(1.0, turn, 0.0, 20.0)), Camera{}, optionsOf(23));
        for (const range_t& range : diceAll(rig, 500)) {
            ASSERT_LE(levelOf(range), 20);
            ASSERT_LE(std::abs(sideOf(range.u_side).level - sideOf(range.v_side).level), 5);
        }
    }
}

}  // namespace
}  // namespace tessera::splitting
