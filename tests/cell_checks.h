// Cells and patches of subdivided cages held against the limit surface, which a reference knows.
#pragma once

#include "catmull_clark_reference.h"
#include "subdivision/cells.h"
#include "subdivision/quad_domains.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace tessera::test {

// The limit surface over one domain.
class DomainLimit {
public:
    DomainLimit(const CatmullClarkReference& reference, const subdivision::QuadDomain& domain);

    [[nodiscard]] LimitPoint at(double u, double v) const { return reference_.at(face_, subFace_, u, v); }

    struct Nearest {
        LimitPoint point;
        double distance = 0.0;
    };
    // As near to `point` as steps from (u, v), `step` long at first, come; stops where it is `enough`. Parameters are multiples of 2^-30.
    [[nodiscard]] Nearest nearest(const glm::dvec3& point, double u, double v, double step, double enough) const;

private:
    const CatmullClarkReference& reference_;
    std::uint32_t face_, subFace_;
};

struct CellPoint {
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0};  // unit length; 0 where there is none
};
[[nodiscard]] CellPoint evaluateCell(PatchKind kind, std::span<const glm::dvec3> points, double s, double t);

// Where a cell's parameters lie in its domain.
[[nodiscard]] glm::dvec2 inDomain(const subdivision::Cell& cell, double s, double t);

// Whether one of the cell's corners is one of its domain's.
[[nodiscard]] bool touchesCorner(const subdivision::Cell& cell);

// Degrees between unit vectors.
[[nodiscard]] double degreesBetween(const glm::dvec3& one, const glm::dvec3& other);

// The nearest point of cells to `point`, or one within `enough` of it.
[[nodiscard]] CellPoint nearestOnCells(std::span<const subdivision::Cell* const> cells, const glm::dvec3& point, double enough);

}  // namespace tessera::test
