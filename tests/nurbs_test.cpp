// NURBS as bicubic patches: the same surface as de Boor's algorithm gives, joined to the bit; and what is refused.
#include "tessera/surfaces.h"

#include "exact_patches.h"
#include "reference/sample_meshes.h"
#include "tessera/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace tessera {
namespace {

using test::countBorders;
using test::patchPoint;

// The basis functions at t by the Cox-de Boor recursion, the textbook's definition; the last span is closed.
std::vector<double> basis(const std::vector<double>& knots, std::size_t degree, double t) {
    std::vector<double> values(knots.size() - 1, 0.0);
    std::size_t span = degree;
    for (std::size_t i = degree; i + degree + 1 < knots.size(); ++i)
        if (knots[i] < knots[i + 1] && knots[i] <= t) span = i;
    values[span] = 1.0;
    for (std::size_t p = 1; p <= degree; ++p) {
        for (std::size_t i = 0; i + p + 1 < knots.size(); ++i) {
            const double left = knots[i + p] - knots[i], right = knots[i + p + 1] - knots[i + 1];
            values[i] = (left > 0.0 ? (t - knots[i]) / left * values[i] : 0.0) +
                        (right > 0.0 ? (knots[i + p + 1] - t) / right * values[i + 1] : 0.0);
        }
    }
    values.resize(knots.size() - degree - 1);
    return values;
}

glm::dvec3 evaluated(const Nurbs& surface, double u, double v) {
    const std::vector<double> alongU = basis(surface.uKnots, static_cast<std::size_t>(surface.uDegree), u);
    const std::vector<double> alongV = basis(surface.vKnots, static_cast<std::size_t>(surface.vDegree), v);
    glm::dvec3 sum(0.0);
    double weight = 0.0;
    for (std::size_t k = 0; k < surface.points.size(); ++k) {
        const double share = alongU[k % surface.uCount] * alongV[k / surface.uCount] * (surface.weights.empty() ? 1.0 : surface.weights[k]);
        sum += share * surface.points[k];
        weight += share;
    }
    return sum / weight;
}

// The ends of the spans with length, in order.
std::vector<double> breaks(const std::vector<double>& knots, int degree) {
    const auto ends = static_cast<std::ptrdiff_t>(degree);
    const std::set<double> different(knots.begin() + ends, knots.end() - ends);
    return {different.begin(), different.end()};
}

// Knots at random, some of them multiple, clamped or not.
std::vector<double> randomKnots(reference::Random& random, int degree, std::size_t count, bool clamped) {
    std::vector<double> knots;
    double knot = random.between(-5.0, 5.0);
    const std::size_t order = static_cast<std::size_t>(degree) + 1;
    std::size_t equal = 0;
    for (std::size_t i = 0; i < count + order; ++i) {
        const bool held = clamped && ((i > 0 && i < order) || i > count);
        if (!held && (equal >= static_cast<std::size_t>(degree) || random.unit() < 0.7 || i == order || i == count)) {
            knot += std::exp(random.between(-4.0, 1.0));
            equal = 0;
        }
        ++equal;
        knots.push_back(knot);
    }
    return knots;
}

Nurbs randomSurface(reference::Random& random, int uDegree, int vDegree, bool rational) {
    Nurbs surface;
    surface.name = "random";
    surface.uDegree = uDegree;
    surface.vDegree = vDegree;
    surface.uCount = static_cast<std::size_t>(uDegree) + 1 + static_cast<std::size_t>(random.between(0.0, 6.0));
    const std::size_t rows = static_cast<std::size_t>(vDegree) + 1 + static_cast<std::size_t>(random.between(0.0, 6.0));
    surface.uKnots = randomKnots(random, uDegree, surface.uCount, random.unit() < 0.5);
    surface.vKnots = randomKnots(random, vDegree, rows, random.unit() < 0.5);
    for (std::size_t i = 0; i < surface.uCount * rows; ++i) {
        surface.points.push_back(random.inCube(1.0));
        if (rational) surface.weights.push_back(std::exp(random.between(-2.0, 2.0)));
    }
    return surface;
}

// A cubic tube that is periodic in u, over knots that no binary fraction hits. At its seam and opposite, y is 0 but for rounding: any
// difference between two ways to compute it survives in single precision.
Nurbs periodicTube() {
    constexpr double kEighth = 0.78539816339744831;
    Nurbs tube;
    tube.name = "tube";
    tube.uCount = 11;
    for (int i = 0; i < 15; ++i) tube.uKnots.push_back(0.1 * i + 0.7);
    tube.vKnots = {0, 0, 0, 0, 1, 1, 1, 1};
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 11; ++i) {
            const int eighth = i % 8 - 1;
            tube.points.emplace_back(std::cos(eighth * kEighth), eighth % 4 == 0 ? 0.0 : std::sin(eighth * kEighth), 0.3 * j);
            tube.weights.push_back(i % 2 == 0 ? 1.0 : 1.3);
        }
    }
    return tube;
}

TEST(Nurbs, IsTheSurfaceThatItsBasisFunctionsGive) {
    reference::Random random(11);
    for (int round = 0; round < 270; ++round) {
        const bool rational = round / 9 % 2 == 0;
        const Nurbs surface = randomSurface(random, round % 3 + 1, round / 3 % 3 + 1, rational);
        const Mesh mesh = nurbsMesh(surface);
        const std::vector<double> us = breaks(surface.uKnots, surface.uDegree), vs = breaks(surface.vKnots, surface.vDegree);
        ASSERT_EQ(mesh.kind, rational ? PatchKind::rational : PatchKind::bezier);
        ASSERT_EQ(mesh.patchCount(), (us.size() - 1) * (vs.size() - 1));
        for (std::size_t patch = 0; patch < mesh.patchCount(); ++patch) {
            const std::size_t column = patch % (us.size() - 1), row = patch / (us.size() - 1);
            for (int i = 0; i < 5; ++i) {
                const double s = random.unit(), t = random.unit();
                const double u = us[column] + s * (us[column + 1] - us[column]), v = vs[row] + t * (vs[row + 1] - vs[row]);
                EXPECT_LT(glm::length(patchPoint(mesh, patch, s, t).position - evaluated(surface, u, v)), 1e-6)
                    << surface.uDegree << " x " << surface.vDegree << ", patch " << patch;
            }
        }
    }
}

TEST(Nurbs, PatchesShareTheirBordersToTheBit) {
    reference::Random random(12);
    for (int round = 0; round < 180; ++round) {
        const Nurbs surface = randomSurface(random, round % 3 + 1, round / 3 % 3 + 1, round % 2 == 0);
        const std::size_t columns = breaks(surface.uKnots, surface.uDegree).size() - 1;
        const std::size_t rows = breaks(surface.vKnots, surface.vDegree).size() - 1;
        EXPECT_EQ(countBorders(nurbsMesh(surface)).open, 2 * (columns + rows));
    }
}

TEST(Nurbs, OfAPeriodicKindMeetsItselfToTheBit) {
    const Nurbs tube = periodicTube();
    const Mesh mesh = nurbsMesh(tube);
    ASSERT_EQ(mesh.patchCount(), 8U);
    EXPECT_EQ(countBorders(mesh).open, 16U);

    Nurbs turned = tube;  // the same with u and v exchanged
    std::swap(turned.uKnots, turned.vKnots);
    turned.uCount = 4;
    for (std::size_t k = 0; k < tube.points.size(); ++k) {
        turned.points[k] = tube.points[k % 4 * 11 + k / 4];
        turned.weights[k] = tube.weights[k % 4 * 11 + k / 4];
    }
    EXPECT_EQ(countBorders(nurbsMesh(turned)).open, 16U);

    Nurbs parted = tube;
    parted.points[9].z += 1e-4;  // wrapped, but elsewhere
    EXPECT_EQ(countBorders(nurbsMesh(parted)).open, 18U);
}

TEST(Nurbs, HasPolesThatAreOnePoint) {
    Nurbs cap = periodicTube();
    for (std::size_t i = 0; i < 11; ++i) cap.points[i] = {1.0 + 0x1p-24, 1.0 + 3.0 * 0x1p-24, -0.7};  // halfway between two floats
    const test::Borders borders = countBorders(nurbsMesh(cap));
    EXPECT_EQ(borders.points, 8U);
    EXPECT_EQ(borders.open, 8U);
}

TEST(Nurbs, TearsAtKnotsOfFullMultiplicity) {
    Nurbs torn;
    torn.name = "torn";
    torn.uDegree = 2;
    torn.vDegree = 1;
    torn.uCount = 6;
    torn.uKnots = {0, 0, 0, 1, 1, 1, 2, 2, 2};
    torn.vKnots = {0, 0, 1, 1};
    for (int k = 0; k < 12; ++k) torn.points.emplace_back(k % 6 + (k % 6 > 2 ? 1.0 : 0.0), k / 6, k % 2);
    const Mesh mesh = nurbsMesh(torn);
    ASSERT_EQ(mesh.patchCount(), 2U);
    EXPECT_EQ(countBorders(mesh).open, 8U);
    EXPECT_EQ(mesh.points[3], glm::vec3(torn.points[2]));
    EXPECT_EQ(mesh.points[16], glm::vec3(torn.points[3]));
}

TEST(Nurbs, OfEqualWeightsIsPolynomialAndScalingByTwoChangesNothing) {
    reference::Random random(13);
    Nurbs surface = randomSurface(random, 3, 2, true);
    const Mesh mesh = nurbsMesh(surface);
    for (double& weight : surface.weights) weight *= 0x1p-30;
    const Mesh scaled = nurbsMesh(surface);
    EXPECT_EQ(scaled.points, mesh.points);
    EXPECT_EQ(scaled.weights, mesh.weights);

    surface.weights.assign(surface.weights.size(), 1e-200);
    const Mesh equal = nurbsMesh(surface);
    EXPECT_EQ(equal.kind, PatchKind::bezier);
    EXPECT_TRUE(equal.weights.empty());
    surface.weights.clear();
    const Mesh none = nurbsMesh(surface);
    ASSERT_EQ(none.points.size(), equal.points.size());
    for (std::size_t i = 0; i < none.points.size(); ++i) EXPECT_LT(glm::length(none.points[i] - equal.points[i]), 1e-6F);
}

TEST(Nurbs, GivesWeightsThatAScenePermits) {
    reference::Random random(14);
    for (const double scale : {1e-300, 1e-12, 1.0, 9e3}) {
        Nurbs surface = randomSurface(random, 3, 3, true);
        for (double& weight : surface.weights) weight = scale * std::pow(10.0, random.between(-4.9, 4.9));
        EXPECT_NO_THROW(reference::sceneOf({nurbsMesh(surface)}).validate()) << scale;
    }
}

struct Damage {
    std::function<void(Nurbs&)> apply;
    std::vector<std::string> said;
};

TEST(Nurbs, RefusesWhatIsNoSurfaceByName) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Damage> damages{
        {[](Nurbs& s) { s.uDegree = 0; }, {"u degree is 0"}},
        {[](Nurbs& s) { s.vDegree = 4; }, {"v degree is 4"}},
        {[](Nurbs& s) { s.uCount = 0; }, {"uCount is 0"}},
        {[](Nurbs& s) { s.points.pop_back(); }, {"43 points", "11"}},
        {[](Nurbs& s) { s.points.clear(); }, {"0 points along v"}},
        {[](Nurbs& s) { s.points.resize(33); }, {"3 points along v", "at least 4"}},
        {[](Nurbs& s) { s.uKnots.pop_back(); }, {"14 knots along u", "15"}},
        {[](Nurbs& s) { s.uKnots.clear(); }, {"0 knots along u"}},
        {[](Nurbs& s) { s.vKnots.push_back(1.0); }, {"9 knots along v", "8"}},
        {[](Nurbs& s) { s.uKnots[5] = 0.0; }, {"u knot 5", "fall"}},
        {[](Nurbs& s) { s.uKnots[5] = kNan; }, {"u knot 5", "nan"}},
        {[](Nurbs& s) { std::fill(s.uKnots.begin() + 3, s.uKnots.begin() + 8, 1.5); }, {"u knot 7", "1.5", "at most 4"}},
        {[](Nurbs& s) { s.vKnots = {0, 1, 2, 3, 3, 4, 5, 6}; }, {"v knots", "all 3"}},
        {[](Nurbs& s) { s.weights.pop_back(); }, {"43 weights", "44"}},
        {[](Nurbs& s) { s.weights[7] = 0.0; }, {"weight 7", "0"}},
        {[](Nurbs& s) { s.weights[7] = -1.0; }, {"weight 7", "-1"}},
        {[](Nurbs& s) { s.weights[7] = kNan; }, {"weight 7", "nan"}},
        {[](Nurbs& s) { s.weights[7] = 1e-300; }, {"1e-300", "1e10"}},
        {[](Nurbs& s) { s.points[9].y = kNan; }, {"point 9", "nan"}},
        {[](Nurbs& s) { s.points[9].y = 1e10; }, {"point 9", "1e+10"}},
    };
    for (const Damage& damage : damages) {
        Nurbs surface = periodicTube();
        damage.apply(surface);
        try {
            static_cast<void>(nurbsMesh(surface));
            ADD_FAILURE() << damage.said.front() << " is taken";
        } catch (const Error& error) {
            const std::string message = error.what();
            EXPECT_EQ(message.rfind("NURBS 'tube': ", 0), 0U) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos);
            for (const std::string& part : damage.said) EXPECT_NE(message.find(part), std::string::npos) << message;
        }
    }
}

}  // namespace
}  // namespace tessera
