// Bicubic patches fitted to parts of a limit surface.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

#include "subdivision/limit_surface.h"

namespace tessera::subdivision {

using BicubicNet = std::array<glm::dvec3, 16>;  // point 4 v + u

// A part of a domain.
struct CellBox {
    std::uint32_t levelU = 0, levelV = 0;
    std::uint32_t u = 0, v = 0;

    [[nodiscard]] double sizeU() const;
    [[nodiscard]] double sizeV() const;
    // Where (s, t) of the box lies in the domain.
    [[nodiscard]] glm::dvec2 at(double s, double t) const;
};

struct FitError {
    double distance = 0;  // between points of equal parameters, greatest of the samples
    double height = 0;    // its part along the limit surface's normal, on borders all that is not along the border
    double angle = 0;     // between normals, radians
};

[[nodiscard]] glm::dvec3 netPoint(const BicubicNet& net, double s, double t);
// By s and t. Not of unit length.
[[nodiscard]] std::array<glm::dvec3, 2> netTangents(const BicubicNet& net, double s, double t);

// The patch with the limit's position, tangents and twist in the four corners: the limit surface itself, wherever it is bicubic there.
[[nodiscard]] BicubicNet hermiteNet(const LimitSurface& limit, const CellBox& box);

// The patch of a box of which corner `corner` (0, 0), (1, 0), (1, 1), (0, 1) is irregular. On the two sides away from it it is the limit
// surface; it has the limit's tangent plane in the corner, and goes through its point in the middle; on the other sides' middles as nearly
// as the tangent plane allows.
[[nodiscard]] BicubicNet capNet(const LimitSurface& limit, const CellBox& box, std::uint32_t corner);

// Over 32 places of the box, the corners left out. Ends early where one of the errors passes its part of `most`.
[[nodiscard]] FitError fitError(const LimitSurface& limit, const CellBox& box, const BicubicNet& net, const FitError& most);

// Whether the net is the limit surface to within `distance`, at seven places: two bicubic patches with the same corners, tangents and
// twists are one.
[[nodiscard]] bool isLimit(const LimitSurface& limit, const CellBox& box, const BicubicNet& net, double distance);

}  // namespace tessera::subdivision
