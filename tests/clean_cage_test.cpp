// cleanCage() makes a surface of any cage, and tells of it; OpenSubdiv takes whatever comes out.
#include "subdivision/clean_cage.h"

#include <gtest/gtest.h>
#include <opensubdiv/bfr/refinerSurfaceFactory.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "cage_host.h"
#include "subdivision/refiner.h"
#include "tessera/error.h"

namespace tessera {

namespace {

using subdivision::CleanCage;
using subdivision::cleanCage;
using test::addFace;
using test::cageOf;
using test::cubeCage;
using test::scatteredPoints;

struct Cleaned {
    CleanCage clean;
    CageReport report;
};

Cleaned cleaned(const Cage& cage, double angle = 180.0) {
    Cleaned made;
    made.clean = cleanCage(cage, angle, made.report);
    return made;
}

// That it is what clean_cage.h promises, in the eyes of OpenSubdiv too.
void expectSurface(const Cage& cage) {
    EXPECT_TRUE(test::isOrientedSurface(cage));
    EXPECT_TRUE(test::hasOneFanAVertex(cage));
    if (cage.faceCount() == 0) return;
    const auto refiner = subdivision::makeRefiner(cage);
    const auto& level = refiner->GetLevel(0);
    ASSERT_EQ(level.GetNumVertices(), static_cast<int>(cage.points.size()));
    for (int edge = 0; edge < level.GetNumEdges(); ++edge) EXPECT_FALSE(level.IsEdgeNonManifold(edge));
    for (int vertex = 0; vertex < level.GetNumVertices(); ++vertex) EXPECT_FALSE(level.IsVertexNonManifold(vertex));
}

// Bfr makes surfaces of all faces without reading out of bounds.
void makeLimitSurfaces(const Cage& cage) {
    const auto refiner = subdivision::makeRefiner(cage);
    using Factory = OpenSubdiv::Bfr::RefinerSurfaceFactory<>;
    const Factory factory(*refiner, Factory::Options().SetApproxLevelSmooth(2).SetApproxLevelSharp(2));
    OpenSubdiv::Bfr::Surface<double> surface;
    for (int face = 0; face < factory.GetNumFaces(); ++face) factory.InitVertexSurface(face, &surface);
}

std::string refusal(const Cage& cage) {
    try {
        cleaned(cage);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

bool hasNote(const CageReport& report, const std::string& part) {
    return std::any_of(report.notes.begin(), report.notes.end(),
                       [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

TEST(CleanCage, LeavesACleanCageAsItIs) {
    Cage cube = cubeCage();
    cube.creases = {{0, 1, 2.5F}};
    cube.corners = {{7, 3.0F}};
    cube.holes = {2};
    const auto [clean, report] = cleaned(cube);
    EXPECT_EQ(clean.cage.faceVertices, cube.faceVertices);
    EXPECT_EQ(clean.cage.faceSizes, cube.faceSizes);
    EXPECT_EQ(clean.cage.points, cube.points);
    EXPECT_EQ(clean.faceOf, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(clean.vertexOf, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
    ASSERT_EQ(clean.cage.creases.size(), 1U);
    EXPECT_EQ(clean.cage.creases[0].sharpness, 2.5F);
    ASSERT_EQ(clean.cage.corners.size(), 1U);
    EXPECT_EQ(clean.cage.corners[0].vertex, 7U);
    EXPECT_EQ(clean.cage.holes, cube.holes);
    EXPECT_TRUE(report.notes.empty());
    EXPECT_EQ(report.droppedFaces + report.isolatedVertices + report.turnedFaces + report.splitEdges + report.splitVertices, 0U);
    expectSurface(clean.cage);
}

TEST(CleanCage, RefusesListsThatDoNotFitNamingTheCage) {
    Cage sizes = cubeCage();
    sizes.faceSizes[3] = 5;
    EXPECT_EQ(refusal(sizes),
              "cage 'cage': its faces' sizes add up to 25, but it lists 24 corners; give a vertex for each corner of each face");
    Cage wrapped = cubeCage();
    // Sums that would fit in 32 bits.
    wrapped.faceSizes = {0x80000000U, 0x80000000U, 24};
    EXPECT_NE(refusal(wrapped), "");
    Cage few = cubeCage();
    few.texturePoints = {{0.0F, 0.0F}};
    few.faceTexturePoints.assign(23, 0);
    EXPECT_EQ(refusal(few), "cage 'cage': 23 texture numbers for 24 corners; give one a corner, or none");
    few.faceTexturePoints.assign(24, 1);
    EXPECT_EQ(refusal(few), "cage 'cage': a corner has texture point 1 of 1; number them from 0");
    few.faceTexturePoints.assign(24, 0);
    EXPECT_EQ(refusal(few), "");
}

TEST(CleanCage, DropsAndCountsFacesThatAreNone) {
    Cage cage = cubeCage();
    cage.points.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F);
    cage.points.emplace_back(2e9F, 0.0F, 0.0F);
    addFace(cage, {0, 1});        // two corners
    addFace(cage, {});            // none
    addFace(cage, {0, 1, 10});    // no such vertex
    addFace(cage, {0, 1, 8});     // not finite
    addFace(cage, {0, 1, 9});     // beyond what scenes measure
    addFace(cage, {0, 3, 0, 6});  // a vertex twice
    addFace(cage, {3, 1, 0, 2});  // again a face of the cube
    addFace(cage, {4, 6, 7, 5});  // and one the other way round
    addFace(cage, {0, 0, 7, 7});  // two corners, in fact
    const auto [clean, report] = cleaned(cage);
    EXPECT_EQ(report.droppedFaces, 9U);
    EXPECT_EQ(report.isolatedVertices, 2U);
    EXPECT_EQ(clean.cage.faceVertices, cubeCage().faceVertices);
    expectSurface(clean.cage);
}

TEST(CleanCage, KeepsFacesWithoutCornersRepeatedInARow) {
    Cage cage = cageOf(scatteredPoints(5), {{0, 0, 1, 2, 2, 3, 0}});
    cage.texturePoints = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}, {6, 0}};
    cage.faceTexturePoints = {0, 1, 2, 3, 4, 5, 6};
    const auto [clean, report] = cleaned(cage);
    EXPECT_EQ(clean.cage.faceVertices, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    std::vector<float> textures;
    for (const std::uint32_t number : clean.cage.faceTexturePoints) textures.push_back(clean.cage.texturePoints[number].x);
    EXPECT_EQ(textures, (std::vector<float>{0, 2, 3, 5}));
    EXPECT_EQ(report.droppedFaces, 0U);
    EXPECT_EQ(report.isolatedVertices, 1U);
    EXPECT_TRUE(hasNote(report, "1 face kept without corners"));
}

TEST(CleanCage, TurnsTheFewerFacesOfEachPieceWithTheirTextures) {
    Cage cage = cubeCage();
    // A second cube of which more is turned than is not.
    const std::size_t corners = cage.faceVertices.size();
    for (std::size_t k = 0; k < 8; ++k) cage.points.push_back(cage.points[k] + 5.0F);
    for (std::size_t face = 0; face < 6; ++face) {
        std::vector<std::uint32_t> other;
        for (std::size_t k = 0; k < 4; ++k) other.push_back(cage.faceVertices[4 * face + (face < 4 ? 3 - k : k)] + 8);
        addFace(cage, other);
    }
    std::swap(cage.faceVertices[1], cage.faceVertices[3]);
    for (std::uint32_t corner = 0; corner < 2 * corners; ++corner) {
        // A texture point a vertex: what corners have must follow them.
        cage.faceTexturePoints.push_back(cage.faceVertices[corner]);
    }
    for (std::size_t v = 0; v < 16; ++v) cage.texturePoints.emplace_back(static_cast<float>(v), 0.0F);
    const auto [clean, report] = cleaned(cage);
    EXPECT_EQ(report.turnedFaces, 3U);
    EXPECT_EQ(test::boundaryEdges(clean.cage), 0U);
    EXPECT_EQ(clean.cage.faceVertices[0], cage.faceVertices[0]);
    for (std::size_t corner = 0; corner < 2 * corners; ++corner) {
        EXPECT_EQ(clean.cage.texturePoints[clean.cage.faceTexturePoints[corner]].x, static_cast<float>(clean.cage.faceVertices[corner]));
    }
    expectSurface(clean.cage);
}

TEST(CleanCage, CutsEdgesOfThreeFacesOpen) {
    // Three pages of a book.
    Cage cage = cageOf(scatteredPoints(8), {{0, 1, 2, 3}, {1, 0, 4, 5}, {1, 0, 6, 7}});
    cage.creases = {{1, 0, 4.0F}};
    const auto [clean, report] = cleaned(cage);
    EXPECT_EQ(report.splitEdges, 1U);
    EXPECT_EQ(report.splitVertices, 0U);
    EXPECT_EQ(clean.cage.points.size(), 12U);
    EXPECT_EQ(clean.vertexOf, (std::vector<std::uint32_t>{0, 0, 0, 1, 1, 1, 2, 3, 4, 5, 6, 7}));
    EXPECT_EQ(test::boundaryEdges(clean.cage), 12U);
    EXPECT_EQ(clean.cage.creases.size(), 3U);
    expectSurface(clean.cage);
}

TEST(CleanCage, CutsAMoebiusStripOpen) {
    for (const std::uint32_t count : {3U, 4U, 9U}) {
        const auto [clean, report] = cleaned(test::moebiusCage(count));
        EXPECT_EQ(report.splitEdges, 1U);
        EXPECT_EQ(clean.cage.faceCount(), count);
        EXPECT_EQ(clean.cage.points.size(), 2 * count + 2);
        EXPECT_EQ(test::boundaryEdges(clean.cage), 2 * count + 2);
        expectSurface(clean.cage);
    }
}

TEST(CleanCage, AFinOnAClosedSurfaceLeavesItClosed) {
    Cage cage = cubeCage();
    cage.points.emplace_back(2.0F, 2.0F, 2.0F);
    addFace(cage, {0, 1, 8});
    const auto [clean, report] = cleaned(cage);
    EXPECT_EQ(report.splitEdges, 1U);
    EXPECT_EQ(test::boundaryEdges(clean.cage), 3U);
    EXPECT_EQ(clean.cage.points.size(), 11U);
    expectSurface(clean.cage);
}

TEST(CleanCage, TakesFansThatTouchInAPointApart) {
    Cage cage = cageOf(scatteredPoints(7), {{0, 1, 2}, {0, 3, 4}, {0, 5, 6}});
    cage.corners = {{0, 2.0F}};
    const auto [clean, report] = cleaned(cage);
    EXPECT_EQ(report.splitVertices, 1U);
    EXPECT_EQ(report.splitEdges, 0U);
    EXPECT_EQ(clean.cage.points.size(), 9U);
    EXPECT_EQ(clean.cage.corners.size(), 3U);
    expectSurface(clean.cage);
}

TEST(CleanCage, TagsOfNothingFallAwayAndOfSeveralTheGreatestStays) {
    Cage cage = cubeCage();
    cage.points.emplace_back(9.0F);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    cage.creases = {{0, 1, 1.0F}, {1, 0, 3.0F},  {0, 7, 2.0F}, {0, 0, 2.0F}, {0, 99, 2.0F},
                    {2, 3, nan},  {2, 3, -1.0F}, {2, 3, 0.0F}, {4, 5, 50.0F}};
    cage.corners = {{1, 2.0F}, {1, 5.0F}, {8, 2.0F}, {99, 2.0F}, {2, nan}, {3, std::numeric_limits<float>::infinity()}};
    cage.holes = {1, 1, 6};
    const auto [clean, report] = cleaned(cage);
    ASSERT_EQ(clean.cage.creases.size(), 2U);
    EXPECT_EQ(clean.cage.creases[0].sharpness, 3.0F);
    EXPECT_EQ(clean.cage.creases[1].sharpness, 10.0F);
    ASSERT_EQ(clean.cage.corners.size(), 2U);
    EXPECT_EQ(clean.cage.corners[0].sharpness, 5.0F);
    EXPECT_EQ(clean.cage.corners[1].sharpness, 10.0F);
    EXPECT_EQ(clean.cage.holes, std::vector<std::uint32_t>{1});
    for (const char* note :
         {"3 creases between vertices that no edge joins", "2 creases of no sharpness", "1 crease of an edge that has a sharper",
          "2 corners at vertices of no face", "1 corner of no sharpness", "1 corner of a vertex", "1 hole that"}) {
        EXPECT_TRUE(hasNote(report, note)) << note;
    }
    expectSurface(clean.cage);
}

TEST(CleanCage, CreasesEdgesByTheirAngle) {
    Cage cube = cubeCage();
    cube.creases = {{0, 1, 10.0F}, {0, 2, 1.0F}};
    EXPECT_EQ(cleaned(cube, 90.0).report.creasedByAngle, 0U);
    const auto [clean, report] = cleaned(cube, 89.9);
    EXPECT_EQ(report.creasedByAngle, 11U);
    ASSERT_EQ(clean.cage.creases.size(), 12U);
    for (const Crease& crease : clean.cage.creases) EXPECT_EQ(crease.sharpness, 10.0F);
    // Faces without area crease nothing.
    const Cage flat = cageOf({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {1, 0, 3}});
    EXPECT_EQ(cleaned(flat, 0.0).report.creasedByAngle, 0U);
    // The other faces on either side of the paper: 180 degrees but for rounding.
    const Cage folded = cageOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2F, 0.9F, 0}}, {{0, 1, 2}, {1, 0, 3}});
    EXPECT_EQ(cleaned(folded, 179.0).report.creasedByAngle, 1U);
    expectSurface(clean.cage);
}

// What OpenSubdiv's Bfr crashed on.
TEST(CleanCage, LeavesCreasesOutByInnerVerticesOfTwoFaces) {
    Cage cage = cageOf(scatteredPoints(5), {{3, 2, 4, 0}, {4, 1, 3, 0}});
    cage.creases = {{0, 4, 8.0F}};
    const auto [clean, report] = cleaned(cage);
    EXPECT_TRUE(clean.cage.creases.empty());
    EXPECT_TRUE(hasNote(report, "1 crease left out by vertices inside"));
    makeLimitSurfaces(clean.cage);
}

TEST(CleanCage, TakesDegenerateCages) {
    Cage one = cubeCage();
    for (glm::vec3& point : one.points) point = glm::vec3(0.0F);
    EXPECT_EQ(cleaned(one, 30.0).clean.cage.faceCount(), 6U);
    EXPECT_EQ(cleaned(Cage{}).clean.cage.faceCount(), 0U);
    const auto [clean, report] = cleaned(cageOf(scatteredPoints(3), {}));
    EXPECT_EQ(clean.cage.points.size(), 0U);
    EXPECT_EQ(report.isolatedVertices, 3U);
}

TEST(CleanCage, KeepsLargeValencesAndFacesUpToOpenSubdivsLimit) {
    const auto [wheel, report] = cleaned(test::wheelCage(65534));
    EXPECT_EQ(wheel.cage.faceCount(), 65534U);
    EXPECT_TRUE(report.notes.empty());
    const auto refiner = subdivision::makeRefiner(wheel.cage);
    EXPECT_EQ(refiner->GetLevel(0).GetVertexFaces(0).size(), 65534);

    const auto [crowd, crowded] = cleaned(test::wheelCage(65535));
    EXPECT_EQ(crowd.cage.faceCount(), 0U);
    EXPECT_EQ(crowded.droppedFaces, 65535U);
    EXPECT_TRUE(hasNote(crowded, "65535 faces left out at vertices"));

    for (const std::uint32_t size : {65535U, 65536U}) {
        Cage disc = cageOf(scatteredPoints(size), {});
        std::vector<std::uint32_t> corners(size);
        for (std::uint32_t k = 0; k < size; ++k) corners[k] = k;
        addFace(disc, corners);
        const auto [kept, told] = cleaned(disc);
        EXPECT_EQ(kept.cage.faceCount(), size > 65535 ? 0U : 1U);
        EXPECT_EQ(hasNote(told, "1 face of more than 65535 corners"), size > 65535);
        if (kept.cage.faceCount() == 0) continue;
        EXPECT_EQ(subdivision::makeRefiner(kept.cage)->GetLevel(0).GetNumEdges(), 65535);
    }
}

TEST(CleanCage, MakesASurfaceOfRandomGarbage) {
    std::size_t faces = 0, split = 0;
    for (std::uint32_t seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE(seed);
        const Cage cage = test::randomCage(seed);
        const auto [clean, report] = cleaned(cage, seed % 2 == 0 ? 40.0 : 180.0);
        expectSurface(clean.cage);
        faces += clean.cage.faceCount();
        split += report.splitEdges;
        ASSERT_EQ(clean.faceOf.size(), clean.cage.faceCount());
        ASSERT_EQ(clean.vertexOf.size(), clean.cage.points.size());
        EXPECT_EQ(clean.faceOf.size() + report.droppedFaces, cage.faceCount());
        for (std::size_t v = 0; v < clean.vertexOf.size(); ++v) EXPECT_EQ(clean.cage.points[v], cage.points[clean.vertexOf[v]]);
        if (clean.cage.faceCount() == 0) continue;
        subdivision::makeRefiner(clean.cage)->RefineUniform(subdivision::Refiner::UniformOptions(2));
        makeLimitSurfaces(clean.cage);
        // Clean cages are clean.
        const auto [again, told] = cleaned(clean.cage);
        EXPECT_EQ(again.cage.faceVertices, clean.cage.faceVertices);
        EXPECT_EQ(again.cage.creases.size(), clean.cage.creases.size());
        EXPECT_TRUE(told.notes.empty());
        EXPECT_EQ(told.splitEdges + told.splitVertices + told.turnedFaces, 0U);
    }
    // That this was no idle test.
    EXPECT_GT(faces, 2000U);
    EXPECT_GT(split, 1000U);
}

}  // namespace

}  // namespace tessera
