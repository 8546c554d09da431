// Surfaces that artists and CAD programs know, as exact patches: quadrics and tori (rational bicubic), NURBS, bilinear quads.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <span>
#include <string>
#include <vector>

#include "tessera/scene.h"

namespace tessera {

// RenderMan's quadrics and their parameters (RenderMan Interface Specification 3.2, section 5.5): around the z axis, swept by `thetaMax`
// degrees (non-zero, -360 to 360) from the x axis. u runs with the angle, v along the profile; du x dv points outward for positive sweeps,
// of a disk along +z, of a hyperboloid where point1 is the lower. Whole sweeps close to the bit, poles are degenerate borders with all
// points equal, and rims of the same radius, height and sweep are equal to the bit, so that a disk closes a cylinder, a cone, a paraboloid
// or a sphere cut at z (whose rim has the radius sqrt(radius * radius - z * z)). Weights are 1 at patch corners. All throw Error, naming
// `name` and the parameter, on values that are not finite or beyond 1e9, or give no surface: radii and a cone's height must be above 0,
// z and phi must rise, a paraboloid's zMin is at least 0.
[[nodiscard]] Mesh sphere(std::string name, double radius, double zMin, double zMax, double thetaMax = 360.0);  // |z| clamped to radius
[[nodiscard]] Mesh cone(std::string name, double height, double radius, double thetaMax = 360.0);               // apex at z = height
[[nodiscard]] Mesh cylinder(std::string name, double radius, double zMin, double zMax, double thetaMax = 360.0);
[[nodiscard]] Mesh hyperboloid(std::string name, const glm::dvec3& point1, const glm::dvec3& point2, double thetaMax = 360.0);
[[nodiscard]] Mesh paraboloid(std::string name, double radiusAtMax, double zMin, double zMax, double thetaMax = 360.0);
[[nodiscard]] Mesh disk(std::string name, double height, double radius, double thetaMax = 360.0);
[[nodiscard]] Mesh torus(std::string name, double majorRadius, double minorRadius, double phiMin = 0.0, double phiMax = 360.0,
                         double thetaMax = 360.0);

// A NURBS surface. Points lie row by row: point (i, j) of u and v at j * uCount + i, in whole rows.
struct Nurbs {
    std::string name;
    int uDegree = 3;  // 1 to 3
    int vDegree = 3;
    std::vector<double> uKnots;  // uCount + uDegree + 1, not falling; the surface is over [knots[degree], knots[count]]
    std::vector<double> vKnots;  // the same for the number of rows
    std::size_t uCount = 0;      // points along u, above the degree
    std::vector<glm::dvec3> points;
    std::vector<double> weights;  // one a point, above 0; empty: all 1
};

// The same surface as bicubic patches, rational unless all weights are equal, by knot insertion and degree elevation (Piegl and Tiller,
// "The NURBS Book", 1997, chapter 5). Neighbouring patches share their borders to the bit, also across a seam where the surface meets
// itself; a border that is one point is one to the bit. Knots of full multiplicity inside are allowed, and tear the surface. Weights are
// scaled by a power of two, so that they lie around 1. Throws Error naming the surface: degrees, counts, knots that fall or are too few,
// too many equal knots, no area in the knots, weights not above 0 or further apart than 1e10, values that are not finite or beyond 1e9.
[[nodiscard]] Mesh nurbsMesh(const Nurbs& surface);

// Quadrilaterals as bicubic patches that are bilinear in (u, v), corners at (0, 0), (1, 0), (1, 1), (0, 1). Quads with the same corners
// share their borders to the bit.
[[nodiscard]] Mesh bilinearMesh(std::string name, std::span<const std::array<glm::vec3, 4>> quads);

}  // namespace tessera
