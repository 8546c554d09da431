// How far patches lie from the limit surface, measured.
#include "subdivision/limit_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "subdivision/limit_evaluator.h"

namespace tessera::subdivision {

namespace {

// Faces at a vertex of a thousand edges take 20 ms each to set up, and have two thousand control points.
constexpr std::size_t kMostEvaluations = 200000, kMostControlPoints = 200000;
constexpr int kNewtonSteps = 5;

std::array<double, 4> bernstein(double t) {
    const double s = 1.0 - t;
    return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

// Shares of two face points; both are without weight where the sum is 0.
glm::dvec3 blend(double a, const glm::dvec3& p, double b, const glm::dvec3& q) { return a + b > 0 ? (a * p + b * q) / (a + b) : p; }

// The patch's point at its own parameters (Loop et al. 2009, section 3.1, for a Gregory patch).
glm::dvec3 pointOf(const Cell& cell, double u, double v) {
    const std::array<glm::dvec3, 20>& p = cell.points;
    const std::array<double, 4> across = bernstein(u), up = bernstein(v);
    std::array<glm::dvec3, 16> net;
    if (cell.kind == PatchKind::gregory) {
        const glm::dvec3 f0 = blend(u, p[12], v, p[16]), f1 = blend(v, p[13], 1 - u, p[17]);
        const glm::dvec3 f2 = blend(1 - u, p[14], 1 - v, p[18]), f3 = blend(1 - v, p[15], u, p[19]);
        net = {p[0], p[4], p[9], p[1], p[8], f0, f1, p[5], p[7], f3, f2, p[10], p[3], p[11], p[6], p[2]};
    } else {
        std::copy_n(p.begin(), net.size(), net.begin());
    }
    glm::dvec3 sum(0.0);
    for (std::size_t k = 0; k < net.size(); ++k) sum += across[k % 4] * up[k / 4] * net[k];
    return sum;
}

// The step from `at` that brings the tangent plane's point nearest to what lies `away`, within the unit square.
glm::dvec2 newtonStep(const LimitPoint& surface, const glm::dvec3& away, const glm::dvec2& at) {
    const double uu = glm::dot(surface.du, surface.du), uv = glm::dot(surface.du, surface.dv), vv = glm::dot(surface.dv, surface.dv);
    const double ru = glm::dot(surface.du, away), rv = glm::dot(surface.dv, away);
    const double determinant = uu * vv - uv * uv;
    if (!(determinant > 1e-12 * uu * vv)) return glm::dvec2(0.0);
    const glm::dvec2 step((vv * ru - uv * rv) / determinant, (uu * rv - uv * ru) / determinant);
    const glm::dvec2 free = at + step, inside = glm::clamp(free, 0.0, 1.0);
    // Held at one border, the other parameter is free still.
    if (free.x != inside.x && free.y == inside.y) {
        const double along = (rv - uv * (inside.x - at.x)) / vv;
        return {inside.x - at.x, std::clamp(at.y + along, 0.0, 1.0) - at.y};
    }
    if (free.y != inside.y && free.x == inside.x) {
        const double along = (ru - uv * (inside.y - at.y)) / uu;
        return {std::clamp(at.x + along, 0.0, 1.0) - at.x, inside.y - at.y};
    }
    return inside - at;
}

class Measure {
public:
    Measure(const Refiner& refiner, std::span<const glm::vec3> points, const QuadDomains& domains, std::span<const Cell> cells, int samples)
        : limit_(refiner, points), domains_(domains), cells_(cells), samples_(std::max(samples, 2)) {
        glm::vec3 lower(std::numeric_limits<float>::infinity()), upper(-lower);
        for (const glm::vec3& point : points) {
            lower = glm::min(lower, point);
            upper = glm::max(upper, point);
        }
        nothing_ = points.empty() ? 0.0 : 1e-12 * static_cast<double>(glm::length(upper - lower));
    }

    LimitDistance run() {
        std::size_t controlPoints = 0;
        for (const Run& domain : order()) {
            if (found_.evaluations >= kMostEvaluations || controlPoints >= kMostControlPoints) break;
            if (!limit_.select(domains_.domains[cells_[domain.first].domain])) continue;
            controlPoints += static_cast<std::size_t>(limit_.controlPoints());
            for (std::size_t cell = domain.first; cell < domain.end; ++cell) measure(cell);
        }
        return found_;
    }

private:
    // A domain's cells.
    struct Run {
        std::size_t first, end;
    };

    // Single bicubic patches are the limit surface but for rounding, or nearly: they come last.
    [[nodiscard]] std::vector<Run> order() const {
        std::vector<Run> likely, unlikely;
        for (std::size_t first = 0; first < cells_.size();) {
            std::size_t end = first + 1;
            while (end < cells_.size() && cells_[end].domain == cells_[first].domain) ++end;
            const bool plain = end == first + 1 && cells_[first].kind == PatchKind::bezier;
            (plain ? unlikely : likely).push_back({first, end});
            first = end;
        }
        std::vector<Run> all;
        for (const std::vector<Run>* group : {&likely, &unlikely}) spread(*group, all);
        return all;
    }

    // Steps of the golden section, so that any number of the first ones lies evenly among all.
    static void spread(const std::vector<Run>& runs, std::vector<Run>& out) {
        const std::size_t count = runs.size();
        std::size_t step = static_cast<std::size_t>(0.6180339887 * static_cast<double>(count)) + 1;
        while (std::gcd(step, count) > 1) ++step;
        for (std::size_t k = 0, at = 0; k < count; ++k, at = (at + step) % count) out.push_back(runs[at]);
    }

    void measure(std::size_t index) {
        const Cell& cell = cells_[index];
        ++found_.cellsMeasured;
        for (int j = 0; j < samples_; ++j) {
            for (int i = 0; i < samples_; ++i) {
                const double u = static_cast<double>(i) / (samples_ - 1), v = static_cast<double>(j) / (samples_ - 1);
                const glm::dvec2 at(std::ldexp(cell.u + u, -static_cast<int>(cell.levelU)),
                                    std::ldexp(cell.v + v, -static_cast<int>(cell.levelV)));
                if (isInLastCell(at, domains_.domains[cell.domain])) continue;
                const double distance = distanceTo(pointOf(cell, u, v), at);
                if (distance <= found_.greatest) continue;
                found_.greatest = distance;
                found_.cell = index;
                found_.u = u;
                found_.v = v;
            }
        }
    }

    // Where Bfr approximates by itself: next to a corner, and on that cell's border, though not in the corner.
    [[nodiscard]] bool isInLastCell(const glm::dvec2& at, const QuadDomain& domain) const {
        if (limit_.polynomial()) return false;
        const double last = std::ldexp(1.0, (domain.subFace >= 0 ? 1 : 0) - kLimitLevels);
        const glm::dvec2 away = glm::min(at, 1.0 - at);
        return away.x <= last && away.y <= last && away != glm::dvec2(0.0);
    }

    // Of `point` from the limit surface near `at`; ends as soon as it cannot raise the greatest.
    double distanceTo(const glm::dvec3& point, glm::dvec2 at) {
        ++found_.evaluations;
        double best = glm::distance(limit_.position(at.x, at.y), point);
        for (int step = 0; step < kNewtonSteps && best > std::max(found_.greatest, nothing_); ++step) {
            found_.evaluations += 2;
            const LimitPoint surface = limit_.evaluate(at.x, at.y);
            const glm::dvec2 move = newtonStep(surface, point - surface.position, at);
            if (move == glm::dvec2(0.0)) break;
            at += move;
            best = std::min(best, glm::distance(limit_.position(at.x, at.y), point));
        }
        return best;
    }

    LimitEvaluator limit_;
    const QuadDomains& domains_;
    std::span<const Cell> cells_;
    int samples_;
    double nothing_ = 0;
    LimitDistance found_;
};

}  // namespace

LimitDistance limitDistance(const Refiner& refiner, std::span<const glm::vec3> points, const QuadDomains& domains,
                            std::span<const Cell> cells, int samples) {
    return Measure(refiner, points, domains, cells, samples).run();
}

}  // namespace tessera::subdivision
