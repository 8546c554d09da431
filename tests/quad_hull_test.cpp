// Hulls of ranges, compiled as C++ from the kernels' own headers: they hold the surface over their range, and shrink with it.
#include "sample_meshes.h"

#include "patch_eval.h"
#include "ray_caster.h"

#include "core/frame_shared.h"
#include "device/lanes_host.h"
#include "split/quad_host.h"
#include "split/quad_shared.h"
#include "surface/patch_shared.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

// clang-format off
#include "device/kernel_headers_begin.h"
namespace tessera::kernels {
#include "split/quad_bound.clh"
}  // namespace tessera::kernels
#include "device/kernel_headers_end.h"
// clang-format on

namespace tessera::splitting {
namespace {

using reference::Random;

// A patch's net as place_patches lays it out, eye space being object space.
std::vector<float> netOf(const Mesh& mesh) {
    constexpr std::array<std::size_t, 20> gregory{0, 4, 9, 1, 8, 12, 13, 5, 7, 15, 14, 10, 3, 11, 6, 2, 16, 17, 18, 19};
    const std::size_t count = mesh.points.size();
    std::vector<float> net;
    for (int c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < count; ++k) {
            const float weight = mesh.kind == PatchKind::rational ? mesh.weights[k] : 1.0F;
            net.push_back(weight * mesh.points[mesh.kind == PatchKind::gregory ? gregory[k] : k][c]);
        }
    }
    net.insert(net.end(), mesh.weights.begin(), mesh.weights.end());
    if (mesh.kind == PatchKind::rational)
        for (int c = 0; c < 3; ++c)
            for (const std::size_t corner : {0U, 3U, 12U, 15U}) net.push_back(mesh.points[corner][c]);
    return net;
}

struct Patch {
    Mesh mesh;
    std::vector<float> net;
    std::vector<glm::dvec3> points;
    std::vector<double> weights;

    explicit Patch(Mesh of)
        : mesh(std::move(of)), net(netOf(mesh)), points(reference::patchPoints(mesh, 0)), weights(reference::patchWeights(mesh, 0)) {}

    [[nodiscard]] kernels::patch_ref ref() const { return {net.data(), static_cast<int>(mesh.kind), 0, nullptr, nullptr}; }
    [[nodiscard]] glm::dvec3 at(double u, double v) const { return reference::evaluate(mesh.kind, points, u, v, weights).position; }
};

std::vector<Patch> patchesOfEveryKind(std::uint64_t seed) {
    const Mesh bezier = reference::bumpyBezierMesh(seed, 1);
    return {Patch(bezier), Patch(reference::parted(reference::asGregory(bezier), 0.4, seed + 1)),
            Patch(reference::weighted(bezier, 4.0, seed + 2)), Patch(reference::bumpyPnMesh(seed + 3, 1))};
}

// A convex quadrilateral within a square of 2^-level: its corners on the square's sides.
quad_range anyRange(const Patch& patch, int level, Random& random) {
    const double size = std::exp2(-level);
    const bool triangle = patch.mesh.kind == PatchKind::pn;
    double u0 = random.between(0.0, 1.0 - size), v0 = random.between(0.0, 1.0 - size);
    if (triangle) {
        u0 *= 0.5;
        v0 *= 0.5;
    }
    const double reach = triangle && level == 0 ? 0.5 : 1.0;
    const std::array<double, 4> s{random.unit(), 1.0, random.unit(), 0.0}, t{0.0, random.unit(), 1.0, random.unit()};
    quad_range range{};
    for (std::size_t k = 0; k < 4; ++k) {
        range.corner_u[k] = static_cast<std::uint32_t>(UNIT * (u0 + reach * size * s[k]));
        range.corner_v[k] = static_cast<std::uint32_t>(UNIT * (v0 + reach * size * t[k]));
    }
    return range;
}

glm::dvec2 anyPlace(const quad_range& range, Random& random) {
    const double s = random.unit(), t = random.unit();
    const std::array<double, 4> weight{(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
    glm::dvec2 place(0.0);
    for (std::size_t k = 0; k < 4; ++k) place += weight[k] / UNIT * glm::dvec2(range.corner_u[k], range.corner_v[k]);
    return place;
}

struct Hull {
    std::array<glm::dvec4, QUAD_HULL> points{};
    glm::dvec3 pad{0.0};

    // How far beyond the hull a point lies along a direction; below 0 within. Weights are above 0, so nothing is divided.
    [[nodiscard]] double beyond(const glm::dvec3& point, const glm::dvec3& direction) const {
        double least = std::numeric_limits<double>::infinity();
        for (const glm::dvec4& p : points) least = std::min(least, glm::dot(point, direction) * p.w - glm::dot(glm::dvec3(p), direction));
        return least - glm::dot(pad, glm::abs(direction));
    }
};

Hull hullOf(const Patch& patch, const quad_range& range) {
    Hull hull;
    for (int k = 0; k < QUAD_HULL; ++k) {
        const kernels::hull_lanes lanes = kernels::quad_hull(patch.ref(), &range, k);
        hull.points[static_cast<std::size_t>(k)] = {lanes.x, lanes.y, lanes.z, lanes.w};
        hull.pad = {lanes.pad_x, lanes.pad_y, lanes.pad_z};
    }
    return hull;
}

TEST(QuadHull, HoldsTheSurfaceOverItsRange) {
    Random random(1);
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        for (const Patch& patch : patchesOfEveryKind(10 * seed)) {
            for (int run = 0; run < 12; ++run) {
                const quad_range range = anyRange(patch, run % 6, random);
                const Hull hull = hullOf(patch, range);
                for (int k = 0; k < 30; ++k) {
                    const glm::dvec2 place = anyPlace(range, random);
                    const glm::dvec3 direction = glm::normalize(random.inCube(1.0) + glm::dvec3(1e-6));
                    ASSERT_LE(hull.beyond(patch.at(place.x, place.y), direction), 2e-6)
                        << name(patch.mesh.kind) << ", seed " << seed << ", level " << run % 6;
                }
            }
        }
    }
}

// Its extent along an axis, divided by the weights.
double widthOf(const Hull& hull) {
    double width = 0.0;
    for (int c = 0; c < 3; ++c) {
        double least = std::numeric_limits<double>::infinity(), most = -least;
        for (const glm::dvec4& p : hull.points) {
            least = std::min(least, p[c] / p.w);
            most = std::max(most, p[c] / p.w);
        }
        width = std::max(width, most - least + 2.0 * hull.pad[c]);
    }
    return width;
}

// Half the range, half the hull, of every kind but Gregory: the blends of its inner points take every value at corners.
TEST(QuadHull, ShrinksWithItsRange) {
    Random random(2);
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        for (const Patch& patch : patchesOfEveryKind(10 * seed)) {
            const double whole = widthOf(hullOf(patch, anyRange(patch, 0, random)));
            for (int level = 2; level <= 8; ++level) {
                const double width = widthOf(hullOf(patch, anyRange(patch, level, random)));
                const double most = patch.mesh.kind == PatchKind::gregory ? 1.5 * whole : 12.0 * whole * std::exp2(-level);
                ASSERT_LT(width, most) << name(patch.mesh.kind) << ", seed " << seed << ", level " << level;
            }
        }
    }
}

// A patch of the square [0, 1] x [0, 1] at depth 4, pixels wide, whose side v = 0 is drawn as one point: where the record beside it begins,
// at (-9, -9). A range that touches that side, but not the record's, must not be culled where only the record is seen.
TEST(QuadHull, ARangeAtAPoleHoldsTheRecordBesideIt) {
    HostPatches patches;
    patches.eyePoints.assign(BEZIER_FLOATS + RECORD_FLOATS, 4.0F);
    for (std::size_t k = 0; k < 16; ++k) {
        const float u = static_cast<float>(k % 4) / 3.0F, v = static_cast<float>(k / 4) / 3.0F;
        patches.eyePoints[k] = v > 0.0F ? u : 0.0F;
        patches.eyePoints[16 + k] = v;
    }
    for (std::size_t k = 0; k < 4; ++k) {
        const float along = static_cast<float>(k) / 3.0F;
        patches.eyePoints[BEZIER_FLOATS + k] = -9.0F * (1.0F - along);
        patches.eyePoints[BEZIER_FLOATS + 4 + k] = -9.0F + 10.0F * along;
        patches.eyePoints[BEZIER_FLOATS + 12 + k] = 1.0F;
    }
    patches.placed.push_back({0, 0, 0, SIDE_DEGENERATE | SIDE_RECORDED << 3U, 0});
    patches.records.push_back({});
    frame_params frame{};
    frame.watertight = 1;
    frame.bezier_patches = frame.gregory_end = frame.rational_end = frame.patches = 1;
    frame.focal = frame.dicing_focal = 4.0F;
    frame.near_plane = frame.dicing_near = 0.1F;
    frame.dicing_length = 1.0F;
    frame.grid_bits = 4;
    frame.level_most = QUAD_LEVEL_MOST;
    frame.cull_left = frame.cull_bottom = -10.0F;
    frame.cull_right = frame.cull_top = -8.0F;
    const std::uint32_t half = 1U << 23U, whole = 1U << 24U;
    const std::uint32_t ones = RATE_ONE * 0x01010101U;
    const quad_range atPole{0, ones, 0x0101U, {half, whole, whole, half}, {0, 0, half, half}};
    EXPECT_NE(splitOnHost(frame, patches, atPole).action, 0);
    const quad_range away{0, ones, 0x0101U, {half, whole, whole, half}, {half, half, whole, whole}};
    EXPECT_EQ(splitOnHost(frame, patches, away).action, 0);
}

}  // namespace
}  // namespace tessera::splitting
