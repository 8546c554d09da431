// NURBS surfaces as bicubic patches: every span of the knots becomes a Bezier piece by knot insertion, written as blossoms (Ramshaw 1989),
// and is raised to degree 3. What two pieces share is computed once, in double precision, and rounded once.
#include "scene/surface_numbers.h"
#include "tessera/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tessera {

namespace {

// A control point of a cubic piece, as a mean of up to four neighbouring control points of the NURBS.
struct Mix {
    std::size_t first = 0;  // among the NURBS' points in this direction
    std::array<double, 4> parts{};
};

// One direction of a surface, cut to cubic pieces. Pieces that meet share a mix.
struct Cuts {
    std::vector<Mix> mixes;
    std::vector<std::array<std::size_t, 4>> pieces;  // indices of mixes
};

// Degree and knots of one direction.
struct Direction {
    std::string_view name;  // "u"
    int degree = 3;
    const std::vector<double>& knots;
    std::size_t count = 0;  // points

    [[nodiscard]] std::size_t order() const { return static_cast<std::size_t>(degree) + 1; }
    [[nodiscard]] double start() const { return knots[order() - 1]; }
    [[nodiscard]] double end() const { return knots[count]; }
};

void checkCounts(const SurfaceLabel& label, const Direction& way) {
    const std::string name(way.name);
    if (way.degree < 1 || way.degree > 3) label.fail(name + " degree is " + std::to_string(way.degree) + "; give 1, 2 or 3");
    if (way.count < way.order()) {
        label.fail(std::to_string(way.count) + " points along " + name + " are too few for degree " + std::to_string(way.degree) +
                   "; give at least " + std::to_string(way.order()));
    }
    if (way.knots.size() < way.order() || way.knots.size() - way.order() != way.count) {
        label.fail(std::to_string(way.knots.size()) + " knots along " + name + " for " + std::to_string(way.count) + " points of degree " +
                   std::to_string(way.degree) + "; give " + std::to_string(way.count + way.order()));
    }
}

void checkKnots(const SurfaceLabel& label, const Direction& way) {
    const std::string name(way.name);
    const auto at = [&](std::size_t i) { return name + " knot " + std::to_string(i); };
    for (std::size_t i = 0; i < way.knots.size(); ++i) label.requireFinite(at(i), way.knots[i]);
    std::size_t equal = 1;
    for (std::size_t i = 1; i < way.knots.size(); ++i) {
        if (way.knots[i] < way.knots[i - 1]) {
            label.fail(at(i) + " is " + numberText(way.knots[i]) + " after " + numberText(way.knots[i - 1]) +
                       "; give knots that do not fall");
        }
        equal = way.knots[i] == way.knots[i - 1] ? equal + 1 : 1;
        if (equal > way.order()) {
            label.fail(at(i) + " is the " + std::to_string(equal) + "th that is " + numberText(way.knots[i]) + "; give at most " +
                       std::to_string(way.order()) + " equal knots, one more than the degree");
        }
    }
    if (way.start() == way.end()) {
        label.fail("the " + name + " knots of the surface are all " + numberText(way.start()) + ", which gives no area; spread them");
    }
}

std::size_t rowCount(const SurfaceLabel& label, const Nurbs& surface) {
    if (surface.uCount == 0) label.fail("uCount is 0; give the number of points along u");
    if (surface.points.size() % surface.uCount != 0) {
        label.fail(std::to_string(surface.points.size()) + " points are no multiple of the " + std::to_string(surface.uCount) +
                   " along u; give whole rows");
    }
    return surface.points.size() / surface.uCount;
}

void checkPoints(const SurfaceLabel& label, const Nurbs& surface) {
    if (!surface.weights.empty() && surface.weights.size() != surface.points.size()) {
        label.fail(std::to_string(surface.weights.size()) + " weights for " + std::to_string(surface.points.size()) +
                   " points; give one for each, or none");
    }
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) label.requireFinite("point " + std::to_string(i), surface.points[i][axis]);
    }
    for (std::size_t i = 0; i < surface.weights.size(); ++i) label.requirePositive("weight " + std::to_string(i), surface.weights[i]);
}

// The blossom of the piece over [knots[span], knots[span + 1]] at `arguments`, of which the first `degree` are used: by de Boor's
// algorithm, over unit vectors in place of points. Arguments within the span make all parts at least 0.
Mix blossom(const Direction& way, std::size_t span, const std::array<double, 3>& arguments) {
    const std::size_t p = way.order() - 1;
    std::array<std::array<double, 4>, 4> rows{};
    for (std::size_t i = 0; i <= p; ++i) rows[i][i] = 1.0;
    for (std::size_t r = 1; r <= p; ++r) {
        for (std::size_t i = p; i >= r; --i) {
            const double low = way.knots[span - p + i], high = way.knots[span + 1 + i - r];
            const double share = (arguments[r - 1] - low) / (high - low);
            for (std::size_t k = 0; k < 4; ++k) rows[i][k] = (1.0 - share) * rows[i - 1][k] + share * rows[i][k];
        }
    }
    return {span - p, rows[p]};
}

// The control points of the piece over a span, raised to degree 3.
std::array<Mix, 4> cubicPiece(const Direction& way, std::size_t span) {
    const double a = way.knots[span], b = way.knots[span + 1];
    const Mix start = blossom(way, span, {a, a, a}), end = blossom(way, span, {b, b, b});
    if (way.degree == 3) return {start, blossom(way, span, {a, a, b}), blossom(way, span, {a, b, b}), end};
    const auto third = [](const Mix& one, const Mix& two) {
        Mix mix{one.first, {}};
        for (std::size_t k = 0; k < 4; ++k) mix.parts[k] = (one.parts[k] + 2.0 * two.parts[k]) / 3.0;
        return mix;
    };
    if (way.degree == 1) return {start, third(end, start), third(start, end), end};
    const Mix middle = blossom(way, span, {a, b});
    return {start, third(start, middle), third(end, middle), end};
}

Cuts cut(const Direction& way) {
    Cuts cuts;
    for (std::size_t span = way.order() - 1; span < way.count; ++span) {
        if (way.knots[span] == way.knots[span + 1]) continue;
        // A knot of full multiplicity tears the surface: nothing is shared there.
        const bool joined = !cuts.pieces.empty() && way.knots[span] != way.knots[span - (way.order() - 1)];
        const std::array<Mix, 4> piece = cubicPiece(way, span);
        std::array<std::size_t, 4> indices{};
        if (joined) indices[0] = cuts.pieces.back()[3];
        for (std::size_t k = joined ? 1 : 0; k < 4; ++k) {
            indices[k] = cuts.mixes.size();
            cuts.mixes.push_back(piece[k]);
        }
        cuts.pieces.push_back(indices);
    }
    return cuts;
}

// A grid of homogeneous points, row by row.
struct Grid {
    std::size_t columns = 0;
    std::vector<glm::dvec4> points;
};

// All weights scaled by one power of two, which keeps their bits, so that they lie around 1.
Grid homogeneous(const SurfaceLabel& label, const Nurbs& surface) {
    Grid grid{surface.uCount, {}};
    grid.points.reserve(surface.points.size());
    int shift = 0;
    if (!surface.weights.empty()) {
        const auto [least, most] = std::minmax_element(surface.weights.begin(), surface.weights.end());
        if (*most / *least > 1e10) {
            label.fail("weights from " + numberText(*least) + " to " + numberText(*most) +
                       " are too far apart; give weights within a factor of 1e10");
        }
        shift = -static_cast<int>(std::lround(std::log2(*least) * 0.5 + std::log2(*most) * 0.5));
    }
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
        const double weight = surface.weights.empty() ? 1.0 : std::ldexp(surface.weights[i], shift);
        grid.points.emplace_back(surface.points[i] * weight, weight);
    }
    return grid;
}

// Mixes columns. The result is the transpose of what came in, so that a second call mixes what were rows.
Grid mixedAndTransposed(const Grid& grid, const Cuts& cuts) {
    const std::size_t rows = grid.points.size() / grid.columns;
    Grid result{rows, {}};
    result.points.reserve(cuts.mixes.size() * rows);
    for (const Mix& mix : cuts.mixes) {
        for (std::size_t row = 0; row < rows; ++row) {
            glm::dvec4 sum(0.0);
            for (std::size_t k = 0; k < 4; ++k) {
                if (mix.parts[k] != 0.0) sum += mix.parts[k] * grid.points[row * grid.columns + mix.first + k];
            }
            result.points.push_back(sum);
        }
    }
    return result;
}

// A row or column of a grid.
struct Line {
    std::size_t first = 0;
    std::size_t step = 1;
    std::size_t count = 0;

    [[nodiscard]] std::size_t operator[](std::size_t i) const { return first + i * step; }
};

bool nearlyEqual(const glm::dvec4& a, const glm::dvec4& b, double tolerance) {
    const glm::dvec3 gap = glm::abs(glm::dvec3(a) - glm::dvec3(b));
    return std::max({gap.x, gap.y, gap.z}) <= tolerance;
}

// Where two opposite borders are equal but for rounding, as in a periodic surface, the last becomes the first.
void closeSeam(Grid& grid, const Line& first, const Line& last, double tolerance) {
    for (std::size_t i = 0; i < first.count; ++i) {
        const glm::dvec4 &one = grid.points[first[i]], &other = grid.points[last[i]];
        if (!nearlyEqual(one, other, tolerance) || std::abs(one.w - other.w) > 1e-12 * one.w) return;
    }
    for (std::size_t i = 0; i < first.count; ++i) grid.points[last[i]] = grid.points[first[i]];
}

// A border that is a point but for rounding becomes one: a pole.
void closePole(Grid& grid, const Line& border, double tolerance) {
    const glm::dvec4 pole = grid.points[border[0]];
    for (std::size_t i = 1; i < border.count; ++i) {
        if (!nearlyEqual(pole, grid.points[border[i]], tolerance)) return;
    }
    for (std::size_t i = 1; i < border.count; ++i) grid.points[border[i]] = glm::dvec4(glm::dvec3(pole), grid.points[border[i]].w);
}

// What ought to be equal on the grid's borders, made so: double precision leaves some 1e-15 of the surface's size.
void closeBorders(Grid& grid) {
    double size = 0.0;
    for (const glm::dvec4& point : grid.points) size = std::max({size, std::abs(point.x), std::abs(point.y), std::abs(point.z)});
    const double tolerance = 1e-12 * size;
    const std::size_t columns = grid.columns, rows = grid.points.size() / columns;
    const Line bottom{0, 1, columns}, top{(rows - 1) * columns, 1, columns};
    const Line left{0, columns, rows}, right{columns - 1, columns, rows};
    for (const Line& border : {bottom, top, left, right}) closePole(grid, border, tolerance);
    closeSeam(grid, left, right, tolerance);
    closeSeam(grid, bottom, top, tolerance);
}

// From homogeneous to Euclidean points, each beside its weight.
void project(Grid& grid) {
    for (glm::dvec4& point : grid.points) point = glm::dvec4(glm::dvec3(point) / point.w, point.w);
}

}  // namespace

Mesh nurbsMesh(const Nurbs& surface) {
    const SurfaceLabel label{"NURBS", surface.name};
    const Direction u{"u", surface.uDegree, surface.uKnots, surface.uCount};
    const Direction v{"v", surface.vDegree, surface.vKnots, rowCount(label, surface)};
    for (const Direction& way : {u, v}) {
        checkCounts(label, way);
        checkKnots(label, way);
    }
    checkPoints(label, surface);

    const Cuts uCuts = cut(u), vCuts = cut(v);
    Grid grid = mixedAndTransposed(mixedAndTransposed(homogeneous(label, surface), uCuts), vCuts);
    project(grid);
    closeBorders(grid);

    const bool rational =
        std::adjacent_find(surface.weights.begin(), surface.weights.end(), std::not_equal_to<>()) != surface.weights.end();
    Mesh mesh;
    mesh.name = surface.name;
    mesh.kind = rational ? PatchKind::rational : PatchKind::bezier;
    mesh.points.reserve(16 * uCuts.pieces.size() * vCuts.pieces.size());
    if (rational) mesh.weights.reserve(mesh.points.capacity());
    for (const std::array<std::size_t, 4>& row : vCuts.pieces) {
        for (const std::array<std::size_t, 4>& column : uCuts.pieces) {
            for (std::size_t i = 0; i < 16; ++i) {
                const glm::dvec4& point = grid.points[row[i / 4] * grid.columns + column[i % 4]];
                mesh.points.push_back(rounded(glm::dvec3(point)));
                if (rational) mesh.weights.push_back(static_cast<float>(point.w));
            }
        }
    }
    return mesh;
}

}  // namespace tessera
