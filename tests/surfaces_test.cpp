// Quadrics, tori and bilinear quads: exact, closed to the bit, facing outward; and what they refuse.
#include "tessera/surfaces.h"

#include "exact_patches.h"
#include "reference/sample_meshes.h"
#include "tessera/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace tessera {
namespace {

using test::countBorders;
using test::joined;
using test::patchPoint;
using test::SurfacePoint;

constexpr double kPi = 3.14159265358979323846;
constexpr double kSingle = 3e-7;  // what rounding to single precision may do, of the surface's size

double axisDistance(const glm::dvec3& p) { return std::hypot(p.x, p.y); }

// A surface, the function that is 0 on it and grows outward at a rate near 1, its rise and its size.
struct Shape {
    const char* name;
    std::function<Mesh(double)> make;  // from thetaMax
    std::function<double(const glm::dvec3&)> outside;
    double low, high;
    double size;
};

std::vector<Shape> shapes() {
    const auto ring = [](const glm::dvec3& p) { return std::hypot(axisDistance(p) - 2.1, p.z) - 0.7; };
    // The line through (1, 0.4, -1) and (0.2, -1.3, 2), turned.
    const auto waist = [](const glm::dvec3& p) {
        const double v = (p.z + 1.0) / 3.0;
        return axisDistance(p) - std::hypot(1.0 - 0.8 * v, 0.4 - 1.7 * v);
    };
    return {
        {"sphere", [](double t) { return sphere("s", 1.3, -1.3, 1.3, t); }, [](auto& p) { return glm::length(p) - 1.3; }, -1.3, 1.3, 1.3},
        {"zone", [](double t) { return sphere("s", 1.3, -0.9, 1.1, t); }, [](auto& p) { return glm::length(p) - 1.3; }, -0.9, 1.1, 1.3},
        {"cap", [](double t) { return sphere("s", 1.3, 1.0, 7.0, t); }, [](auto& p) { return glm::length(p) - 1.3; }, 1.0, 1.3, 1.3},
        {"cone", [](double t) { return cone("c", 2.0, 0.9, t); }, [](auto& p) { return axisDistance(p) - 0.9 * (1.0 - p.z / 2.0); }, 0.0,
         2.0, 2.0},
        {"cylinder", [](double t) { return cylinder("c", 0.7, -2.0, 1.1, t); }, [](auto& p) { return axisDistance(p) - 0.7; }, -2.0, 1.1,
         2.0},
        {"hyperboloid",
         [](double t) {
             return hyperboloid("h", {1.0, 0.4, -1.0}, {0.2, -1.3, 2.0}, t);
         },
         waist, -1.0, 2.0, 2.0},
        {"paraboloid", [](double t) { return paraboloid("p", 1.7, 0.0, 2.3, t); },
         [](auto& p) { return axisDistance(p) - 1.7 * std::sqrt(std::max(p.z, 0.0) / 2.3); }, 0.0, 2.3, 2.3},
        {"parabolic band", [](double t) { return paraboloid("p", 1.7, 0.4, 2.3, t); },
         [](auto& p) { return axisDistance(p) - 1.7 * std::sqrt(p.z / 2.3); }, 0.4, 2.3, 2.3},
        {"disk", [](double t) { return disk("d", 0.3, 1.9, t); }, [](auto& p) { return p.z - 0.3; }, 0.3, 0.3, 1.9},
        {"torus", [](double t) { return torus("t", 2.1, 0.7, 0.0, 360.0, t); }, ring, -0.7, 0.7, 2.8},
        {"part of a torus", [](double t) { return torus("t", 2.1, 0.7, -30.0, 200.0, t); }, ring, -0.35, 0.7, 2.8},
    };
}

const std::vector<double>& sweeps() {
    static const std::vector<double> angles{360.0, -360.0, 270.0, 90.0, 1.5, -47.0, 123.4, 359.9};
    return angles;
}

// The angle of `p` from the x axis in the direction of the sweep, 0 to 360.
double angleAlong(const glm::dvec3& p, double sweep) {
    const double degrees = std::atan2(sweep < 0.0 ? -p.y : p.y, p.x) * 180.0 / kPi;
    return degrees < 0.0 ? degrees + 360.0 : degrees;
}

TEST(Quadrics, LieOnTheirSurfaceWithinTheirSweepFacingOutward) {
    reference::Random random(1);
    for (const Shape& shape : shapes()) {
        for (const double sweep : sweeps()) {
            const Mesh mesh = shape.make(sweep);
            ASSERT_EQ(mesh.kind, PatchKind::rational);
            ASSERT_EQ(mesh.weights.size(), mesh.points.size());
            const bool twisted = std::string(shape.name) == "hyperboloid";
            for (int i = 0; i < 200; ++i) {
                const std::size_t patch = static_cast<std::size_t>(i) % mesh.patchCount();
                const SurfacePoint p = patchPoint(mesh, patch, random.unit(), random.between(0.02, 0.98));
                const double tolerance = kSingle * shape.size;
                // A paraboloid's steep apex turns what rounding does to z into more.
                const double steep = std::string(shape.name) == "paraboloid" ? 100.0 : 1.0;
                EXPECT_NEAR(shape.outside(p.position), 0.0, steep * tolerance) << shape.name << " " << sweep;
                EXPECT_GE(p.position.z, shape.low - tolerance) << shape.name;
                EXPECT_LE(p.position.z, shape.high + tolerance) << shape.name;
                const double angle = angleAlong(p.position, sweep);
                EXPECT_TRUE(twisted || angle <= std::abs(sweep) + 1e-4 || angle > 359.9999) << shape.name << " " << sweep;
                const glm::dvec3 out = p.position + 1e-3 * glm::normalize(p.normal()) * (sweep < 0.0 ? -1.0 : 1.0);
                EXPECT_GT(shape.outside(out), 1e-4) << shape.name << " " << sweep;
            }
        }
    }
}

TEST(Quadrics, CoverAsMuchAreaAsTheirSweepIsLong) {
    for (const Shape& shape : shapes()) {
        const double whole = test::area(shape.make(360.0), 60);
        for (const double sweep : sweeps()) {
            EXPECT_NEAR(test::area(shape.make(sweep), 60) / whole, std::abs(sweep) / 360.0, 1e-3) << shape.name << " " << sweep;
        }
    }
    EXPECT_NEAR(test::area(sphere("s", 1.3, -0.9, 1.1), 60), 2.0 * kPi * 1.3 * 2.0, 2e-3);
    EXPECT_NEAR(test::area(torus("t", 2.1, 0.7), 60), 4.0 * kPi * kPi * 2.1 * 0.7, 2e-2);
}

struct Solid {
    const char* name;
    Mesh mesh;
    double volume;
    std::size_t poles;  // borders that are a point
};

TEST(Quadrics, CloseToSolidsToTheBit) {
    const double rim = std::sqrt(1.1 * 1.1 - 0.37 * 0.37);
    const std::vector<Solid> solids{
        {"sphere", sphere("s", 1.1, -1.1, 1.1), 4.0 / 3.0 * kPi * 1.331, 8},
        {"torus", torus("t", 1.7, 0.3), 2.0 * kPi * kPi * 1.7 * 0.09, 0},
        {"torus from elsewhere", torus("t", 1.7, 0.3, 0.1, 360.1, -360.0), -2.0 * kPi * kPi * 1.7 * 0.09, 0},
        {"can", joined({cylinder("c", 0.7, 0.1, 1.3), disk("d", 1.3, 0.7), disk("d", 0.1, 0.7, -360.0)}), kPi * 0.49 * 1.2, 8},
        {"cone", joined({cone("c", 1.9, 0.7), disk("d", 0.0, 0.7, -360.0)}), kPi * 0.49 * 1.9 / 3.0, 8},
        {"cut ball", joined({sphere("s", 1.1, -0.37, 1.1), disk("d", -0.37, rim, -360.0)}), kPi * 1.47 * 1.47 * (3.3 - 1.47) / 3.0, 8},
        {"bullet", joined({paraboloid("p", 0.7, 0.0, 1.3), disk("d", 1.3, 0.7)}), kPi * 0.49 * 1.3 / 2.0, 8},
    };
    for (const Solid& solid : solids) {
        const test::Borders borders = countBorders(solid.mesh);
        EXPECT_EQ(borders.open, 0U) << solid.name;
        EXPECT_EQ(borders.crowded, 0U) << solid.name;
        EXPECT_EQ(borders.points, solid.poles) << solid.name;
        EXPECT_NEAR(test::volume(solid.mesh, 60) / solid.volume, 1.0, 1e-3) << solid.name;
    }
}

TEST(Quadrics, CloseWhereTheTurnIsWholeButForRounding) {
    for (const double sweep : {360.0 + 5e-10, 360.0 - 5e-10, -360.0 - 5e-10}) {
        EXPECT_EQ(countBorders(torus("t", 1.7, 0.3, 0.0, 360.0, sweep)).open, 0U) << sweep;
        EXPECT_EQ(countBorders(torus("t", 1.7, 0.3, -180.0, std::abs(sweep) - 180.0)).open, 0U) << sweep;
    }
}

// Halfway between two numbers of single precision: the least error beforehand changes what it is rounded to.
double halfway(double value) {
    const auto near = static_cast<float>(value);
    return (static_cast<double>(near) + static_cast<double>(std::nextafter(near, 2e9F))) / 2.0;
}

TEST(Quadrics, ShareRimsOfAnyRadiusHeightAndSweep) {
    reference::Random random(2);
    for (int i = 0; i < 300; ++i) {
        const double radius = halfway(std::exp(random.between(-3.0, 3.0)));
        const double low = halfway(random.between(-2.0, 2.0)), high = halfway(low + random.between(0.1, 3.0));
        const double sweep = i % 3 == 0 ? 360.0 : random.between(-360.0, 360.0), cut = halfway(radius * random.between(-0.99, 0.5));
        const double rim = std::sqrt(radius * radius - cut * cut);
        const std::vector<std::array<Mesh, 2>> pairs{
            {cylinder("c", radius, low, high, sweep), disk("d", low, radius, sweep)},
            {cylinder("c", radius, low, high, sweep), disk("d", high, radius, sweep)},
            {cone("c", high + 3.0, radius, sweep), disk("d", 0.0, radius, sweep)},
            {paraboloid("p", radius, 0.0, high + 3.0, sweep), disk("d", high + 3.0, radius, sweep)},
            {sphere("s", radius, cut, radius, sweep), disk("d", cut, rim, sweep)},
            {sphere("s", radius, cut, radius, sweep), cylinder("c", rim, cut - 1.0, cut, sweep)},
        };
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            const auto& [one, other] = pairs[k];
            const std::size_t apart = countBorders(one).open + countBorders(other).open;
            const std::size_t shared = static_cast<std::size_t>(std::max(1.0, std::ceil(std::abs(sweep) / 90.0)));
            EXPECT_EQ(countBorders(joined({one, other})).open, apart - 2 * shared) << "pair " << k << ", sweep " << sweep;
        }
    }
}

TEST(Quadrics, AreExactOnTheAxesWithoutNegativeZeros) {
    for (const Shape& shape : shapes()) {
        if (std::string(shape.name) == "hyperboloid") continue;
        const Mesh mesh = shape.make(360.0);
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
            const glm::vec3& p = mesh.points[i];
            EXPECT_FALSE((p.x == 0.0F && std::signbit(p.x)) || (p.y == 0.0F && std::signbit(p.y)) || (p.z == 0.0F && std::signbit(p.z)));
            if (i % 4 != 0 && i % 4 != 3) continue;
            EXPECT_TRUE(p.x == 0.0F || p.y == 0.0F) << shape.name << " point " << i << ": " << p.x << " " << p.y;
        }
    }
    const Mesh ball = sphere("s", 1.0, -1.0, 1.0);
    EXPECT_EQ(ball.points[0], glm::vec3(0, 0, -1));
    EXPECT_EQ(ball.points[12], glm::vec3(1, 0, 0));
    EXPECT_EQ(ball.points[15], glm::vec3(0, 1, 0));
}

TEST(Quadrics, HaveWeightOneAtCornersAndWeightsBelowIt) {
    for (const Shape& shape : shapes()) {
        for (const double sweep : sweeps()) {
            const Mesh mesh = shape.make(sweep);
            for (std::size_t i = 0; i < mesh.weights.size(); ++i) {
                const bool corner = (i % 4 == 0 || i % 4 == 3) && (i / 4 % 4 == 0 || i / 4 % 4 == 3);
                EXPECT_GE(mesh.weights[i], corner ? 1.0F : 0.64F) << shape.name;
                EXPECT_LE(mesh.weights[i], 1.0F) << shape.name;
            }
        }
    }
}

struct Refusal {
    std::function<Mesh()> make;
    std::vector<std::string> said;
};

TEST(Quadrics, RefuseWhatGivesNoSurfaceByName) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
    const std::vector<Refusal> refusals{
        {[] { return sphere("ball", 0.0, -1, 1); }, {"sphere 'ball'", "radius 0"}},
        {[] { return sphere("ball", kNan, -1, 1); }, {"sphere 'ball'", "radius nan"}},
        {[] { return sphere("ball", 1.0, 0.5, 0.5); }, {"sphere 'ball'", "zMin 0.5", "zMax 0.5"}},
        {[] { return sphere("ball", 1.0, 1.0, 2.0); }, {"sphere 'ball'", "zMin 1", "zMax 2"}},
        {[] { return sphere("ball", 1.0, -1, kInfinity); }, {"sphere 'ball'", "zMax inf"}},
        {[] { return sphere("ball", 1.0, -1, 1, 0.0); }, {"sphere 'ball'", "thetaMax 0"}},
        {[] { return cone("hat", 0.0, 1.0); }, {"cone 'hat'", "height 0"}},
        {[] { return cone("hat", 1.0, -1.0); }, {"cone 'hat'", "radius -1"}},
        {[] { return cylinder("can", 1.0, 1.0, 0.0); }, {"cylinder 'can'", "zMin 1", "zMax 0"}},
        {[] { return cylinder("can", 1.0, 0.0, 1.0, 361.0); }, {"cylinder 'can'", "thetaMax 361"}},
        {[] {
             return hyperboloid("waist", {1, 2, 3}, {1, 2, 3});
         },
         {"hyperboloid 'waist'", "point1", "point2"}},
        {[] {
             return hyperboloid("waist", {0, 0, 3}, {0, 0, 4});
         },
         {"hyperboloid 'waist'", "z axis"}},
        {[] {
             return hyperboloid("waist", {0, kNan, 3}, {0, 0, 4});
         },
         {"hyperboloid 'waist'", "point1 nan"}},
        {[] { return paraboloid("bowl", 1.0, -1.0, 1.0); }, {"paraboloid 'bowl'", "zMin -1"}},
        {[] { return paraboloid("bowl", 1e300, 0.0, 1.0); }, {"paraboloid 'bowl'", "radiusAtMax 1e+300"}},
        {[] { return disk("lid", kNan, 1.0); }, {"disk 'lid'", "height nan"}},
        {[] { return torus("ring", 1.0, 0.0); }, {"torus 'ring'", "minorRadius 0"}},
        {[] { return torus("ring", 1.0, 0.5, 10.0, 10.0); }, {"torus 'ring'", "phiMin 10", "phiMax 10"}},
        {[] { return torus("ring", 1.0, 0.5, 0.0, 400.0); }, {"torus 'ring'", "phiMax - phiMin 400"}},
    };
    for (const Refusal& refusal : refusals) {
        try {
            static_cast<void>(refusal.make());
            ADD_FAILURE() << refusal.said.front() << ", " << refusal.said.back() << " is taken";
        } catch (const Error& error) {
            const std::string message = error.what();
            EXPECT_EQ(message.find('\n'), std::string::npos);
            for (const std::string& part : refusal.said) EXPECT_NE(message.find(part), std::string::npos) << message;
        }
    }
}

TEST(Bilinear, IsTheBilinearBlendOfItsCorners) {
    reference::Random random(3);
    for (int i = 0; i < 100; ++i) {
        std::array<glm::vec3, 4> quad{};
        for (glm::vec3& corner : quad) corner = glm::vec3(random.inCube(1.0));
        const Mesh mesh = bilinearMesh("q", std::vector{quad});
        ASSERT_EQ(mesh.kind, PatchKind::bezier);
        const double u = random.unit(), v = random.unit();
        const glm::dvec3 expected = (1.0 - v) * ((1.0 - u) * glm::dvec3(quad[0]) + u * glm::dvec3(quad[1])) +
                                    v * ((1.0 - u) * glm::dvec3(quad[3]) + u * glm::dvec3(quad[2]));
        EXPECT_LT(glm::length(patchPoint(mesh, 0, u, v).position - expected), kSingle);
        EXPECT_EQ(mesh.points[0], quad[0]);
        EXPECT_EQ(mesh.points[3], quad[1]);
        EXPECT_EQ(mesh.points[15], quad[2]);
        EXPECT_EQ(mesh.points[12], quad[3]);
    }
}

TEST(Bilinear, QuadsShareBordersHoweverTheyAreTurned) {
    reference::Random random(4);
    for (int i = 0; i < 200; ++i) {
        std::array<glm::vec3, 6> p{};
        for (glm::vec3& corner : p) corner = glm::vec3(random.inCube(std::exp(random.between(-9.0, 9.0))));
        std::array<glm::vec3, 4> left{p[0], p[1], p[2], p[3]}, right{p[2], p[1], p[4], p[5]};
        std::rotate(left.begin(), left.begin() + i % 4, left.end());
        std::rotate(right.begin(), right.begin() + i / 4 % 4, right.end());
        EXPECT_EQ(countBorders(bilinearMesh("q", std::vector{left, right})).open, 6U);
    }
    EXPECT_EQ(bilinearMesh("none", {}).patchCount(), 0U);
}

}  // namespace
}  // namespace tessera
