// A patch's tessellation on the host, drawn from its pattern's numbering, and how far it is from the surface.
#include "pattern_drawing.h"

#include "device/lanes_host.h"

#include <algorithm>
#include <span>

// clang-format off
#include "device/kernel_headers_begin.h"
namespace tessera::kernels {
#include "mesh/pattern.clh"
}  // namespace tessera::kernels
#include "device/kernel_headers_end.h"
// clang-format on

namespace tessera::test {
namespace {

using kernels::mesh_zip;

constexpr double one = 16777216.0;

void addLoop(const mesh_pattern& p, PatternDrawing& drawing) {
    const bool triangle = p.form >= MESH_TRIANGLE_RING;
    for (int s = 0; s < 4; ++s) {
        for (std::uint32_t i = 0; i < p.side[s]; ++i) {
            const std::uint32_t along = s < 2 ? i : p.side[s] - i;
            const double t = kernels::mesh_even(static_cast<int>(along), p.side[s]) / one;
            const std::array<glm::dvec2, 4> at{glm::dvec2(t, 0), glm::dvec2(triangle ? 1 - t : 1, t), glm::dvec2(t, 1), glm::dvec2(0, t)};
            drawing.vertices.push_back(at[static_cast<std::size_t>(s)]);
        }
    }
    drawing.onPoint.assign(kernels::mesh_vertex_count(&p), -1);
    for (int s = 0; s < (triangle ? 0 : 4); ++s) {
        if (p.side[s] == 0) drawing.onPoint[kernels::mesh_loop_vertex(&p, s, 0)] = s;
    }
}

void addInner(const mesh_pattern& p, PatternDrawing& drawing) {
    if (!kernels::mesh_has_inner(&p)) return;
    for (std::uint32_t j = 0; j <= kernels::mesh_inner_rows(&p); ++j) {
        for (std::uint32_t i = 0; i < kernels::mesh_row_vertices(&p, j); ++i) {
            drawing.vertices.emplace_back(kernels::mesh_column_place(&p, static_cast<int>(i)) / one,
                                          kernels::mesh_row_place(&p, static_cast<int>(j)) / one);
        }
    }
}

void addTriangle(PatternDrawing& drawing, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) drawing.triangles.push_back({a, b, c});
}

// Between two lines, both in the side's direction; `turned`: whether the second is on the right.
void addZip(PatternDrawing& drawing, mesh_zip zip, std::span<const std::uint32_t> outer, std::span<const std::uint32_t> inner,
            bool turned) {
    std::uint32_t i = 0;
    std::uint32_t k = 0;
    while (i < zip.outer || k < zip.inner) {
        const bool next = kernels::mesh_zip_outer(&zip, i, k);
        const std::uint32_t to = next ? outer[i + 1] : inner[k + 1];
        if (turned)
            addTriangle(drawing, outer[i], inner[k], to);
        else
            addTriangle(drawing, outer[i], to, inner[k]);
        kernels::mesh_zip_step(&zip, next);
        i += next ? 1 : 0;
        k += next ? 0 : 1;
    }
}

std::vector<std::uint32_t> loopOf(const mesh_pattern& p, int s) {
    std::vector<std::uint32_t> line;
    for (std::uint32_t i = 0; i <= p.side[s]; ++i) line.push_back(kernels::mesh_loop_vertex(&p, s, i));
    return line;
}

void addRing(const mesh_pattern& p, PatternDrawing& drawing) {
    const bool triangle = p.form == MESH_TRIANGLE_RING;
    for (int s = 0; s < 4; ++s) {
        if (triangle && s == 2) continue;
        std::vector<std::uint32_t> inner;
        for (std::uint32_t k = 0; k <= kernels::mesh_beside(&p, s); ++k) inner.push_back(kernels::mesh_beside_vertex(&p, s, k));
        addZip(drawing, kernels::mesh_side_zip(&p, s), loopOf(p, s), inner, s >= 2);
    }
}

void addCells(const mesh_pattern& p, PatternDrawing& drawing) {
    const bool triangle = p.form == MESH_TRIANGLE_RING;
    const std::uint32_t cells = kernels::mesh_inner_cells(&p);
    for (std::uint32_t j = 0; j < kernels::mesh_inner_rows(&p); ++j) {
        for (std::uint32_t i = 0; i < cells - (triangle ? j : 0); ++i) {
            const std::uint32_t a = kernels::mesh_inner_vertex(&p, i, j);
            const std::uint32_t d = kernels::mesh_inner_vertex(&p, i, j + 1);
            if (!triangle) {
                addTriangle(drawing, a, a + 1, d + 1);
                addTriangle(drawing, a, d + 1, d);
                continue;
            }
            addTriangle(drawing, a, a + 1, d);
            if (i + 1 < cells - j) addTriangle(drawing, a + 1, d + 1, d);
        }
    }
}

void addRibbon(const mesh_pattern& p, PatternDrawing& drawing) {
    const bool alongU = p.form == MESH_RIBBON_U;
    const std::vector<std::uint32_t> outer = loopOf(p, alongU ? 0 : 3);
    const std::vector<std::uint32_t> inner = loopOf(p, alongU ? 2 : 1);
    addZip(drawing, kernels::mesh_zip_of(p.side[alongU ? 0 : 3], p.side[alongU ? 2 : 1], 0, 2 * MESH_ONE), outer, inner, !alongU);
}

void addFan(const mesh_pattern& p, PatternDrawing& drawing, int side, std::uint32_t tip) {
    const std::vector<std::uint32_t> line = loopOf(p, side);
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        if (side == 3)
            addTriangle(drawing, line[i + 1], line[i], tip);
        else
            addTriangle(drawing, line[i], line[i + 1], tip);
    }
}

}  // namespace

PatternDrawing drawPattern(const mesh_pattern& p) {
    if (p.form == MESH_NOTHING) return {};
    if (p.form == MESH_TRIANGLE_GRID) return drawTriangleGrid(p.cells_u);
    PatternDrawing drawing;
    addLoop(p, drawing);
    addInner(p, drawing);
    if (p.form == MESH_RIBBON_U || p.form == MESH_RIBBON_V) addRibbon(p, drawing);
    if (p.form == MESH_FAN_0) addFan(p, drawing, 0, kernels::mesh_loop_vertex(&p, 3, 1));
    if (p.form == MESH_FAN_1) addFan(p, drawing, 1, 0);
    if (p.form == MESH_FAN_3) addFan(p, drawing, 3, p.side[0]);
    if (kernels::mesh_has_ring(&p)) {
        addRing(p, drawing);
        addCells(p, drawing);
    }
    return drawing;
}

PatternDrawing drawGrid(std::uint32_t m, std::uint32_t n) {
    PatternDrawing drawing;
    for (std::uint32_t j = 0; j <= n; ++j) {
        for (std::uint32_t i = 0; i <= m; ++i) drawing.vertices.emplace_back(static_cast<double>(i) / m, static_cast<double>(j) / n);
    }
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < m; ++i) {
            const std::uint32_t a = j * (m + 1) + i;
            addTriangle(drawing, a, a + 1, a + m + 2);
            addTriangle(drawing, a, a + m + 2, a + m + 1);
        }
    }
    drawing.onPoint.assign(drawing.vertices.size(), -1);
    return drawing;
}

PatternDrawing drawTriangleGrid(std::uint32_t m) {
    PatternDrawing drawing;
    for (std::uint32_t j = 0; j <= m; ++j) {
        for (std::uint32_t i = 0; i <= m - j; ++i) drawing.vertices.emplace_back(static_cast<double>(i) / m, static_cast<double>(j) / m);
    }
    std::uint32_t row = 0;
    for (std::uint32_t j = 0; j < m; ++j) {
        const std::uint32_t above = row + m - j + 1;
        for (std::uint32_t i = 0; i < m - j; ++i) {
            addTriangle(drawing, row + i, row + i + 1, above + i);
            if (i + 1 < m - j) addTriangle(drawing, row + i + 1, above + i + 1, above + i);
        }
        row = above;
    }
    drawing.onPoint.assign(drawing.vertices.size(), -1);
    return drawing;
}

double distanceTo(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& point) {
    const glm::dvec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const double area = glm::length(normal);
    bool inside = area > 0.0;
    double nearest = 1e300;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3& a = triangle[k];
        const glm::dvec3 edge = triangle[(k + 1) % 3] - a;
        inside = inside && glm::dot(glm::cross(edge, point - a), normal) >= 0.0;
        const double along = glm::dot(edge, edge);
        const double t = along > 0.0 ? std::clamp(glm::dot(point - a, edge) / along, 0.0, 1.0) : 0.0;
        nearest = std::min(nearest, glm::length(point - a - t * edge));
    }
    return inside ? std::min(nearest, std::abs(glm::dot(point - triangle[0], normal)) / area) : nearest;
}

double greatest(const PatternDrawing& drawing, const Surface& surface, const Measure& measure, int steps, double enough) {
    std::vector<glm::dvec3> positions;
    positions.reserve(drawing.vertices.size());
    for (const glm::dvec2& at : drawing.vertices) positions.push_back(surface(at.x, at.y));
    double most = 0.0;
    for (const std::array<std::uint32_t, 3>& t : drawing.triangles) {
        std::array<glm::dvec2, 3> at{drawing.vertices[t[0]], drawing.vertices[t[1]], drawing.vertices[t[2]]};
        // A side that is a point is one at any parameter: below the middle of what lies opposite.
        for (std::size_t k = 0; k < 3; ++k) {
            if (drawing.onPoint[t[k]] < 0) continue;
            const glm::dvec2 middle = 0.5 * (at[(k + 1) % 3] + at[(k + 2) % 3]);
            const int side = drawing.onPoint[t[k]];
            const double edge = side == 1 || side == 2 ? 1.0 : 0.0;
            const glm::dvec2 moved = side % 2 == 0 ? glm::dvec2(middle.x, edge) : glm::dvec2(edge, middle.y);
            if (glm::length(surface(moved.x, moved.y) - positions[t[k]]) < 1e-9) at[k] = moved;
        }
        const std::array<glm::dvec3, 3> corners{positions[t[0]], positions[t[1]], positions[t[2]]};
        for (int j = 0; j <= steps; ++j) {
            for (int i = j == 0 || j == steps ? 1 : 0; i <= steps - j; ++i) {
                if (i == steps) continue;
                const double b = static_cast<double>(i) / steps;
                const double c = static_cast<double>(j) / steps;
                const glm::dvec2 uv = (1.0 - b - c) * at[0] + b * at[1] + c * at[2];
                most = std::max(most, measure(surface(uv.x, uv.y), corners));
            }
        }
        if (most > enough) return most;
    }
    return most;
}

double farthestAtEqualPlaces(const PatternDrawing& drawing, const Surface& surface, int steps, double enough) {
    double most = 0.0;
    for (const std::array<std::uint32_t, 3>& t : drawing.triangles) {
        const std::array<glm::dvec2, 3> at{drawing.vertices[t[0]], drawing.vertices[t[1]], drawing.vertices[t[2]]};
        const std::array<glm::dvec3, 3> corners{surface(at[0].x, at[0].y), surface(at[1].x, at[1].y), surface(at[2].x, at[2].y)};
        for (int j = 0; j <= steps; ++j) {
            for (int i = 0; i <= steps - j; ++i) {
                const double b = static_cast<double>(i) / steps, c = static_cast<double>(j) / steps, a = 1.0 - b - c;
                const glm::dvec2 uv = a * at[0] + b * at[1] + c * at[2];
                most = std::max(most, glm::length(surface(uv.x, uv.y) - (a * corners[0] + b * corners[1] + c * corners[2])));
            }
        }
        if (most > enough) return most;
    }
    return most;
}

double farthest(const PatternDrawing& drawing, const Surface& surface, int steps, double enough) {
    std::vector<glm::dvec3> positions;
    positions.reserve(drawing.vertices.size());
    for (const glm::dvec2& at : drawing.vertices) positions.push_back(surface(at.x, at.y));
    double most = 0.0;
    // A point may have moved along the surface, to another triangle.
    const auto nearest = [&](const glm::dvec3& point, const std::array<glm::dvec3, 3>& own) {
        double least = distanceTo(own, point);
        for (const std::array<std::uint32_t, 3>& t : drawing.triangles) {
            if (least <= most) break;
            least = std::min(least, distanceTo({positions[t[0]], positions[t[1]], positions[t[2]]}, point));
        }
        most = std::max(most, least);
        return least;
    };
    return greatest(drawing, surface, nearest, steps, enough);
}

}  // namespace tessera::test
