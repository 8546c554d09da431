// Cells and patches of subdivided cages held against the limit surface.
#include "cell_checks.h"

#include "patch_eval.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace tessera::test {

namespace {

constexpr double kFinest = 1.0 / (1 << 30);

glm::dvec2 snapped(const glm::dvec2& uv) { return glm::clamp(glm::round(uv / kFinest) * kFinest, 0.0, 1.0); }

// Downhill by Levenberg and Marquardt, within the cell, from the nearest of 25 places.
CellPoint nearestOn(const subdivision::Cell& cell, const glm::dvec3& point) {
    const reference::Points points(cell.points.data(), pointsPerPatch(cell.kind));
    const auto distanceAt = [&](const glm::dvec2& st) {
        return glm::distance(reference::evaluate(cell.kind, points, st.x, st.y).position, point);
    };
    glm::dvec2 best(0.0);
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 25; ++k) {
        const glm::dvec2 st = 0.25 * glm::dvec2(k % 5, k / 5);
        if (distanceAt(st) >= least) continue;
        best = st;
        least = distanceAt(st);
    }
    double damping = 1e-3;
    for (int step = 0; step < 40 && damping < 1e12; ++step) {
        const reference::SurfacePoint at = reference::evaluate(cell.kind, points, best.x, best.y);
        const glm::dvec3 away = point - at.position;
        const double more = damping * (glm::dot(at.du, at.du) + glm::dot(at.dv, at.dv)) + 1e-300;
        const double a = glm::dot(at.du, at.du) + more, b = glm::dot(at.du, at.dv), c = glm::dot(at.dv, at.dv) + more;
        const double x = glm::dot(at.du, away), y = glm::dot(at.dv, away);
        const glm::dvec2 next = glm::clamp(best + glm::dvec2(c * x - b * y, a * y - b * x) / (a * c - b * b), 0.0, 1.0);
        const double distance = distanceAt(next);
        damping = distance < least ? 0.1 * damping : 10.0 * damping;
        if (distance >= least) continue;
        best = next;
        least = distance;
    }
    return evaluateCell(cell.kind, points, best.x, best.y);
}

// From the point to the box around the control points, which holds the cell.
double toBox(const subdivision::Cell& cell, const glm::dvec3& point) {
    glm::dvec3 lower = cell.points[0], upper = lower;
    for (std::size_t k = 1; k < pointsPerPatch(cell.kind); ++k) {
        lower = glm::min(lower, cell.points[k]);
        upper = glm::max(upper, cell.points[k]);
    }
    return glm::distance(glm::clamp(point, lower, upper), point);
}

}  // namespace

DomainLimit::DomainLimit(const CatmullClarkReference& reference, const subdivision::QuadDomain& domain)
    : reference_(reference), face_(domain.face), subFace_(static_cast<std::uint32_t>(std::max(domain.subFace, 0))) {}

DomainLimit::Nearest DomainLimit::nearest(const glm::dvec3& point, double u, double v, double step, double enough) const {
    glm::dvec2 best = snapped({u, v});
    Nearest nearest{at(best.x, best.y), 0.0};
    nearest.distance = glm::distance(nearest.point.position, point);
    constexpr std::array<glm::dvec2, 8> ways{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
    for (int halvings = 0, steps = 0; halvings < 14 && steps < 60 && nearest.distance > enough; ++steps) {
        bool moved = false;
        for (const glm::dvec2& way : ways) {
            const glm::dvec2 next = snapped(best + step * way);
            const LimitPoint there = at(next.x, next.y);
            const double distance = glm::distance(there.position, point);
            if (distance >= nearest.distance) continue;
            nearest = {there, distance};
            best = next;
            moved = true;
            break;
        }
        if (moved) continue;
        step *= 0.5;
        ++halvings;
    }
    return nearest;
}

CellPoint evaluateCell(PatchKind kind, std::span<const glm::dvec3> points, double s, double t) {
    points = points.first(pointsPerPatch(kind));
    return {reference::evaluate(kind, points, s, t).position, reference::unitNormal(kind, points, s, t)};
}

glm::dvec2 inDomain(const subdivision::Cell& cell, double s, double t) {
    return {std::ldexp(cell.u + s, -static_cast<int>(cell.levelU)), std::ldexp(cell.v + t, -static_cast<int>(cell.levelV))};
}

bool touchesCorner(const subdivision::Cell& cell) {
    const glm::dvec2 lower = inDomain(cell, 0.0, 0.0), upper = inDomain(cell, 1.0, 1.0);
    return (lower.x == 0.0 || upper.x == 1.0) && (lower.y == 0.0 || upper.y == 1.0);
}

double degreesBetween(const glm::dvec3& one, const glm::dvec3& other) {
    return std::atan2(glm::length(glm::cross(one, other)), glm::dot(one, other)) * 180.0 / std::numbers::pi;
}

CellPoint nearestOnCells(std::span<const subdivision::Cell* const> cells, const glm::dvec3& point, double enough) {
    std::vector<std::pair<double, const subdivision::Cell*>> byBox;
    for (const subdivision::Cell* cell : cells) byBox.emplace_back(toBox(*cell, point), cell);
    std::sort(byBox.begin(), byBox.end());
    CellPoint nearest;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [distance, cell] : byBox) {
        if (distance >= least || least <= enough) break;
        const CellPoint found = nearestOn(*cell, point);
        if (glm::distance(found.position, point) >= least) continue;
        least = glm::distance(found.position, point);
        nearest = found;
    }
    return nearest;
}

}  // namespace tessera::test
