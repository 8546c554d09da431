// The sheet's points, and their change of basis.
#include "mesh/sheet.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace tessera::bench {

namespace {

// Four points of a uniform cubic B-spline to those of its Bezier curve.
std::array<glm::dvec3, 4> bezierOf(const std::array<glm::dvec3, 4>& p) {
    return {(p[0] + 4.0 * p[1] + p[2]) / 6.0, (2.0 * p[1] + p[2]) / 3.0, (p[1] + 2.0 * p[2]) / 3.0, (p[1] + 4.0 * p[2] + p[3]) / 6.0};
}

void appendPatch(const Sheet& sheet, int column, int row, std::vector<glm::vec3>& points) {
    std::array<std::array<glm::dvec3, 4>, 4> rows;
    for (int j = 0; j < 4; ++j) {
        std::array<glm::dvec3, 4> line;
        for (int i = 0; i < 4; ++i) {
            line[static_cast<std::size_t>(i)] = sheet.points[sheet.indexOf(column + i, row + j)];
        }
        rows[static_cast<std::size_t>(j)] = bezierOf(line);
    }
    std::array<std::array<glm::dvec3, 4>, 4> columns;
    for (std::size_t i = 0; i < 4; ++i) columns[i] = bezierOf({rows[0][i], rows[1][i], rows[2][i], rows[3][i]});
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i < 4; ++i) points.emplace_back(columns[i][j]);
    }
}

std::array<double, 4> bernstein(double t) {
    const double s = 1.0 - t;
    return {s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t};
}

}  // namespace

Sheet makeSheet(int along) {
    Sheet sheet;
    sheet.along = along;
    const double middle = 0.5 * (sheet.pointsAlong() - 1);
    for (int j = 0; j < sheet.pointsAlong(); ++j) {
        for (int i = 0; i < sheet.pointsAlong(); ++i) {
            const double x = i - middle;
            const double y = j - middle;
            sheet.points.emplace_back(x, y, 3.0 * std::sin(0.9 * x + 0.2 * y) * std::cos(0.8 * y));
        }
    }
    return sheet;
}

std::vector<glm::vec3> bezierPoints(const Sheet& sheet) {
    std::vector<glm::vec3> points;
    points.reserve(16 * static_cast<std::size_t>(sheet.along) * static_cast<std::size_t>(sheet.along));
    for (int row = 0; row < sheet.along; ++row) {
        for (int column = 0; column < sheet.along; ++column) appendPatch(sheet, column, row, points);
    }
    return points;
}

glm::dvec3 bezierPoint(const glm::vec3* patch, double u, double v) {
    const std::array<double, 4> bu = bernstein(u);
    const std::array<double, 4> bv = bernstein(v);
    glm::dvec3 sum(0.0);
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i < 4; ++i) sum += bv[j] * bu[i] * glm::dvec3(patch[4 * j + i]);
    }
    return sum;
}

}  // namespace tessera::bench
