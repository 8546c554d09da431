// The surfaces in double precision: positions, exact first derivatives and normals of every kind of patch.
// Written from the definitions, apart from the kernels, so that tests have something to hold these against.
//
// Bezier: 16 points, number 4 v + u of the bicubic net.
// Rational: 16 points as for Bezier and a weight above 0 for each: sum of (weight x Bernstein x point) over sum of (weight x Bernstein).
//
// PN triangle (Vlachos, Peters, Boyd, Mitchell 2001), w = 1 - u - v: the cubic triangle sum of 3! / (i! j! k!) u^i v^j w^k P(i, j),
// i + j + k = 3, over u, v, w >= 0; P(i, j) is point i of row j, the rows beginning at points 0, 4, 7 and 9. For shading alone, after
// these ten positions, six normals N(i, j) in rows that begin at 10, 13 and 15: sum of u^i v^j w^k N(i, j), i + j + k = 2, without
// binomial factors, as that paper has it.
//
// Gregory (Loop, Schaefer, Ni, Castano 2009): 20 points p0..p3, e+0..e+3, e-0..e-3, f+0..f+3, f-0..f-3. Corners go around:
// p0 at (u, v) = (0, 0), p1 (1, 0), p2 (1, 1), p3 (0, 1). e+i lies on the border from corner i to the next one,
// e-i on the border to the one before; f+i and f-i are the face points beside those borders. At each (u, v) the surface
// is the bicubic patch over this net (index into the 20 points in brackets):
//
//              u = 0       1          2          3
//     v = 0    p0  [0]    e+0 [4]    e-1 [9]    p1  [1]
//         1    e-0 [8]    F0         F1         e+1 [5]
//         2    e+3 [7]    F3         F2         e-2 [10]
//         3    p3  [3]    e-3 [11]   e+2 [6]    p2  [2]
//
//     F0 = (     u f+0 +       v f-0) / (u + v)             f+i = [12 + i], f-i = [16 + i]
//     F1 = (     v f+1 + (1 - u) f-1) / ((1 - u) + v)
//     F2 = ((1 - u) f+2 + (1 - v) f-2) / ((1 - u) + (1 - v))
//     F3 = ((1 - v) f+3 +      u f-3) / (u + (1 - v))
//
// where 0/0 counts as 0: it stands at the blend's own corner only, where its Bernstein weight and the derivatives of the
// product vanish. On each border F depends on that border's own face points alone, which is what joins patches smoothly.
#pragma once

#include "tessera/scene.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace tessera::reference {

using Points = std::span<const glm::dvec3>;  // pointsPerPatch(kind) points; of a pn triangle its positions alone will do
using Weights = std::span<const double>;     // of a rational patch, one a point; empty: all 1
using Net = std::array<glm::dvec3, 16>;      // of a bicubic patch, number 4 v + u

struct SurfacePoint {
    glm::dvec3 position{0.0};
    glm::dvec3 du{0.0};  // first derivatives
    glm::dvec3 dv{0.0};
};

// The four cubic Bernstein polynomials at one parameter and their first derivatives.
struct Bernstein {
    std::array<double, 4> value{};
    std::array<double, 4> slope{};
};
[[nodiscard]] Bernstein bernstein(double t);

// How the face points of one corner blend at (u, v): F = plus f+ + minus f-. plus + minus = 1, but both are 0 at the corner.
struct Blend {
    double plus = 0.0;
    double minus = 0.0;
    double plusDu = 0.0;  // derivatives of `plus`; those of `minus` are the negatives
    double plusDv = 0.0;
};
[[nodiscard]] Blend blend(std::size_t corner, double u, double v);

// Where the blended point of each corner stands in the bicubic net.
inline constexpr std::array<std::size_t, 4> blendSlot{5, 6, 10, 9};

// The bicubic net of a Gregory patch with the four blended points given.
[[nodiscard]] Net gregoryNet(Points gregory, const std::array<glm::dvec3, 4>& blended);

// The bicubic net, over the whole unit square, of a pn triangle's polynomial.
[[nodiscard]] Net pnNet(Points pn);

// Surface and derivatives at (u, v), both 0 to 1; of a pn triangle u + v <= 1.
[[nodiscard]] SurfacePoint evaluate(PatchKind kind, Points points, double u, double v, Weights weights = {});

// The unit vector along du x dv. Where that vanishes (a pole, a corner with parallel tangents): its limit on the straight way
// from the patch's middle in (u, v). Zero when the patch has no area there either.
[[nodiscard]] glm::dvec3 unitNormal(PatchKind kind, Points points, double u, double v, Weights weights = {});

// The unit normal that a picture shows: of a pn triangle, with its normals, the quadratic field, of everything else and where that
// field vanishes unitNormal().
[[nodiscard]] glm::dvec3 shadingNormal(PatchKind kind, Points points, double u, double v, Weights weights = {});

// The Gregory patch, with f+ = f-, that is the same surface as a Bezier patch.
[[nodiscard]] std::array<glm::dvec3, 20> gregoryFromBezier(Points bezier);

// The points of one patch of a mesh, in the mesh's own coordinates.
[[nodiscard]] std::vector<glm::dvec3> patchPoints(const Mesh& mesh, std::size_t patch);

// The weights of one patch of a mesh; empty unless it is rational.
[[nodiscard]] std::vector<double> patchWeights(const Mesh& mesh, std::size_t patch);

// Diagonal of the box around the points.
[[nodiscard]] double patchSize(Points points);

}  // namespace tessera::reference
