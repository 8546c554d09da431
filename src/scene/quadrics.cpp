// Spheres, cones, cylinders, hyperboloids, paraboloids, disks and tori as exact rational patches: a profile, turned about the z axis.
// What two patches share is computed once, in double precision, and rounded once: it is the same to the bit.
#include "scene/surface_numbers.h"
#include "tessera/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace tessera {

namespace {

constexpr double kPi = 3.14159265358979323846;

// A point of a curve and its weight. Of a circle only x and y are used.
struct Control {
    glm::dvec3 point{0.0};
    double weight = 1.0;
};

// A rational cubic Bezier curve. Ends have weight 1.
using Cubic = std::array<Control, 4>;

// Degree 2 to 3 (Farin, "NURBS", 1999); `middle` has its weight, the ends have weight 1.
Cubic elevated(const glm::dvec3& start, const Control& middle, const glm::dvec3& end) {
    const double pull = 2.0 * middle.weight;
    const double weight = (1.0 + pull) / 3.0;
    return {Control{start}, Control{(start + pull * middle.point) / (1.0 + pull), weight},
            Control{(pull * middle.point + end) / (1.0 + pull), weight}, Control{end}};
}

Cubic line(const glm::dvec3& start, const glm::dvec3& end) {
    return {Control{start}, Control{(2.0 * start + end) / 3.0}, Control{(start + 2.0 * end) / 3.0}, Control{end}};
}

// The arc of the unit circle around the origin between two of its points, at most a quarter: its middle control point lies where the
// tangents meet.
Cubic unitArc(const glm::dvec3& start, const glm::dvec3& end) {
    const double cosine = glm::dot(start, end);
    return elevated(start, {(start + end) / (1.0 + cosine), std::sqrt((1.0 + cosine) / 2.0)}, end);
}

// (cos, sin, 0), exact on the axes, the same for angles that differ by whole turns.
glm::dvec3 unitPoint(double degrees) {
    int quarters = 0;
    const double rest = std::remquo(degrees, 90.0, &quarters);
    const double cosine = std::cos(rest * kPi / 180.0), sine = std::sin(rest * kPi / 180.0);
    // remquo promises the quotient's low three bits, in its sign.
    switch (((quarters % 4) + 4) % 4) {
        case 0:
            return {cosine, sine, 0.0};
        case 1:
            return {-sine, cosine, 0.0};
        case 2:
            return {-cosine, -sine, 0.0};
        default:
            return {sine, -cosine, 0.0};
    }
}

std::size_t quarterCount(double degrees) { return static_cast<std::size_t>(std::max(1.0, std::ceil(std::abs(degrees) / 90.0 - 1e-9))); }

bool isWholeTurn(double degrees) { return std::abs(std::abs(degrees) - 360.0) <= 1e-9; }

// The unit circle from one angle to another, in equal arcs of at most a quarter. A whole turn ends in the bits that it began with.
std::vector<Cubic> unitArcs(double fromDegrees, double toDegrees) {
    const double sweep = toDegrees - fromDegrees;
    const std::size_t count = quarterCount(sweep);
    std::vector<Cubic> arcs;
    const glm::dvec3 first = unitPoint(fromDegrees);
    glm::dvec3 start = first;
    for (std::size_t i = 1; i <= count; ++i) {
        const double angle = fromDegrees + sweep * static_cast<double>(i) / static_cast<double>(count);
        const glm::dvec3 end = i == count && isWholeTurn(sweep) ? first : unitPoint(i == count ? toDegrees : angle);
        arcs.push_back(unitArc(start, end));
        start = end;
    }
    return arcs;
}

// The patches that a profile sweeps: u runs with the angle, v along the profile.
Mesh swept(std::string name, const std::vector<Cubic>& profile, double thetaMax) {
    Mesh mesh;
    mesh.name = std::move(name);
    mesh.kind = PatchKind::rational;
    const std::vector<Cubic> arcs = unitArcs(0.0, thetaMax);
    mesh.points.reserve(16 * arcs.size() * profile.size());
    mesh.weights.reserve(16 * arcs.size() * profile.size());
    for (const Cubic& along : profile) {
        for (const Cubic& arc : arcs) {
            for (std::size_t i = 0; i < 16; ++i) {
                const auto& [turn, turnWeight] = arc[i % 4];
                const auto& [p, weight] = along[i / 4];
                mesh.points.push_back(rounded({p.x * turn.x - p.y * turn.y, p.x * turn.y + p.y * turn.x, p.z}));
                mesh.weights.push_back(static_cast<float>(weight * turnWeight));
            }
        }
    }
    return mesh;
}

void requireSweep(const SurfaceLabel& label, std::string_view parameter, double degrees) {
    label.requireFinite(parameter, degrees);
    if (degrees == 0.0) label.fail(std::string(parameter) + " 0 gives no surface; give an angle in degrees, 360 for all of it");
    if (std::abs(degrees) <= 360.0 || isWholeTurn(degrees)) return;
    label.fail(std::string(parameter) + " " + numberText(degrees) + " is more than a whole turn; give -360 to 360 degrees");
}

// A circle's arcs in the plane y = 0, scaled and moved.
std::vector<Cubic> asProfile(std::vector<Cubic> arcs, double radius, double fromAxis) {
    for (Cubic& arc : arcs) {
        for (Control& control : arc) control.point = {fromAxis + radius * control.point.x, 0.0, radius * control.point.y};
    }
    return arcs;
}

// The half circle from height `low` to `high`. Its ends are the very heights, and sqrt(radius^2 - height^2) from the axis.
std::vector<Cubic> sphereProfile(double radius, double low, double high) {
    const auto onCircle = [&](double height) {
        return glm::dvec3(std::sqrt(std::max(0.0, radius * radius - height * height)), 0.0, height);
    };
    const glm::dvec3 start = onCircle(low), end = onCircle(high);
    const auto unit = [&](const glm::dvec3& p) { return glm::dvec3(p.x / radius, p.z / radius, 0.0); };
    const double from = std::asin(low / radius), to = std::asin(high / radius);
    std::vector<Cubic> arcs;
    if (quarterCount((to - from) * 180.0 / kPi) == 1) {
        arcs = {unitArc(unit(start), unit(end))};
    } else {
        const double half = (from + to) / 2.0;
        const glm::dvec3 middle(std::cos(half), std::sin(half), 0.0);
        arcs = {unitArc(unit(start), middle), unitArc(middle, unit(end))};
    }
    std::vector<Cubic> profile = asProfile(std::move(arcs), radius, 0.0);
    profile.front().front().point = start;
    profile.back().back().point = end;
    return profile;
}

}  // namespace

Mesh sphere(std::string name, double radius, double zMin, double zMax, double thetaMax) {
    const SurfaceLabel label{"sphere", name};
    label.requirePositive("radius", radius);
    label.requireRising("zMin", zMin, "zMax", zMax);
    const double low = std::clamp(zMin, -radius, radius), high = std::clamp(zMax, -radius, radius);
    if (low == high)
        label.fail("zMin " + numberText(zMin) + " to zMax " + numberText(zMax) + " misses the sphere; give part of -radius to radius");
    requireSweep(label, "thetaMax", thetaMax);
    return swept(std::move(name), sphereProfile(radius, low, high), thetaMax);
}

Mesh cone(std::string name, double height, double radius, double thetaMax) {
    const SurfaceLabel label{"cone", name};
    label.requirePositive("height", height);
    label.requirePositive("radius", radius);
    requireSweep(label, "thetaMax", thetaMax);
    return swept(std::move(name), {line({radius, 0.0, 0.0}, {0.0, 0.0, height})}, thetaMax);
}

Mesh cylinder(std::string name, double radius, double zMin, double zMax, double thetaMax) {
    const SurfaceLabel label{"cylinder", name};
    label.requirePositive("radius", radius);
    label.requireRising("zMin", zMin, "zMax", zMax);
    requireSweep(label, "thetaMax", thetaMax);
    return swept(std::move(name), {line({radius, 0.0, zMin}, {radius, 0.0, zMax})}, thetaMax);
}

Mesh hyperboloid(std::string name, const glm::dvec3& point1, const glm::dvec3& point2, double thetaMax) {
    const SurfaceLabel label{"hyperboloid", name};
    for (int axis = 0; axis < 3; ++axis) {
        label.requireFinite("point1", point1[axis]);
        label.requireFinite("point2", point2[axis]);
    }
    if (point1 == point2) label.fail("point1 and point2 are the same, which gives no surface; move one of them");
    if (point1.x == 0.0 && point1.y == 0.0 && point2.x == 0.0 && point2.y == 0.0) {
        label.fail("point1 and point2 both lie on the z axis, which gives no surface; move one of them");
    }
    requireSweep(label, "thetaMax", thetaMax);
    return swept(std::move(name), {line(point1, point2)}, thetaMax);
}

Mesh paraboloid(std::string name, double radiusAtMax, double zMin, double zMax, double thetaMax) {
    const SurfaceLabel label{"paraboloid", name};
    label.requirePositive("radiusAtMax", radiusAtMax);
    label.requireRising("zMin", zMin, "zMax", zMax);
    if (zMin < 0.0) label.fail("zMin " + numberText(zMin) + " is below the apex at 0; give 0 or more");
    requireSweep(label, "thetaMax", thetaMax);
    // z is a quadratic polynomial of the radius: its middle control point is its blossom at the two ends.
    const double start = radiusAtMax * std::sqrt(zMin / zMax);
    const glm::dvec3 middle((start + radiusAtMax) / 2.0, 0.0, std::sqrt(zMin) * std::sqrt(zMax));
    return swept(std::move(name), {elevated({start, 0.0, zMin}, {middle, 1.0}, {radiusAtMax, 0.0, zMax})}, thetaMax);
}

Mesh disk(std::string name, double height, double radius, double thetaMax) {
    const SurfaceLabel label{"disk", name};
    label.requireFinite("height", height);
    label.requirePositive("radius", radius);
    requireSweep(label, "thetaMax", thetaMax);
    return swept(std::move(name), {line({radius, 0.0, height}, {0.0, 0.0, height})}, thetaMax);
}

Mesh torus(std::string name, double majorRadius, double minorRadius, double phiMin, double phiMax, double thetaMax) {
    const SurfaceLabel label{"torus", name};
    label.requirePositive("majorRadius", majorRadius);
    label.requirePositive("minorRadius", minorRadius);
    label.requireRising("phiMin", phiMin, "phiMax", phiMax);
    requireSweep(label, "phiMax - phiMin", phiMax - phiMin);
    requireSweep(label, "thetaMax", thetaMax);
    return swept(std::move(name), asProfile(unitArcs(phiMin, phiMax), minorRadius, majorRadius), thetaMax);
}

}  // namespace tessera
