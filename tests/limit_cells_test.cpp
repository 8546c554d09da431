// What is drawn of subdivision surfaces against the limit by subdivision alone: cells, patches put together, and the Gregory surface.
#include "subdivision/limit_cells.h"
#include "cell_checks.h"
#include "patch_eval.h"
#include "subdivision/refiner.h"
#include "subdivision_shapes.h"
#include "tessera/subdivision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

using subdivision::Cell;

constexpr double kTolerance = 2e-6;     // of patches at irregular vertices, of the cage's size
constexpr double kMostDistance = 1e-5;  // of the cage's size
constexpr double kMostDegrees = 0.1;

struct Subdivided {
    explicit Subdivided(const NamedCage& shape)
        : refiner(subdivision::makeRefiner(shape.cage)),
          domains(subdivision::makeDomains(*refiner)),
          size(sizeOf(shape.cage)),
          reference(shape.cage) {
        cells = subdivision::limitCells(*refiner, shape.cage.points, domains, {kTolerance * size}, &counts);
    }

    std::unique_ptr<subdivision::Refiner> refiner;
    subdivision::QuadDomains domains;
    double size;
    CatmullClarkReference reference;
    subdivision::LimitCounts counts;
    std::vector<Cell> cells;
};

// Cells by chance, and as many of the deepest.
std::vector<const Cell*> chosen(const std::vector<Cell>& cells, std::size_t count, std::mt19937& random) {
    std::vector<const Cell*> all;
    all.reserve(cells.size());
    for (const Cell& cell : cells) all.push_back(&cell);
    std::shuffle(all.begin(), all.end(), random);
    const std::size_t deepest = std::min(2 * count, all.size()), first = std::min(count, all.size());
    std::partial_sort(all.begin() + static_cast<std::ptrdiff_t>(first), all.begin() + static_cast<std::ptrdiff_t>(deepest), all.end(),
                      [](const Cell* a, const Cell* b) { return a->levelU + a->levelV > b->levelU + b->levelV; });
    all.resize(deepest);
    return all;
}

double eighth(std::mt19937& random) { return static_cast<double>(random() % 9U) / 8.0; }

TEST(LimitCells, CoverTheirDomainsOnce) {
    for (const NamedCage& shape : everyShape(3, 2)) {
        const Subdivided subdivided(shape);
        std::vector<double> areas(subdivided.domains.domains.size());
        for (const Cell& cell : subdivided.cells) {
            ASSERT_LE(std::max(cell.levelU, cell.levelV), 15U);
            ASSERT_LT(cell.u >> cell.levelU, 1U);
            ASSERT_LT(cell.v >> cell.levelV, 1U);
            areas.at(cell.domain) += std::ldexp(1.0, -static_cast<int>(cell.levelU + cell.levelV));
        }
        for (const double area : areas) ASSERT_EQ(area, 1.0) << shape.name;
    }
}

// Whether the surface comes to a tangent plane where the cell touches its domain's corner. At the tip of a cone normals have no limit, and
// no patch that ends there can have them all.
bool hasPlaneAtCorner(const DomainLimit& limit, const Cell& cell) {
    const glm::dvec2 lower = inDomain(cell, 0.0, 0.0), upper = inDomain(cell, 1.0, 1.0);
    return limit.at(upper.x == 1.0 ? 1.0 : lower.x, upper.y == 1.0 ? 1.0 : lower.y).hasNormal;
}

// Whether the cell at an irregular corner may be off: where faces were halved as often as they may be (around a vertex of many
// faces a surface looks like a cone however near one comes), and where the single precision of points would not hold a tenth of a degree.
bool isLastOfAll(const Cell& cell, const subdivision::QuadDomain& domain, double size) {
    const double width = std::max(glm::distance(cell.points[0], cell.points[15]), glm::distance(cell.points[3], cell.points[12]));
    return touchesCorner(cell) && (width < 1e-4 * size || cell.levelU + (domain.subFace >= 0 ? 1U : 0U) >= 15U);
}

// At the same parameters, but in the last cells at corners, which may slide along the surface.
TEST(LimitCells, LieOnTheLimitSurface) {
    std::mt19937 random(3);
    std::size_t slid = 0, points = 0;
    for (const NamedCage& shape : allShapes()) {
        const Subdivided subdivided(shape);
        double distance = 0.0, lastDistance = 0.0, degrees = 0.0;
        for (const Cell* cell : chosen(subdivided.cells, 10, random)) {
            const DomainLimit limit(subdivided.reference, subdivided.domains.domains[cell->domain]);
            for (int k = 0; k < 3; ++k) {
                const double s = eighth(random), t = eighth(random);
                const CellPoint found = evaluateCell(cell->kind, cell->points, s, t);
                const glm::dvec2 uv = inDomain(*cell, s, t);
                LimitPoint expected = limit.at(uv.x, uv.y);
                double apart = glm::distance(found.position, expected.position);
                ++points;
                if (apart > 0.1 * kTolerance * subdivided.size && touchesCorner(*cell)) {
                    const double step = std::ldexp(0.25, -static_cast<int>(std::max(cell->levelU, cell->levelV)));
                    const auto nearest = limit.nearest(found.position, uv.x, uv.y, step, 0.1 * kTolerance * subdivided.size);
                    expected = nearest.point;
                    apart = nearest.distance;
                    ++slid;
                }
                const bool tip = touchesCorner(*cell) && cell->levelU > 0 && !hasPlaneAtCorner(limit, *cell);
                const bool last = isLastOfAll(*cell, subdivided.domains.domains[cell->domain], subdivided.size);
                (tip || last ? lastDistance : distance) = std::max(tip || last ? lastDistance : distance, apart / subdivided.size);
                if (!last && !tip && expected.hasNormal && found.normal != glm::dvec3(0.0))
                    degrees = std::max(degrees, degreesBetween(found.normal, expected.normal));
            }
        }
        EXPECT_LT(distance, kMostDistance) << shape.name;
        EXPECT_LT(lastDistance, 2.0 * kMostDistance) << shape.name;
        EXPECT_LT(degrees, kMostDegrees) << shape.name;
    }
    EXPECT_GT(points, 8000U);
    EXPECT_GT(slid, 50U);
}

// In single precision, and where they were cut for their neighbours' sake, patches are still what their domain's cells are.
TEST(LimitCells, StayWhereTheyAreWhenPutTogether) {
    std::mt19937 random(4);
    for (const NamedCage& shape : everyShape(3)) {
        const Subdivided subdivided(shape);
        std::vector<std::vector<const Cell*>> ofDomain(subdivided.domains.domains.size());
        for (const Cell& cell : subdivided.cells) ofDomain[cell.domain].push_back(&cell);
        const subdivision::StitchedMeshes stitched = subdivision::stitch(subdivided.domains, subdivided.cells, false);
        ASSERT_GE(stitched.bezierDomains.size(), subdivided.cells.size()) << shape.name;
        ASSERT_TRUE(stitched.gregoryDomains.empty());
        double distance = 0.0;
        for (int k = 0; k < 40; ++k) {
            const std::size_t patch = random() % stitched.bezierDomains.size();
            const std::vector<glm::dvec3> points = reference::patchPoints(stitched.bezier, patch);
            const CellPoint found = evaluateCell(PatchKind::bezier, points, eighth(random), eighth(random));
            const CellPoint expected = nearestOnCells(ofDomain[stitched.bezierDomains[patch]], found.position, 1e-7 * subdivided.size);
            distance = std::max(distance, glm::distance(found.position, expected.position) / subdivided.size);
        }
        EXPECT_LT(distance, 2e-6) << shape.name;
    }
}

bool isSmooth(const Cage& cage) { return cage.creases.empty() && cage.corners.empty(); }

// The Gregory surface is told to be as far away as it is; at more than a few places at least.
TEST(GregorySurface, IsNoFartherThanReported) {
    std::size_t seen = 0;
    for (const NamedCage& shape : everyShape(3, 1)) {
        Scene exact = sceneOf(shape), gregory = exact;
        static_cast<void>(subdivide(exact));
        SubdivisionOptions options;
        options.surface = SubdivisionSurface::gregory;
        const std::vector<CageReport> reports = subdivide(gregory, options);
        ASSERT_EQ(reports.size(), 1U);
        const double size = sizeOf(shape.cage), reported = reports.front().limitDistance;
        if (isSmooth(shape.cage)) {
            EXPECT_LT(reported, 0.01 * size) << shape.name;
        }
        std::vector<Cell> cells;
        for (const Mesh& mesh : exact.meshes) {
            for (std::size_t patch = 0; patch * pointsPerPatch(mesh.kind) < mesh.points.size(); ++patch) {
                Cell& cell = cells.emplace_back();
                cell.kind = mesh.kind;
                const std::vector<glm::dvec3> points = reference::patchPoints(mesh, patch);
                std::copy(points.begin(), points.end(), cell.points.begin());
            }
        }
        std::vector<const Cell*> all;
        all.reserve(cells.size());
        for (const Cell& cell : cells) all.push_back(&cell);
        std::mt19937 random(5);
        double measured = 0.0;
        for (const Mesh& mesh : gregory.meshes) {
            const std::size_t patches = mesh.points.size() / pointsPerPatch(mesh.kind);
            for (std::size_t k = 0; patches > 0 && k < 12; ++k) {
                const std::vector<glm::dvec3> points = reference::patchPoints(mesh, random() % patches);
                const CellPoint at = evaluateCell(mesh.kind, points, eighth(random), eighth(random));
                measured = std::max(measured, glm::distance(at.position, nearestOnCells(all, at.position, 1e-6 * size).position));
            }
        }
        // What it reports is the greatest that it found at places of its own.
        EXPECT_LE(measured, 1.1 * reported + 1e-5 * size) << shape.name;
        seen += measured > 1e-4 * size ? 1U : 0U;
    }
    EXPECT_GT(seen, 5U);
}

}  // namespace
}  // namespace tessera::test
