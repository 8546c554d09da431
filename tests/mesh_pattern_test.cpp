// Patterns are triangulations of their patches, whatever the numbers of segments on their sides, and their units make them up.
#include "mesh_reference.h"

#include "mesh/pattern.h"

#include "device/lanes_host.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>
#include <vector>

// clang-format off
#include "device/kernel_headers_begin.h"
namespace tessera::kernels {
#include "mesh/pattern.clh"
}  // namespace tessera::kernels
#include "device/kernel_headers_end.h"
// clang-format on

namespace tessera {
namespace {

using reference::draw;
using reference::PatternDrawing;
using reference::PatternTriangle;

constexpr std::uint32_t one = 1U << 24U;

std::uint32_t upTo(std::mt19937& random, std::uint32_t most) { return std::uniform_int_distribution<std::uint32_t>(0, most)(random); }

std::string text(const mesh_pattern& p) {
    std::string result = "form " + std::to_string(p.form) + ", sides";
    for (const std::uint32_t side : p.side) result += " " + std::to_string(side);
    result += ", cells " + std::to_string(p.cells_u) + " " + std::to_string(p.cells_v) + ", lines";
    for (const std::uint32_t at : {p.low_u, p.high_u, p.low_v, p.high_v}) result += " " + std::to_string(at);
    return result;
}

mesh_pattern ring(std::array<std::uint32_t, 4> sides, std::uint32_t cellsU, std::uint32_t cellsV, std::mt19937* random = nullptr) {
    mesh_pattern p{};
    p.form = cellsV == 0 ? MESH_TRIANGLE_RING : MESH_RING;
    std::copy(sides.begin(), sides.end(), p.side);
    p.cells_u = cellsU;
    p.cells_v = cellsV;
    reference::placeLines(p, random);
    return p;
}

std::uint32_t segmentsAround(const mesh_pattern& p) { return p.side[0] + p.side[1] + p.side[2] + p.side[3]; }

bool hasPoint(const mesh_pattern& p) {
    return p.side[0] == 0 || p.side[1] == 0 || p.side[3] == 0 || (p.side[2] == 0 && p.form == MESH_RING);
}

// Whether it goes against mesh_shared.h's advice for patches with a side that is a point: two triangles may be one with two faces then.
bool mayFold(const mesh_pattern& p) {
    if ((p.form != MESH_RING && p.form != MESH_TRIANGLE_RING) || !hasPoint(p)) return false;
    if (p.form == MESH_TRIANGLE_RING) return p.cells_u < 2 || p.low_u != p.low_v || one - p.high_u != p.low_u;
    const bool even = p.low_u + p.high_u == one && p.low_v + p.high_v == one;
    return !even || p.cells_u < 3 || p.cells_v < 3;
}

using Edges = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

Edges directedEdges(const PatternDrawing& drawing) {
    Edges edges;
    for (const PatternTriangle& triangle : drawing.triangles)
        for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(triangle.corners[k].number, triangle.corners[(k + 1) % 3].number);
    std::sort(edges.begin(), edges.end());
    return edges;
}

// Edges whose opposites are missing, of those that are there more often than these; sorted.
Edges unmatched(const Edges& edges) {
    Edges opposite;
    for (const auto& [a, b] : edges) opposite.emplace_back(b, a);
    std::sort(opposite.begin(), opposite.end());
    Edges result;
    std::set_difference(edges.begin(), edges.end(), opposite.begin(), opposite.end(), std::back_inserter(result));
    return result;
}

// Inner edges lie in two triangles, border edges in one, and these are the loop.
void expectDisc(const mesh_pattern& p, const PatternDrawing& drawing) {
    const Edges edges = directedEdges(drawing);
    const std::uint32_t loop = patternLoop(p);
    Edges around;
    for (std::uint64_t i = 0; loop > 2 && i < loop; ++i) around.emplace_back(i, (i + 1) % loop);
    std::sort(around.begin(), around.end());
    ASSERT_EQ(unmatched(edges), around);
    if (mayFold(p)) return;
    ASSERT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end());
    // Euler: of a disc 1; of two segments around a patch, whose ends are the same, or of a point around it: a sphere's 2.
    const std::size_t undirected = (edges.size() + around.size()) / 2;
    ASSERT_EQ(patternVertices(p) + drawing.triangles.size() - undirected, loop > 2 ? 1U : 2U);
}

void expectCovers(const mesh_pattern& p, const PatternDrawing& drawing) {
    double area = drawing.gaps;
    for (const PatternTriangle& triangle : drawing.triangles) {
        ASSERT_GT(reference::areaOf(triangle.corners), 0.0);
        area += reference::areaOf(triangle.corners);
    }
    const bool quad = p.form == MESH_RIBBON_U || p.form == MESH_RIBBON_V || p.form == MESH_RING;
    ASSERT_NEAR(area, quad ? 1.0 : 0.5, 1e-12);
}

void expectTriangulates(const mesh_pattern& p) {
    SCOPED_TRACE(text(p));
    const PatternDrawing drawing = draw(p);
    ASSERT_EQ(drawing.triangles.size(), patternTriangles(p));
    std::vector<bool> used(patternVertices(p));
    for (const PatternTriangle& triangle : drawing.triangles) {
        const auto& [a, b, c] = triangle.corners;
        ASSERT_TRUE(a.number != b.number && b.number != c.number && c.number != a.number);
        for (const reference::PatternCorner& corner : triangle.corners) {
            ASSERT_LT(corner.number, used.size());
            used[corner.number] = true;
        }
    }
    // A ribbon between points may be a line.
    if (drawing.triangles.empty()) return;
    ASSERT_EQ(std::count(used.begin(), used.end(), false), 0);
    expectDisc(p, drawing);
    expectCovers(p, drawing);
}

// Calls with all numbers of segments from `least` to `most` on the sides whose bits are set in `sides`, 0 on others.
void forSides(unsigned sides, std::uint32_t least, std::uint32_t most, const std::function<void(std::array<std::uint32_t, 4>)>& call) {
    std::array<std::uint32_t, 4> at{};
    for (std::size_t s = 0; s < 4; ++s) at[s] = (sides >> s) & 1U ? least : 0;
    for (std::size_t s = 0; s < 4;) {
        call(at);
        for (s = 0; s < 4 && (((sides >> s) & 1U) == 0 || at[s] == most); ++s) at[s] = (sides >> s) & 1U ? least : 0;
        if (s < 4) ++at[s];
    }
}

TEST(MeshPattern, RingsAreTriangulations) {
    std::mt19937 random(1);
    std::uint32_t count = 0;
    forSides(15, 0, 6, [&](std::array<std::uint32_t, 4> sides) {
        // A loop of one segment ends where it begins: no triangulation has that.
        if (sides[0] + sides[1] + sides[2] + sides[3] == 1 || ::testing::Test::HasFatalFailure()) return;
        for (int k = 0; k < 6; ++k, ++count)
            expectTriangulates(ring(sides, 2 + count % 6, 2 + count / 6 % 6, count / 36 % 2 == 0 ? nullptr : &random));
    });
    EXPECT_EQ(count, 6U * (7 * 7 * 7 * 7 - 4));
}

TEST(MeshPattern, RibbonsAreTriangulations) {
    for (const std::uint32_t form : {MESH_RIBBON_U, MESH_RIBBON_V}) {
        forSides(15, 0, 6, [&](std::array<std::uint32_t, 4> sides) {
            const std::size_t end = form == MESH_RIBBON_U ? 1 : 0;
            if (sides[end] > 1 || sides[end + 2] > 1 || ::testing::Test::HasFatalFailure()) return;
            mesh_pattern p{};
            p.form = form;
            std::copy(sides.begin(), sides.end(), p.side);
            expectTriangulates(p);
        });
    }
}

TEST(MeshPattern, TriangleRingsAreTriangulations) {
    std::mt19937 random(2);
    forSides(11, 0, 6, [&](std::array<std::uint32_t, 4> sides) {
        if (sides[0] + sides[1] + sides[3] == 1 || ::testing::Test::HasFatalFailure()) return;
        for (std::uint32_t cells = 0; cells < 6; ++cells) {
            expectTriangulates(ring(sides, cells, 0));
            expectTriangulates(ring(sides, cells, 0, &random));
        }
    });
}

TEST(MeshPattern, TriangleGridsAndFansAreTriangulations) {
    for (std::uint32_t n = 1; n <= MESH_GRID_MOST; ++n) {
        mesh_pattern p{};
        p.form = MESH_TRIANGLE_GRID;
        p.cells_u = p.side[0] = p.side[1] = p.side[3] = n;
        expectTriangulates(p);
        for (const auto& [form, side] : {std::pair{MESH_FAN_0, 0}, {MESH_FAN_1, 1}, {MESH_FAN_3, 3}}) {
            mesh_pattern fan{};
            fan.form = form;
            fan.side[0] = fan.side[1] = fan.side[3] = 1;
            fan.side[side] = n;
            expectTriangulates(fan);
        }
    }
}

// Of the triangles of a transition region: a corner and the middle of the segment opposite, both along the side and counted in sides.
void expectNear(const mesh_pattern& p, int side) {
    SCOPED_TRACE(text(p) + ", side " + std::to_string(side));
    kernels::mesh_zip zip = kernels::mesh_side_zip(&p, side);
    const auto [first, last] = reference::endsBeside(p, side);
    const double o = zip.outer, n = zip.inner;
    const double low = static_cast<double>(first) / (2.0 * one), size = static_cast<double>(last - first) / (2.0 * one);
    std::uint32_t i = 0, k = 0;
    while (i < zip.outer || k < zip.inner) {
        const bool outer = kernels::mesh_zip_outer(&zip, i, k);
        const double middle = outer ? (i + 0.5) / o : low + size * (k + 0.5) / n;
        const double corner = outer ? low + size * k / n : i / o;
        const double half = (outer ? size / n : 1 / o) / 2 + 1e-12;
        // Before the inner line's first vertex and behind its last there is none nearer.
        ASSERT_TRUE((outer && k == zip.inner) || corner >= middle - half);
        ASSERT_TRUE((outer && k == 0) || corner <= middle + half);
        kernels::mesh_zip_step(&zip, outer);
        (outer ? i : k) += 1;
    }
    ASSERT_EQ(i, zip.outer);
    ASSERT_EQ(k, zip.inner);
}

TEST(MeshPattern, TransitionTrianglesAreNoLongerThanTheirSegments) {
    std::mt19937 random(3);
    for (int round = 0; round < 3000 && !HasFatalFailure(); ++round) {
        const mesh_pattern p = reference::randomPattern(random, 300);
        if (p.form != MESH_RING && p.form != MESH_TRIANGLE_RING) continue;
        for (const int side : {0, 1, 2, 3}) {
            if (p.side[side] == 0 || kernels::mesh_beside(&p, side) == 0) continue;
            expectNear(p, side);
        }
    }
}

TEST(MeshPattern, TakingManySegmentsAtOnceIsTakingOneByOne) {
    std::mt19937 random(4);
    for (int round = 0; round < 500 && !HasFatalFailure(); ++round) {
        const std::uint32_t low = upTo(random, one), high = 2 * one - upTo(random, one);
        kernels::mesh_zip zip = kernels::mesh_zip_of(upTo(random, 40), upTo(random, 40), low, round % 10 == 0 ? low : high);
        const kernels::mesh_zip start = zip;
        std::uint32_t i = 0;
        for (std::uint32_t t = 0; t <= start.outer + start.inner; ++t) {
            kernels::mesh_zip skipped = start;
            ASSERT_EQ(kernels::mesh_zip_skip(&skipped, t), i) << start.outer << " " << start.inner << " at " << t;
            ASSERT_EQ(skipped.lead, zip.lead);
            if (t == start.outer + start.inner) break;
            const bool outer = kernels::mesh_zip_outer(&zip, i, t - i);
            kernels::mesh_zip_step(&zip, outer);
            i += outer ? 1U : 0U;
        }
    }
}

TEST(MeshPattern, PlacesAreSymmetricAndRise) {
    for (const std::uint32_t count : {1U, 2U, 3U, 7U, 100U, 1023U, 65535U, 65536U}) {
        for (std::uint32_t i = 0; i <= count; ++i) {
            const int place = kernels::mesh_even(static_cast<int>(i), count);
            ASSERT_EQ(place + kernels::mesh_even(static_cast<int>(count - i), count), static_cast<int>(one));
            ASSERT_NEAR(place, static_cast<double>(i) / count * one, 1.01);
        }
        EXPECT_EQ(kernels::mesh_even(0, count), 0);
    }
}

TEST(MeshPattern, InnerLinesRiseFromTheFirstToTheLast) {
    std::mt19937 random(5);
    for (int round = 0; round < 2000 && !HasFatalFailure(); ++round) {
        const std::uint32_t cells = 1 + upTo(random, round % 50 == 0 ? 65533 : 99);
        const std::uint32_t low = upTo(random, one / 3), high = one - 1 - upTo(random, one / 3);
        int before = static_cast<int>(low) - 1;
        for (std::uint32_t k = 0; k <= cells; ++k) {
            const int at = kernels::mesh_line(low, high, cells, static_cast<int>(k));
            ASSERT_GT(at, before);
            before = at;
        }
        ASSERT_EQ(kernels::mesh_line(low, high, cells, 0), static_cast<int>(low));
        ASSERT_EQ(before, static_cast<int>(high)) << low << " to " << high << " in " << cells;
    }
}

// Units hold their triangles' vertices and, together, all of the pattern, in order.
void expectUnits(const mesh_pattern& p) {
    SCOPED_TRACE(text(p));
    const PatternDrawing drawing = draw(p);
    mesh_offset sum{};
    std::vector<bool> seen(patternVertices(p));
    std::vector<std::uint64_t> numbers;
    std::uint64_t repeated = 0;
    for (std::uint32_t unit = 0; unit < patternUnits(p); ++unit) {
        const mesh_offset before = unitsBefore(p, unit), behind = unitsBefore(p, unit + 1);
        ASSERT_EQ(before.units, unit);
        ASSERT_EQ(before.vertices, sum.vertices);
        ASSERT_EQ(before.triangles, sum.triangles);
        unitVertexNumbers(p, unit, numbers);
        for (const std::uint64_t number : numbers) {
            ASSERT_LT(number, seen.size());
            repeated += seen[number] ? 1U : 0U;
            seen[number] = true;
        }
        sum.vertices += numbers.size();
        sum.triangles = behind.triangles;
        std::sort(numbers.begin(), numbers.end());
        for (std::uint64_t t = before.triangles; t < behind.triangles; ++t)
            for (const reference::PatternCorner& corner : drawing.triangles.at(t).corners)
                ASSERT_TRUE(std::binary_search(numbers.begin(), numbers.end(), corner.number)) << "unit " << unit << ", triangle " << t;
    }
    ASSERT_EQ(unitsBefore(p, patternUnits(p)).vertices, sum.vertices);
    ASSERT_EQ(sum.triangles, patternTriangles(p));
    ASSERT_EQ(sum.vertices - repeated, patternVertices(p));
}

std::vector<mesh_pattern> densePatterns() {
    return {ring({100, 100, 100, 100}, 100, 100), ring({7, 0, 65536, 1}, 65536, 2),  ring({65536, 2, 1, 3}, 2, 65536),
            ring({5, 9000, 0, 40}, 3, 3),         ring({300, 300, 0, 300}, 300, 0),  ring({1, 5000, 0, 0}, 7, 0),
            ring({0, 0, 0, 900}, 64, 64),         ring({1, 1, 1, 1}, 4098, 5),       ring({65536, 0, 0, 65536}, 1, 0),
            ring({10, 10, 10, 10}, 66, 66),       ring({300, 299, 0, 301}, 1000, 0), ring({64, 64, 64, 64}, 700, 90)};
}

TEST(MeshPattern, UnitsMakeUpThePattern) {
    std::size_t cut = 0;
    for (const mesh_pattern& p : densePatterns()) {
        expectUnits(p);
        cut += patternUnits(p) > 1 ? 1U : 0U;
    }
    EXPECT_EQ(cut, densePatterns().size());
    std::mt19937 random(6);
    for (int round = 0; round < 400 && !HasFatalFailure(); ++round) expectUnits(reference::randomPattern(random, 150));
}

// Two rows of vertices are a band's least.
TEST(MeshPattern, UnitsAreBounded) {
    for (const mesh_pattern& p : densePatterns()) {
        const std::uint64_t width = kernels::mesh_inner_cells(&p) + 1;
        for (std::uint32_t unit = kernels::mesh_cut_sides(&p); unit < patternUnits(p); ++unit) {
            const std::uint64_t vertices = unitsBefore(p, unit + 1).vertices - unitsBefore(p, unit).vertices;
            EXPECT_LE(vertices, std::max<std::uint64_t>(MESH_UNIT_VERTICES, 2 * width)) << text(p);
        }
    }
}

// Beyond 2^32 numbers don't start again from 0.
TEST(MeshPattern, TheDensestPatternsLastLineHasItsLastVertices) {
    const mesh_pattern p = ring({65536, 65536, 65536, 65536}, 65536, 65536);
    std::vector<std::uint64_t> numbers;
    unitVertexNumbers(p, 2, numbers);
    ASSERT_GT(patternVertices(p), std::uint64_t{1} << 32U);
    EXPECT_EQ(numbers.back(), patternVertices(p) - 1);
    unitVertexNumbers(p, 1, numbers);
    EXPECT_EQ(numbers.back(), patternVertices(p) - 1);
    unitVertexNumbers(p, 3, numbers);
    EXPECT_EQ(numbers.back(), patternVertices(p) - 65535);
}

TEST(MeshPattern, CellsAreFoundInPairs) {
    std::mt19937 random(7);
    std::size_t cells = 0;
    for (int round = 0; round < 2000 && !HasFatalFailure(); ++round) {
        const mesh_pattern p = reference::randomPattern(random, 90);
        const PatternDrawing drawing = draw(p);
        for (std::uint32_t unit = 0; unit < patternUnits(p); ++unit) {
            const std::uint64_t first = unitsBefore(p, unit).triangles, end = unitsBefore(p, unit + 1).triangles;
            const std::uint64_t paired = first + firstCellTriangle(p, unit);
            ASSERT_LE(paired, end);
            ASSERT_EQ((end - paired) % 2, 0U);
            for (std::uint64_t t = paired; t < end; t += 2, ++cells) {
                const auto &a = drawing.triangles[t].corners, &b = drawing.triangles[t + 1].corners;
                ASSERT_EQ(a[0].number, b[0].number) << text(p);
                ASSERT_EQ(a[2].number, b[1].number) << text(p);
            }
            for (std::uint64_t t = first; t < paired && p.form == MESH_RING; ++t) ASSERT_NE(drawing.triangles[t].region, 4);
        }
    }
    EXPECT_GT(cells, 10000U);
}

TEST(MeshPattern, SidesVerticesAreTheLoops) {
    std::mt19937 random(8);
    for (int round = 0; round < 2000; ++round) {
        const mesh_pattern p = reference::randomPattern(random, 12);
        if (p.form == MESH_NOTHING || segmentsAround(p) == 0) continue;
        std::uint32_t next = 0;
        const std::uint32_t loop = patternLoop(p);
        for (const int side : {0, 1, 2, 3}) {
            const std::uint32_t segments = p.side[side];
            for (std::uint32_t i = 0; i <= segments; ++i)
                ASSERT_EQ(loopVertex(p, side, side < 2 ? i : segments - i), (next + i) % loop) << text(p) << ", side " << side;
            next += segments;
        }
    }
}

}  // namespace
}  // namespace tessera
