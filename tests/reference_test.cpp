// Tests of the reference surfaces themselves: closed forms, derivatives and symmetries.
#include "patch_samples.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tessera::reference {
namespace {

// Control values of 1, t, t^2 and t^3 as cubics.
constexpr std::array<std::array<double, 4>, 4> power{{{1, 1, 1, 1}, {0, 1.0 / 3, 2.0 / 3, 1}, {0, 0, 1.0 / 3, 1}, {0, 0, 0, 1}}};

// The patch (u, v, u^m v^n).
std::vector<glm::dvec3> graphPatch(std::size_t m, std::size_t n) {
    std::vector<glm::dvec3> points;
    for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i < 4; ++i) points.emplace_back(power[1][i], power[1][j], power[m][i] * power[n][j]);
    return points;
}

// Parameters within the domain of `kind`, `inset` from its borders.
glm::dvec2 someParameters(PatchKind kind, Random& random, double inset) {
    for (;;) {
        const glm::dvec2 at(random.between(inset, 1.0 - inset), random.between(inset, 1.0 - inset));
        if (kind != PatchKind::pn || at.x + at.y <= 1.0 - inset) return at;
    }
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    EXPECT_LE(glm::length(a - b), tolerance) << "(" << a.x << ", " << a.y << ", " << a.z << ") and (" << b.x << ", " << b.y << ", " << b.z
                                             << ")";
}

TEST(ReferenceSurface, BezierPatchOfAPolynomialIsThatPolynomial) {
    const std::vector<glm::dvec3> points = graphPatch(3, 2);
    for (const double u : {0.0, 0.1, 0.5, 0.73, 1.0}) {
        for (const double v : {0.0, 0.2, 0.61, 1.0}) {
            const SurfacePoint s = evaluate(PatchKind::bezier, points, u, v);
            expectNear(s.position, {u, v, u * u * u * v * v}, 1e-15);
            expectNear(s.du, {1, 0, 3 * u * u * v * v}, 1e-14);
            expectNear(s.dv, {0, 1, 2 * u * u * u * v}, 1e-14);
            expectNear(unitNormal(PatchKind::bezier, points, u, v), glm::normalize(glm::cross(s.du, s.dv)), 1e-14);
        }
    }
}

TEST(ReferenceSurface, DerivativesAreTheLimitsOfDifferences) {
    Random random(7);
    const double h = 1e-5;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const Sample sample = someSample(seed);
        for (int k = 0; k < 50; ++k) {
            const glm::dvec2 at = someParameters(sample.kind, random, 0.01);
            const SurfacePoint s = sample.at(at.x, at.y);
            const glm::dvec3 du = (sample.at(at.x + h, at.y).position - sample.at(at.x - h, at.y).position) / (2 * h);
            const glm::dvec3 dv = (sample.at(at.x, at.y + h).position - sample.at(at.x, at.y - h).position) / (2 * h);
            // h^2 times a third derivative that grows like one over the distance from a corner, and rounding over h.
            expectNear(s.du, du, 1e-6);
            expectNear(s.dv, dv, 1e-6);
        }
    }
}

TEST(ReferenceSurface, GregoryCornersHaveTheTangentsOfTheirEdges) {
    const std::vector<glm::dvec3> p = blendedSample(3).points;
    const std::array<glm::dvec2, 4> corner{glm::dvec2(0, 0), {1, 0}, {1, 1}, {0, 1}};
    const std::array<glm::dvec2, 4> plus{glm::dvec2(1, 0), {0, 1}, {-1, 0}, {0, -1}};  // direction of e+ in (u, v)
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::dvec2 minus = plus[(k + 3) % 4] * -1.0;
        for (const double inset : {0.0, 1e-9}) {
            const glm::dvec2 at = corner[k] + inset * (glm::dvec2(0.5) - corner[k]);
            const SurfacePoint s = evaluate(PatchKind::gregory, p, at.x, at.y);
            expectNear(s.position, p[k], 1e-8);
            expectNear(plus[k].x * s.du + plus[k].y * s.dv, 3.0 * (p[4 + k] - p[k]), 1e-7);
            expectNear(minus.x * s.du + minus.y * s.dv, 3.0 * (p[8 + k] - p[k]), 1e-7);
        }
    }
}

// What makes neighbours smooth: the ribbon along border k (corner k to k + 1) is made of f+k and f-(k+1) alone.
TEST(ReferenceSurface, GregoryBordersDependOnTheirOwnFacePointsAlone) {
    const std::vector<glm::dvec3> points = blendedSample(5).points;
    const std::array<glm::dvec2, 4> start{glm::dvec2(0, 0), {1, 0}, {1, 1}, {0, 1}};
    for (std::size_t border = 0; border < 4; ++border) {
        const glm::dvec2 at = glm::mix(start[border], start[(border + 1) % 4], 0.3);
        const SurfacePoint before = evaluate(PatchKind::gregory, points, at.x, at.y);
        for (std::size_t face = 12; face < 20; ++face) {
            std::vector<glm::dvec3> moved = points;
            moved[face] += glm::dvec3(0.1, 0.2, 0.3);
            const SurfacePoint after = evaluate(PatchKind::gregory, moved, at.x, at.y);
            const double change = glm::length(after.du - before.du) + glm::length(after.dv - before.dv);
            const bool own = face == 12 + border || face == 16 + (border + 1) % 4;
            EXPECT_EQ(change > 1e-14, own) << "border " << border << ", face point " << face << ": " << change;
        }
    }
}

TEST(ReferenceSurface, GregoryPatchTurnedByOneCornerIsTheSameSurface) {
    const std::vector<glm::dvec3> points = blendedSample(11).points;
    std::vector<glm::dvec3> turned(20);
    for (std::size_t group = 0; group < 5; ++group)
        for (std::size_t k = 0; k < 4; ++k) turned[4 * group + k] = points[4 * group + (k + 1) % 4];
    for (const glm::dvec2 at : {glm::dvec2(0.2, 0.3), {0.9, 0.05}, {0.0, 0.4}, {1.0, 1.0}}) {
        // The turned patch starts at p1 and runs along v first.
        const SurfacePoint a = evaluate(PatchKind::gregory, turned, at.x, at.y);
        const SurfacePoint b = evaluate(PatchKind::gregory, points, 1.0 - at.y, at.x);
        expectNear(a.position, b.position, 1e-14);
        expectNear(a.du, b.dv, 1e-13);
        expectNear(a.dv, -b.du, 1e-13);
    }
}

TEST(ReferenceSurface, GregoryPatchFlippedOverTheDiagonalIsTheSameSurface) {
    const std::vector<glm::dvec3> points = blendedSample(12).points;
    std::vector<glm::dvec3> flipped(20);
    const std::array<std::size_t, 5> group{0, 2, 1, 4, 3};  // e+ and e- change places, f+ and f- likewise
    const std::array<std::size_t, 4> corner{0, 3, 2, 1};
    for (std::size_t g = 0; g < 5; ++g)
        for (std::size_t k = 0; k < 4; ++k) flipped[4 * g + k] = points[4 * group[g] + corner[k]];
    for (const glm::dvec2 at : {glm::dvec2(0.2, 0.3), {0.9, 0.05}, {0.0, 0.4}}) {
        const SurfacePoint a = evaluate(PatchKind::gregory, flipped, at.x, at.y);
        const SurfacePoint b = evaluate(PatchKind::gregory, points, at.y, at.x);
        expectNear(a.position, b.position, 1e-14);
        expectNear(a.du, b.dv, 1e-13);
        expectNear(a.dv, b.du, 1e-13);
    }
}

TEST(ReferenceSurface, BezierPatchAsGregoryIsTheSameSurface) {
    Random random(1);
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const std::vector<glm::dvec3> bezier = patchPoints(bumpyBezierMesh(seed, 1), 0);
        const std::array<glm::dvec3, 20> gregory = gregoryFromBezier(bezier);
        for (int k = 0; k < 30; ++k) {
            const double u = random.unit();
            const double v = k < 3 ? 0.0 : random.unit();
            const SurfacePoint a = evaluate(PatchKind::bezier, bezier, u, v);
            const SurfacePoint b = evaluate(PatchKind::gregory, gregory, u, v);
            expectNear(a.position, b.position, 1e-14);
            expectNear(a.du, b.du, 1e-13);
            expectNear(a.dv, b.dv, 1e-13);
        }
    }
}

TEST(ReferenceSurface, EqualWeightsChangeNothing) {
    Random random(21);
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const Sample bezier = sampleOf(bumpyBezierMesh(seed, 1));
        const Sample rational{PatchKind::rational, bezier.points, std::vector<double>(16, 0.7)};
        const glm::dvec2 at = someParameters(bezier.kind, random, 0.0);
        const SurfacePoint a = bezier.at(at.x, at.y);
        const SurfacePoint b = rational.at(at.x, at.y);
        expectNear(a.position, b.position, 1e-14);
        expectNear(a.du, b.du, 1e-13);
        expectNear(a.dv, b.dv, 1e-13);
    }
}

// Multiplying the weights of column i by f^i is the same surface at parameters u' = u / (u + f (1 - u)).
TEST(ReferenceSurface, WeightsInGeometricProgressionMoveParametersAlone) {
    Random random(22);
    const double f = 2.5;
    const Sample bezier = sampleOf(bumpyBezierMesh(3, 1));
    Sample rational{PatchKind::rational, bezier.points, {}};
    for (std::size_t i = 0; i < 16; ++i) rational.weights.push_back(std::pow(f, static_cast<double>(i % 4)));
    for (int k = 0; k < 50; ++k) {
        const glm::dvec2 at = someParameters(bezier.kind, random, 0.0);
        const double moved = f * at.x / (f * at.x + 1.0 - at.x);
        expectNear(rational.at(at.x, at.y).position, bezier.at(moved, at.y).position, 1e-14);
    }
}

// An eighth of the unit sphere: a quarter circle as a rational quadratic, raised to a cubic, both ways; row v = 1 is the pole.
Sample sphereOctant() {
    const double c = 1.0 / std::sqrt(2.0);
    const std::array<double, 4> weight{1, (1 + 2 * c) / 3, (1 + 2 * c) / 3, 1};
    const std::array<glm::dvec2, 4> weightedArc{glm::dvec2(1, 0), {(1 + 2 * c) / 3, 2 * c / 3}, {2 * c / 3, (1 + 2 * c) / 3}, {0, 1}};
    Sample sample{PatchKind::rational, {}, {}};
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::dvec2 around = weightedArc[i] / weight[i];
            const glm::dvec2 up = weightedArc[j] / weight[j];
            sample.points.emplace_back(up.x * around.x, up.x * around.y, up.y);
            sample.weights.push_back(weight[i] * weight[j]);
        }
    }
    return sample;
}

TEST(ReferenceSurface, RationalPatchOfASphereIsTheSphere) {
    Random random(23);
    const Sample sphere = sphereOctant();
    for (int k = 0; k < 100; ++k) {
        const glm::dvec2 at = someParameters(sphere.kind, random, 0.0);
        const glm::dvec3 position = sphere.at(at.x, at.y).position;
        EXPECT_NEAR(glm::length(position), 1.0, 1e-14);
        expectNear(unitNormal(sphere.kind, sphere.points, at.x, at.y, sphere.weights), position, 1e-9);
    }
    expectNear(unitNormal(sphere.kind, sphere.points, 0.3, 1.0, sphere.weights), {0, 0, 1}, 1e-8);
}

// The cubic triangle (u, v, f): a Bernstein coefficient is f's blossom at the coefficient's corners.
TEST(ReferenceSurface, PnTriangleOfAPolynomialIsThatPolynomial) {
    std::vector<glm::dvec3> points;
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i + j < 4; ++i) {
            // Of u^3: 1 where all three corners are B; of 6 u v w: 1 in the middle; of v^2: the share of pairs of corners that are C and C.
            points.emplace_back(i / 3.0, j / 3.0, (i == 3 ? 1.0 : 0.0) + (i == 1 && j == 1 ? 1.0 : 0.0) + j * (j - 1) / 6.0);
        }
    }
    Random random(24);
    for (int n = 0; n < 50; ++n) {
        const glm::dvec2 at = someParameters(PatchKind::pn, random, 0.0);
        const double u = at.x, v = at.y, w = 1 - u - v;
        const SurfacePoint s = evaluate(PatchKind::pn, points, u, v);
        expectNear(s.position, {u, v, u * u * u + 6 * u * v * w + v * v}, 1e-14);
        expectNear(s.du, {1, 0, 3 * u * u + 6 * v * w - 6 * u * v}, 1e-14);
        expectNear(s.dv, {0, 1, 6 * u * w - 6 * u * v + 2 * v}, 1e-14);
        expectNear(unitNormal(PatchKind::pn, points, u, v), glm::normalize(glm::cross(s.du, s.dv)), 1e-14);
    }
}

TEST(ReferenceSurface, PnTriangleHasItsPointsAndBordersWhereTheHeaderSays) {
    const Sample pn = sampleOf(bumpyPnMesh(9, 1));
    expectNear(pn.at(0, 0).position, pn.points[0], 0.0);
    expectNear(pn.at(1, 0).position, pn.points[3], 0.0);
    expectNear(pn.at(0, 1).position, pn.points[9], 0.0);
    const std::array<std::array<std::size_t, 4>, 3> border{{{0, 1, 2, 3}, {3, 6, 8, 9}, {0, 4, 7, 9}}};
    for (const double t : {0.1, 0.5, 0.8}) {
        const std::array<SurfacePoint, 3> there{pn.at(t, 0), pn.at(1 - t, t), pn.at(0, t)};
        const Bernstein b = bernstein(t);
        for (std::size_t side = 0; side < 3; ++side) {
            glm::dvec3 curve(0.0);
            for (std::size_t i = 0; i < 4; ++i) curve += b.value[i] * pn.points[border[side][i]];
            expectNear(there[side].position, curve, 1e-14);
        }
    }
}

TEST(ReferenceSurface, PnTriangleShadesWithItsQuadraticNormals) {
    const Sample pn = sampleOf(bumpyPnMesh(10, 1));
    const auto normal = [&](double u, double v) { return shadingNormal(pn.kind, pn.points, u, v); };
    expectNear(normal(0, 0), glm::normalize(pn.points[10]), 1e-15);
    expectNear(normal(1, 0), glm::normalize(pn.points[12]), 1e-15);
    expectNear(normal(0, 1), glm::normalize(pn.points[15]), 1e-15);
    // Vlachos et al. give the products of two parameters the weight 1, not 2.
    expectNear(normal(0.5, 0), glm::normalize(pn.points[10] + pn.points[11] + pn.points[12]), 1e-15);
    expectNear(normal(0.5, 0.5), glm::normalize(pn.points[12] + pn.points[14] + pn.points[15]), 1e-15);
    expectNear(normal(0, 0.5), glm::normalize(pn.points[10] + pn.points[13] + pn.points[15]), 1e-15);
    std::vector<glm::dvec3> bare = pn.points;
    std::fill(bare.begin() + 10, bare.end(), glm::dvec3(0.0));
    expectNear(shadingNormal(pn.kind, bare, 0.3, 0.3), unitNormal(pn.kind, pn.points, 0.3, 0.3), 0.0);
}

TEST(ReferenceSurface, PnTriangleAsABicubicNetIsTheSameSurface) {
    Random random(25);
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const Sample pn = sampleOf(bumpyPnMesh(seed, 1));
        const Net net = pnNet(pn.points);
        for (int k = 0; k < 20; ++k) {
            const glm::dvec2 at = someParameters(pn.kind, random, 0.0);
            const SurfacePoint a = pn.at(at.x, at.y);
            const SurfacePoint b = evaluate(PatchKind::bezier, net, at.x, at.y);
            expectNear(a.position, b.position, 1e-13);
            expectNear(a.du, b.du, 1e-13);
            expectNear(a.dv, b.dv, 1e-13);
        }
    }
}

// A triangle two of whose corners are one: the border between them is a point.
TEST(ReferenceSurface, PnTriangleHasANormalAtACollapsedBorder) {
    std::vector<glm::dvec3> points;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i + j < 4; ++i) points.emplace_back(j == 0 ? 0.0 : i / 3.0, j / 3.0, 0.0);
    expectNear(unitNormal(PatchKind::pn, points, 0.4, 0.0), {0, 0, 1}, 1e-8);
}

// A quarter of a bowl around its lowest point: row v = 0 is that point four times.
std::vector<glm::dvec3> bowlPatch() {
    const std::array<glm::dvec2, 4> arc{glm::dvec2(1, 0), {1, 0.5522847498}, {0.5522847498, 1}, {0, 1}};
    std::vector<glm::dvec3> points;
    for (std::size_t j = 0; j < 4; ++j)
        for (const glm::dvec2& a : arc) points.emplace_back(power[1][j] * a, power[2][j]);
    return points;
}

TEST(ReferenceSurface, NormalAtAPoleIsTheLimit) {
    for (const double u : {0.0, 0.3, 1.0}) expectNear(unitNormal(PatchKind::bezier, bowlPatch(), u, 0.0), {0, 0, -1}, 1e-8);
    const glm::dvec3 beside = unitNormal(PatchKind::bezier, bowlPatch(), 0.5, 1e-6);
    expectNear(beside, {0, 0, -1}, 1e-5);
}

TEST(ReferenceSurface, PatchWithoutAreaHasNoNormal) {
    const std::vector<glm::dvec3> point(16, glm::dvec3(1, 2, 3));
    expectNear(unitNormal(PatchKind::bezier, point, 0.5, 0.5), glm::dvec3(0.0), 0.0);
    std::vector<glm::dvec3> line(16, glm::dvec3(0.0));
    for (std::size_t i = 0; i < 16; ++i) line[i].x = static_cast<double>(i);
    expectNear(unitNormal(PatchKind::bezier, line, 0.2, 0.7), glm::dvec3(0.0), 0.0);
}

}  // namespace
}  // namespace tessera::reference
