// Finds where a ray first meets a piece of a patch: complete (what is discarded provably holds no hit, or none that is nearer)
// and exact (a hit is a root of the patch's own equations, polished by Newton's method).
#pragma once

#include "patch_piece.h"

#include <optional>

namespace tessera::reference {

// In the ray's frame the ray is the z axis from the origin: x and y are distances from it, z is the distance along it.
struct RayFrame {
    glm::dmat3 linear{1.0};
    glm::dvec3 origin{0.0};
};

// `direction` is a unit vector.
[[nodiscard]] RayFrame rayFrame(const glm::dvec3& origin, const glm::dvec3& direction);

struct Root {
    double distance = 0.0;       // along the ray
    glm::dvec2 parameters{0.0};  // (u, v)
    double residual = 0.0;       // distance of the surface point from the ray
};

struct SearchLimits {
    double nearest = 0.0;    // roots lie beyond this distance
    double farthest = 0.0;   // and before this
    double tolerance = 0.0;  // greatest residual, in units of the scene
};

// The nearest root on `piece` of `shape`; both in the ray's frame. Throws std::runtime_error when the search does not
// end within a great number of steps (surfaces that hold a part of the ray everywhere at the same depth).
[[nodiscard]] std::optional<Root> nearestRoot(const PatchShape& shape, const Piece& piece, const SearchLimits& limits);

}  // namespace tessera::reference
