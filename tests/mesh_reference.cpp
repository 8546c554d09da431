// Draws tessellation patterns the slow way.
#include "mesh_reference.h"

#include "mesh/pattern.h"

#include <algorithm>
#include <map>

namespace tessera::reference {
namespace {

constexpr std::uint32_t one = 1U << 24U;
using Line = std::vector<PatternCorner>;

bool isTriangle(const mesh_pattern& p) { return p.form == MESH_TRIANGLE_RING || p.form == MESH_TRIANGLE_GRID; }
bool isFan(const mesh_pattern& p) { return p.form == MESH_FAN_0 || p.form == MESH_FAN_1 || p.form == MESH_FAN_3; }

// Where place t of 0 to 1 along a side lies.
PatternCorner onSide(const mesh_pattern& p, int side, double t) {
    if (side == 0) return {0, t, 0};
    if (side == 1) return {0, isTriangle(p) || isFan(p) ? 1 - t : 1, t};
    return side == 2 ? PatternCorner{0, t, 1} : PatternCorner{0, 0, t};
}

// A side's vertices in its own direction, numbered on a walk around the patch.
Line sideLine(const mesh_pattern& p, int side) {
    Line walk;
    std::uint64_t number = 0;
    const std::uint64_t loop = std::max<std::uint64_t>(1, std::uint64_t{p.side[0]} + p.side[1] + p.side[2] + p.side[3]);
    for (int s = 0; s < side; ++s) number += p.side[s];
    const std::uint32_t segments = p.side[side];
    for (std::uint32_t i = 0; i <= segments; ++i) {
        const std::uint32_t place = side < 2 ? i : segments - i;
        PatternCorner corner = onSide(p, side, segments == 0 ? 0.5 : static_cast<double>(place) / segments);
        corner.number = (number + i) % loop;
        walk.push_back(corner);
    }
    if (side >= 2) std::reverse(walk.begin(), walk.end());
    return walk;
}

double place(std::uint32_t low, std::uint32_t high, std::size_t cells, std::size_t k) {
    const double share = cells == 0 ? 0.0 : static_cast<double>(k) / static_cast<double>(cells);
    return (low + (static_cast<double>(high) - low) * share) / one;
}

// The inner vertices, row by row.
std::vector<Line> innerRows(const mesh_pattern& p) {
    const bool triangle = isTriangle(p);
    const std::size_t columns = triangle ? p.cells_u : p.cells_u - 2;
    const std::size_t rows = triangle ? p.cells_u : p.cells_v - 2;
    std::uint64_t number = patternLoop(p);
    std::vector<Line> result;
    for (std::size_t j = 0; j <= rows; ++j) {
        Line& line = result.emplace_back();
        for (std::size_t i = 0; i <= columns - (triangle ? j : 0); ++i) {
            const double u = place(p.low_u, triangle ? p.high_u - p.low_v : p.high_u, columns, i);
            line.push_back({number++, u, place(p.low_v, triangle ? p.high_u - p.low_u : p.high_v, rows, j)});
        }
    }
    return result;
}

Line beside(const std::vector<Line>& rows, int side) {
    if (side == 0) return rows.front();
    if (side == 2) return rows.back();
    Line line;
    for (const Line& row : rows) line.push_back(side == 1 ? row.back() : row.front());
    return line;
}

struct Segment {
    std::int64_t middle;  // in units of which a side has 2^26 times both lines' numbers of segments
    bool outer;
};

// The segments of both lines in the order of their middles, the outer line's first where two are at one place. Ends of the inner line in
// units of 2^-25.
std::vector<Segment> inTurn(std::size_t outer, std::size_t inner, std::int64_t low, std::int64_t high) {
    const auto o = static_cast<std::int64_t>(outer), n = static_cast<std::int64_t>(inner);
    std::vector<Segment> segments;
    for (std::int64_t i = 0; i < o; ++i) segments.push_back({(2 * i + 1) * 2 * one * n, true});
    for (std::int64_t k = 0; k < n; ++k) segments.push_back({2 * low * o * n + (2 * k + 1) * (high - low) * o, false});
    std::stable_sort(segments.begin(), segments.end(), [](const Segment& a, const Segment& b) { return a.middle < b.middle; });
    return segments;
}

// Triangles between two lines of one direction, `inner` to the left of `outer` unless `mirrored`.
void zip(const Line& outer, const Line& inner, const std::vector<Segment>& segments, bool mirrored, int region, PatternDrawing& drawing) {
    std::size_t i = 0, k = 0;
    for (const Segment& segment : segments) {
        PatternTriangle triangle{{outer[i], segment.outer ? outer[i + 1] : inner[k + 1], inner[k]}, region};
        if (mirrored) std::swap(triangle.corners[1], triangle.corners[2]);
        drawing.triangles.push_back(triangle);
        (segment.outer ? i : k) += 1;
    }
}

// What the middle of a side that is a point leaves out on both sides of it, beside a line whose ends are `first` and `last`.
double gapsBeside(const mesh_pattern& p, int side, const PatternCorner& first, const PatternCorner& last) {
    if (p.side[side] > 0) return 0;
    const PatternCorner middle = onSide(p, side, 0.5);
    return std::abs(areaOf({onSide(p, side, 0), middle, first})) + std::abs(areaOf({middle, onSide(p, side, 1), last}));
}

// Where a point lies along a side of a triangle, at the foot of its perpendicular in an equilateral one, units of 2^-25.
std::int64_t foot(int side, std::int64_t u, std::int64_t v) {
    if (side == 0) return 2 * u + v;
    return side == 1 ? 2 * v + (one - u - v) : 2 * v + u;
}

}  // namespace

std::pair<std::int64_t, std::int64_t> endsBeside(const mesh_pattern& p, int side) {
    if (!isTriangle(p))
        return side % 2 == 0 ? std::pair{2 * std::int64_t{p.low_u}, 2 * std::int64_t{p.high_u}}
                             : std::pair{2 * std::int64_t{p.low_v}, 2 * std::int64_t{p.high_v}};
    const std::int64_t lowU = p.low_u, lowV = p.low_v, high = p.high_u;
    const std::array<std::array<std::int64_t, 2>, 3> corner{{{lowU, lowV}, {high - lowV, lowV}, {lowU, high - lowU}}};
    const auto& from = corner[side == 1 ? 1 : 0];
    const auto& to = corner[side == 0 ? 1 : 2];
    return {foot(side, from[0], from[1]), foot(side, to[0], to[1])};
}

namespace {

void drawRing(const mesh_pattern& p, PatternDrawing& drawing) {
    const std::vector<Line> rows = innerRows(p);
    for (const int side : {0, 1, 2, 3}) {
        if (side == 2 && isTriangle(p)) continue;
        const Line outer = sideLine(p, side), inner = beside(rows, side);
        const auto [low, high] = endsBeside(p, side);
        zip(outer, inner, inTurn(outer.size() - 1, inner.size() - 1, low, high), side >= 2, side, drawing);
        drawing.gaps += gapsBeside(p, side, inner.front(), inner.back());
    }
    for (std::size_t j = 0; j + 1 < rows.size(); ++j) {
        const Line &under = rows[j], &above = rows[j + 1];
        for (std::size_t i = 0; i + 1 < under.size(); ++i) {
            if (!isTriangle(p)) {
                drawing.triangles.push_back({{under[i], under[i + 1], above[i + 1]}});
                drawing.triangles.push_back({{under[i], above[i + 1], above[i]}});
                continue;
            }
            drawing.triangles.push_back({{under[i], under[i + 1], above[i]}});
            if (i + 1 < above.size()) drawing.triangles.push_back({{under[i + 1], above[i + 1], above[i]}});
        }
    }
}

void drawRibbon(const mesh_pattern& p, int near, int far, PatternDrawing& drawing) {
    const Line outer = sideLine(p, near), inner = sideLine(p, far);
    PatternDrawing all;
    zip(outer, inner, inTurn(outer.size() - 1, inner.size() - 1, 0, 2 * std::int64_t{one}), near == 3, near, all);
    const bool first = p.side[near == 0 ? 3 : 0] == 0, last = p.side[near == 0 ? 1 : 2] == 0;
    for (std::size_t t = 0; t < all.triangles.size(); ++t) {
        if ((first && t == 0) || (last && t + 1 == all.triangles.size()))
            drawing.gaps += areaOf(all.triangles[t].corners);
        else
            drawing.triangles.push_back(all.triangles[t]);
    }
    const auto end = [&](int side, const Line& line, bool back) {
        return line.size() > 1 ? (back ? line.back() : line.front()) : onSide(p, side, back ? 1 : 0);
    };
    if (p.side[near] == 0) drawing.gaps += gapsBeside(p, near, end(far, inner, false), end(far, inner, true));
    if (p.side[far] == 0) drawing.gaps += gapsBeside(p, far, outer.front(), outer.back());
}

void drawGrid(const mesh_pattern& p, PatternDrawing& drawing) {
    const std::size_t n = p.cells_u;
    std::map<std::pair<std::size_t, std::size_t>, std::uint64_t> number;
    std::uint64_t next = 0;
    for (std::size_t i = 0; i < n; ++i) number[{i, 0}] = next++;
    for (std::size_t i = 0; i < n; ++i) number[{n - i, i}] = next++;
    for (std::size_t i = 0; i < n; ++i) number[{0, n - i}] = next++;
    for (std::size_t j = 1; j < n; ++j)
        for (std::size_t i = 1; i + j < n; ++i) number[{i, j}] = next++;
    const auto at = [&](std::size_t i, std::size_t j) {
        const auto size = static_cast<double>(n);
        return PatternCorner{number.at({i, j}), static_cast<double>(i) / size, static_cast<double>(j) / size};
    };
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = 0; i + j < n; ++i) {
            drawing.triangles.push_back({{at(i, j), at(i + 1, j), at(i, j + 1)}});
            if (i + j + 1 < n) drawing.triangles.push_back({{at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}});
        }
    }
}

void drawFan(const mesh_pattern& p, int side, PatternDrawing& drawing) {
    const Line outer = sideLine(p, side);
    const Line apex = {side == 0 ? sideLine(p, 3).back() : side == 1 ? sideLine(p, 0).front() : sideLine(p, 0).back()};
    zip(outer, apex, inTurn(outer.size() - 1, 0, 0, 2 * std::int64_t{one}), side == 3, side, drawing);
}

std::uint32_t upTo(std::mt19937& random, std::uint32_t least, std::uint32_t most) {
    return std::uniform_int_distribution<std::uint32_t>(least, most)(random);
}

}  // namespace

double areaOf(const std::array<PatternCorner, 3>& c) {
    return 0.5 * ((c[1].u - c[0].u) * (c[2].v - c[0].v) - (c[2].u - c[0].u) * (c[1].v - c[0].v));
}

PatternDrawing draw(const mesh_pattern& pattern) {
    PatternDrawing drawing;
    switch (pattern.form) {
        case MESH_RIBBON_U:
            drawRibbon(pattern, 0, 2, drawing);
            break;
        case MESH_RIBBON_V:
            drawRibbon(pattern, 3, 1, drawing);
            break;
        case MESH_RING:
        case MESH_TRIANGLE_RING:
            drawRing(pattern, drawing);
            break;
        case MESH_TRIANGLE_GRID:
            drawGrid(pattern, drawing);
            break;
        case MESH_FAN_0:
        case MESH_FAN_1:
            drawFan(pattern, pattern.form == MESH_FAN_0 ? 0 : 1, drawing);
            break;
        case MESH_FAN_3:
            drawFan(pattern, 3, drawing);
            break;
        default:
            break;
    }
    return drawing;
}

void placeLines(mesh_pattern& p, std::mt19937* random) {
    const bool triangle = p.form == MESH_TRIANGLE_RING;
    const std::uint32_t u = random ? upTo(*random, one / 64, one / 3 - 1) : one / (p.cells_u + (triangle ? 3 : 0));
    const std::uint32_t v = random ? upTo(*random, one / 64, one / 3 - 1) : triangle ? u : one / p.cells_v;
    p.low_u = u;
    p.low_v = v;
    p.high_u = random ? one - upTo(*random, one / 64, one / 3 - 1) : one - u;
    p.high_v = triangle ? 0 : random ? one - upTo(*random, one / 64, one / 3 - 1) : one - v;
    // One line lies in the middle of the two that it stands for.
    if (!triangle && p.cells_u == 2) p.high_u = p.low_u;
    if (!triangle && p.cells_v == 2) p.high_v = p.low_v;
    if (triangle && p.cells_u == 0) p.high_u = p.low_u + p.low_v;
}

mesh_pattern randomPattern(std::mt19937& random, std::uint32_t most) {
    mesh_pattern p{};
    p.form = upTo(random, 0, 8);
    const auto rate = [&] { return upTo(random, 0, upTo(random, 0, most)); };
    if (p.form == MESH_RING || p.form == MESH_TRIANGLE_RING) {
        for (const int side : {0, 1, 2, 3}) p.side[side] = side == 2 && p.form != MESH_RING ? 0 : rate();
        p.cells_u = p.form == MESH_RING ? std::max(2U, rate()) : rate();
        p.cells_v = p.form == MESH_RING ? std::max(2U, rate()) : 0;
        placeLines(p, upTo(random, 0, 1) == 0 ? nullptr : &random);
    } else if (p.form == MESH_TRIANGLE_GRID) {
        p.cells_u = std::clamp<std::uint32_t>(rate(), 1, MESH_GRID_MOST);
        for (const int side : {0, 1, 3}) p.side[side] = p.cells_u;
    } else if (p.form == MESH_RIBBON_U || p.form == MESH_RIBBON_V) {
        const int near = p.form == MESH_RIBBON_U ? 0 : 1;
        for (const int side : {0, 1, 2, 3}) p.side[side] = side % 2 == near ? rate() : upTo(random, 0, 1);
    } else if (isFan(p)) {
        for (const int side : {0, 1, 3}) p.side[side] = 1;
        p.side[p.form == MESH_FAN_0 ? 0 : p.form == MESH_FAN_1 ? 1 : 3] = std::max(1U, rate());
    }
    return p;
}

}  // namespace tessera::reference
