// Loop's surfaces as PN triangles: closed to the bit, near the limit surface, smooth but at creases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "cage_host.h"
#include "subdivide_host.h"

namespace tessera {

namespace {

using test::cubeCage;
using test::loneAndCreasedSides;
using test::Made;
using test::octahedron;
using test::subdivided;
using test::withTolerance;

TEST(SubdivideLoop, LoopSurfacesAreClosedToTheBitAndNearTheLimit) {
    const Made made = subdivided(octahedron(), SubdivisionScheme::loop, withTolerance(1e-3));
    EXPECT_EQ(made.mesh().kind, PatchKind::pn);
    EXPECT_FALSE(made.mesh().welded);
    EXPECT_EQ(loneAndCreasedSides(made.mesh()), (std::pair<std::size_t, std::size_t>{0, 0}));
    EXPECT_GT(made.report.limitDistance, 0.0);
    EXPECT_LT(made.report.limitDistance, 2e-3);
    EXPECT_TRUE(made.report.notes.empty());
    // A vertex of valence 4 (Loop's own weights, 1987): beta = 0.484375 / 4, and the limit's weight of the middle 3 / (3 + 8 * 4 * beta).
    const double beta = (0.625 - 0.140625) / 4.0, middle = 0.375 / (0.375 + 4.0 * beta);
    double nearest = 1.0;
    for (const glm::vec3& p : made.mesh().points) nearest = std::min<double>(nearest, glm::length(p - glm::vec3(0.0F, 0.0F, middle)));
    EXPECT_LT(nearest, 1e-6);
}

TEST(SubdivideLoop, LoopGoesDeeperForSmallerTolerancesAndTellsOfItsDistance) {
    double last = 1.0;
    for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
        const CageReport report = subdivided(octahedron(), SubdivisionScheme::loop, withTolerance(tolerance)).report;
        EXPECT_LE(report.limitDistance, 2.0 * tolerance);
        EXPECT_EQ(report.patches, 8U << (2 * report.deepestLevel));
        EXPECT_LT(report.limitDistance, last);
        last = report.limitDistance;
    }
    const CageReport report = subdivided(octahedron(), SubdivisionScheme::loop, withTolerance(1e-9)).report;
    EXPECT_EQ(report.deepestLevel, 5U);
    ASSERT_EQ(report.notes.size(), 1U);
    EXPECT_NE(report.notes[0].find("from the limit surface"), std::string::npos);
}

TEST(SubdivideLoop, LoopCutsOtherFacesIntoTrianglesWithANoteAndPartsNormalsAtCreases) {
    Cage cube = cubeCage();
    for (const std::uint32_t vertex : cube.faceVertices) cube.faceTexturePoints.push_back(vertex);
    for (const glm::vec3& point : cube.points) cube.texturePoints.emplace_back(point.x, point.y);
    const Made smooth = subdivided(cube, SubdivisionScheme::loop, withTolerance(1e-2));
    ASSERT_FALSE(smooth.report.notes.empty());
    EXPECT_EQ(smooth.report.notes[0], "6 faces of more than three corners cut into triangles, as scheme loop wants");
    EXPECT_EQ(smooth.report.faces, 12U);
    EXPECT_EQ(loneAndCreasedSides(smooth.mesh()), (std::pair<std::size_t, std::size_t>{0, 0}));
    EXPECT_EQ(smooth.mesh().textureNets.size(), smooth.mesh().points.size());

    for (const float sharpness : {10.0F, 2.5F}) {
        // Around the top, so that no vertex has three.
        cube.creases = {{4, 5, sharpness}, {5, 7, sharpness}, {7, 6, sharpness}, {6, 4, sharpness}};
        const Made made = subdivided(cube, SubdivisionScheme::loop, withTolerance(1e-2));
        const auto [lone, creased] = loneAndCreasedSides(made.mesh());
        EXPECT_EQ(lone, 0U);
        // What is sharp for some levels only is smooth in the end.
        EXPECT_EQ(creased, sharpness < 10.0F ? 0U : 8U << made.report.deepestLevel);
    }
}

}  // namespace

}  // namespace tessera
