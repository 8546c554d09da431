// subdivide(): scenes with cages become scenes with meshes, and the schemes bilinear and none make what they say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "cage_host.h"
#include "subdivide_host.h"
#include "subdivision/triangulate.h"
#include "tessera/error.h"
#include "tessera/subdivision.h"
#include "tessera/surfaces.h"

namespace tessera {

namespace {

using test::addFace;
using test::cageOf;
using test::cubeCage;
using test::loneAndCreasedSides;
using test::Made;
using test::octahedron;
using test::placing;
using test::sceneOf;
using test::subdivided;
using test::withAngle;
using test::withTolerance;

TEST(Subdivide, RefusesOptionsOutsideTheirRanges) {
    Scene scene = sceneOf(cubeCage(), SubdivisionScheme::bilinear);
    for (const double tolerance : {0.0, 1e-10, 0.2, std::nan("")}) EXPECT_THROW(subdivide(scene, withTolerance(tolerance)), Error);
    for (const double angle : {-1.0, 181.0, std::nan("")}) EXPECT_THROW(subdivide(scene, withAngle(angle)), Error);
    try {
        withTolerance(0.2).validate();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "subdivision tolerance 0.2 is outside its range; give 1e-9 to 0.1");
    }
    // Refused scenes stay as they were.
    scene.cages.push_back(scene.cages[0]);
    EXPECT_THROW(subdivide(scene), Error);
    scene.cages[1].name = "other";
    scene.cages[1].faceSizes.pop_back();
    scene.objects.push_back(placing("second", "other"));
    EXPECT_THROW(subdivide(scene), Error);
    EXPECT_EQ(scene.cages.size(), 2U);
    EXPECT_TRUE(scene.meshes.empty());
}

TEST(Subdivide, BilinearCubesStayFlatAndClosed) {
    const Made made = subdivided(cubeCage(), SubdivisionScheme::bilinear);
    ASSERT_EQ(made.scene.meshes.size(), 1U);
    EXPECT_TRUE(made.scene.cages.empty());
    EXPECT_EQ(made.mesh().name, "cage");
    EXPECT_TRUE(made.mesh().welded);
    EXPECT_EQ(made.mesh().kind, PatchKind::bezier);
    ASSERT_EQ(made.mesh().patchCount(), 6U);
    EXPECT_EQ(made.report.patches, 6U);
    EXPECT_EQ(made.report.regularPatches, 6U);
    EXPECT_EQ(made.report.irregularVertices, 8U);
    EXPECT_EQ(made.report.largestValence, 3U);
    for (std::size_t patch = 0; patch < 6; ++patch) {
        const glm::vec3* p = &made.mesh().points[patch * 16];
        for (int v = 0; v < 4; ++v) {
            for (int u = 0; u < 4; ++u) {
                const glm::vec3 linear =
                    p[0] + (p[3] - p[0]) * (static_cast<float>(u) / 3.0F) + (p[12] - p[0]) * (static_cast<float>(v) / 3.0F);
                EXPECT_LT(glm::length(p[4 * v + u] - linear), 1e-6F);
            }
        }
    }
}

// A pentagon between quadrilaterals: halves of edges meet whole ones.
TEST(Subdivide, BilinearFacesOfFiveCornersAreFiveQuadsAroundTheirMiddle) {
    Cage house = cageOf({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 3, 0}, {0, 2, 0}, {0, 0, 4}, {2, 0, 4}}, {{0, 1, 2, 3, 4}, {1, 0, 5, 6}});
    for (const std::uint32_t vertex : house.faceVertices) house.faceTexturePoints.push_back(vertex);
    for (const glm::vec3& point : house.points) house.texturePoints.emplace_back(point.x + 2.0F * point.z, point.y - point.z);
    const Made made = subdivided(house, SubdivisionScheme::bilinear);
    const Mesh& mesh = made.mesh();
    EXPECT_EQ(made.report.faces, 2U);
    EXPECT_GE(mesh.patchCount(), 6U);
    std::size_t atMiddle = 0;
    ASSERT_EQ(mesh.textureNets.size(), mesh.points.size());
    for (std::size_t k = 0; k < mesh.points.size(); ++k) {
        // Planes stay planes, and what is linear in place stays so.
        const glm::vec3& p = mesh.points[k];
        EXPECT_LT(std::min(std::abs(p.z), std::abs(p.y)), 1e-6F);
        EXPECT_LT(glm::length(mesh.textureNets[k] - glm::vec2(p.x + 2.0F * p.z, p.y - p.z)), 2e-6F);
        atMiddle += glm::length(p - glm::vec3(1.0F, 1.4F, 0.0F)) < 1e-6F ? 1U : 0U;
    }
    EXPECT_EQ(atMiddle, 5U);
}

TEST(Subdivide, HolesAndBoundaryRuleNoneLeaveFacesOut) {
    Cage grid = cageOf({}, {});
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) grid.points.emplace_back(x, y, 0);
    }
    for (std::uint32_t y = 0; y < 3; ++y) {
        for (std::uint32_t x = 0; x < 3; ++x) addFace(grid, {4 * y + x, 4 * y + x + 1, 4 * y + x + 5, 4 * y + x + 4});
    }
    EXPECT_EQ(subdivided(grid, SubdivisionScheme::bilinear).report.patches, 9U);
    grid.holes = {0, 4};
    EXPECT_EQ(subdivided(grid, SubdivisionScheme::bilinear).report.patches, 7U);
    EXPECT_EQ(subdivided(grid, SubdivisionScheme::none).report.patches, 14U);
    const CageReport triangles = subdivided(grid, SubdivisionScheme::loop).report;
    EXPECT_EQ(triangles.patches, 14U * 16U);
    EXPECT_EQ(triangles.holes, 4U);
    grid.holes.clear();
    grid.boundary = BoundaryRule::none;
    const CageReport inner = subdivided(grid, SubdivisionScheme::catmullClark).report;
    EXPECT_EQ(inner.faces, 1U);
    EXPECT_EQ(inner.patches, 1U);
}

TEST(Subdivide, ObjectsFollowTheirCagesAndThoseOfNothingGo) {
    Scene scene = sceneOf(cubeCage(), SubdivisionScheme::bilinear);
    Cage empty = cageOf({{0, 0, 0}}, {});
    empty.name = "empty";
    Cage spare = octahedron();
    spare.name = "spare";
    scene.cages.push_back(empty);
    scene.cages.push_back(spare);
    scene.meshes.push_back(bilinearMesh("mesh", {}));
    scene.meshes[0].points.assign(16, glm::vec3(0.0F));
    scene.objects.push_back(placing("gone", "empty"));
    scene.objects.push_back(placing("kept", "mesh"));
    const auto reports = subdivide(scene);
    scene.validate();
    ASSERT_EQ(reports.size(), 3U);
    EXPECT_EQ(reports[1].notes, std::vector<std::string>{"no face of it can be drawn: left out, with the objects that place it"});
    EXPECT_EQ(reports[2].notes, std::vector<std::string>{"no object places it: left out"});
    ASSERT_EQ(scene.objects.size(), 2U);
    EXPECT_EQ(scene.objects[0].mesh, "cage");
    EXPECT_EQ(scene.objects[1].mesh, "mesh");
    ASSERT_EQ(scene.meshes.size(), 2U);
    EXPECT_EQ(scene.meshes[1].name, "cage");
}

TEST(Subdivide, ObjectsOfTwoMeshesAreTwoWithNamesOfTheirOwn) {
    // A flat box of 5 by 5 squares above and below: regular patches in their middles, Gregory patches at its corners.
    Cage cage = cageOf({}, {});
    for (int z = 0; z < 2; ++z) {
        for (int y = 0; y < 6; ++y) {
            for (int x = 0; x < 6; ++x) cage.points.emplace_back(x, y, z);
        }
    }
    const auto at = [](std::uint32_t x, std::uint32_t y, std::uint32_t z) { return x + 6 * y + 36 * z; };
    for (std::uint32_t k = 0; k < 5; ++k) {
        for (std::uint32_t l = 0; l < 5; ++l) {
            addFace(cage, {at(k, l, 1), at(k + 1, l, 1), at(k + 1, l + 1, 1), at(k, l + 1, 1)});
            addFace(cage, {at(k, l, 0), at(k, l + 1, 0), at(k + 1, l + 1, 0), at(k + 1, l, 0)});
        }
        addFace(cage, {at(k, 0, 0), at(k + 1, 0, 0), at(k + 1, 0, 1), at(k, 0, 1)});
        addFace(cage, {at(k + 1, 5, 0), at(k, 5, 0), at(k, 5, 1), at(k + 1, 5, 1)});
        addFace(cage, {at(0, k + 1, 0), at(0, k, 0), at(0, k, 1), at(0, k + 1, 1)});
        addFace(cage, {at(5, k, 0), at(5, k + 1, 0), at(5, k + 1, 1), at(5, k, 1)});
    }
    Scene scene = sceneOf(cage, SubdivisionScheme::catmullClark);
    scene.meshes.push_back(bilinearMesh("cage gregory", {}));
    scene.meshes[0].points.assign(16, glm::vec3(0.0F));
    scene.objects.push_back(placing("object gregory", "cage"));
    SubdivisionOptions options;
    options.surface = SubdivisionSurface::gregory;
    const auto reports = subdivide(scene, options);
    scene.validate();
    std::set<std::string> names, meshes;
    for (const Object& object : scene.objects) names.insert(object.name), meshes.insert(object.mesh);
    EXPECT_EQ(names, (std::set<std::string>{"object", "object gregory", "object gregory 2", "object gregory gregory"}));
    EXPECT_EQ(meshes, (std::set<std::string>{"cage", "cage gregory 2"}));
    EXPECT_GT(reports.at(0).limitDistance, 0.0);
    EXPECT_LT(reports.at(0).regularPatches, reports.at(0).patches);
}

TEST(Subdivide, PolygonsAreTrianglesWithSmoothNormalsPartedAtCreases) {
    const Made smooth = subdivided(cubeCage(), SubdivisionScheme::none);
    EXPECT_EQ(smooth.mesh().kind, PatchKind::pn);
    EXPECT_FALSE(smooth.mesh().welded);
    EXPECT_EQ(smooth.report.patches, 12U);
    EXPECT_EQ(loneAndCreasedSides(smooth.mesh()), (std::pair<std::size_t, std::size_t>{0, 0}));
    // The corners of a cube: three right angles.
    for (std::size_t k = 0; k < 12; ++k) {
        const glm::vec3 *p = &smooth.mesh().points[16 * k], out = glm::normalize(p[0] - 0.5F);
        EXPECT_LT(glm::length(p[10] - out), 1e-5F);
    }
    const Made sharp = subdivided(cubeCage(), SubdivisionScheme::none, withAngle(60.0));
    EXPECT_EQ(sharp.report.creasedByAngle, 12U);
    EXPECT_EQ(sharp.report.creaseEdges, 12U);
    EXPECT_EQ(loneAndCreasedSides(sharp.mesh()), (std::pair<std::size_t, std::size_t>{0, 24}));
    Cage one = cubeCage();
    one.corners = {{0, 1.0F}};
    EXPECT_EQ(loneAndCreasedSides(subdivided(one, SubdivisionScheme::none).mesh()).second, 6U);
}

double areaOf(const Cage& cage, const std::vector<subdivision::CornerTriangle>& triangles, bool& folded) {
    double area = 0;
    for (const auto& triangle : triangles) {
        const auto at = [&](std::size_t k) { return glm::dvec3(cage.points[cage.faceVertices[triangle.corners[k]]]); };
        const double twice = glm::cross(at(1) - at(0), at(2) - at(0)).z;
        folded = folded || twice < -1e-9;
        area += twice / 2.0;
    }
    return area;
}

TEST(Subdivide, PolygonsThatAreNotConvexAreCutWithoutFolds) {
    // A comb, a dart and a convex polygon of a thousand corners, all in z = 0.
    Cage comb = cageOf({}, {});
    std::vector<std::uint32_t> corners;
    for (int tooth = 0; tooth < 6; ++tooth) {
        for (const glm::vec2& p : {glm::vec2(0, 0), {0, 1}, {0.5F, 1}, {0.5F, 0}})
            comb.points.emplace_back(p.x + static_cast<float>(tooth), p.y, 0);
    }
    comb.points.emplace_back(5.5F, -1.0F, 0.0F);
    comb.points.emplace_back(0.0F, -1.0F, 0.0F);
    for (std::uint32_t k = 0; k < comb.points.size(); ++k) corners.insert(corners.begin(), k);
    addFace(comb, corners);
    CageReport report;
    bool folded = false;
    EXPECT_NEAR(areaOf(comb, subdivision::cornerTriangles(comb, report), folded), 5.5 + 3.0, 1e-5);
    EXPECT_FALSE(folded);

    const std::vector<glm::vec3> dart{{0, 0, 0}, {2, -1, 0}, {0.5F, 0, 0}, {2, 1, 0}};
    for (std::uint32_t first = 0; first < 4; ++first) {
        Cage turned = cageOf(dart, {{first, (first + 1) % 4, (first + 2) % 4, (first + 3) % 4}});
        // The dart is hollow at corner 2: its diagonal lies inside.
        folded = false;
        areaOf(turned, subdivision::cornerTriangles(turned, report), folded);
        EXPECT_FALSE(folded) << first;
    }

    Cage disc = cageOf({}, {});
    corners.clear();
    for (std::uint32_t k = 0; k < 1000; ++k) {
        const double angle = 6.283185307 * k / 1000.0;
        disc.points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
        corners.push_back(k);
    }
    addFace(disc, corners);
    folded = false;
    EXPECT_NEAR(areaOf(disc, subdivision::cornerTriangles(disc, report), folded), 3.14157, 1e-4);
    EXPECT_FALSE(folded);
    EXPECT_TRUE(report.notes.empty());
    std::vector<int> used(1000);
    for (const auto& triangle : subdivision::cornerTriangles(disc, report)) {
        for (const std::uint32_t corner : triangle.corners) ++used[corner];
    }
    EXPECT_LE(*std::max_element(used.begin(), used.end()), 20);
}

TEST(Subdivide, SchemesTakeGarbageLargeValencesAndNothingness) {
    Cage point = cubeCage();
    for (glm::vec3& p : point.points) p = glm::vec3(3.0F);
    const Cage strip = test::moebiusCage(7);
    for (const SubdivisionScheme scheme : {SubdivisionScheme::bilinear, SubdivisionScheme::none, SubdivisionScheme::loop}) {
        SCOPED_TRACE(name(scheme));
        const Made nothing = subdivided(point, scheme);
        // Triangles without area are none; patches may shrink to a point.
        EXPECT_EQ(nothing.scene.meshes.size(), scheme == SubdivisionScheme::bilinear ? 1U : 0U);
        EXPECT_EQ(nothing.scene.objects.size(), nothing.scene.meshes.size());
        // Each face of a Loop surface costs by the square of the valence.
        const std::size_t valence = scheme == SubdivisionScheme::loop ? 150 : 1000;
        const Made large = subdivided(test::wheelCage(static_cast<std::uint32_t>(valence)), scheme, withTolerance(1e-2));
        EXPECT_EQ(large.report.largestValence, valence);
        EXPECT_GE(large.report.patches, valence);
        const Made twisted = subdivided(strip, scheme, withTolerance(1e-2));
        EXPECT_EQ(twisted.report.splitEdges, 1U);
        EXPECT_GE(twisted.report.patches, 7U);
    }
}

// Smooth ones would take minutes.
TEST(Subdivide, IsBilinearWhereMoreFacesMeetThanCanBeSmooth) {
    const Made wheel = subdivided(test::wheelCage(3000), SubdivisionScheme::catmullClark, withTolerance(1e-2));
    EXPECT_EQ(wheel.report.patches, 9000U);
    ASSERT_EQ(wheel.report.notes.size(), 1U);
    EXPECT_EQ(wheel.report.notes[0].rfind("a vertex of 3000 faces: drawn bilinear, not smooth", 0), 0U);

    std::vector<std::uint32_t> corners(3000);
    for (std::uint32_t k = 0; k < corners.size(); ++k) corners[k] = k;
    Cage disc = test::cageOf(test::scatteredPoints(corners.size()), {corners});
    const Made face = subdivided(disc, SubdivisionScheme::catmullClark, withTolerance(1e-2));
    EXPECT_EQ(face.report.patches, 3000U);
    ASSERT_EQ(face.report.notes.size(), 1U);
    EXPECT_EQ(face.report.notes[0].rfind("a face of 3000 corners: drawn bilinear, not smooth", 0), 0U);
}

// What single precision does not hold is no reason to cut patches: without end, that is.
TEST(Subdivide, CagesFarFromTheOriginStaySmall) {
    Cage cube = cubeCage();
    for (glm::vec3& p : cube.points) p = 1e-6F * p + glm::vec3(1000.0F, 0.0F, 0.0F);
    EXPECT_LT(subdivided(cube, SubdivisionScheme::catmullClark).report.patches, 1000U);
}

TEST(Subdivide, SchemesTakeRandomGarbage) {
    std::size_t patches = 0;
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        const Cage cage = test::randomCage(seed);
        for (const SubdivisionScheme scheme : {SubdivisionScheme::bilinear, SubdivisionScheme::none, SubdivisionScheme::loop}) {
            // subdivided() has Scene::validate() look at what comes out.
            const Made made = subdivided(cage, scheme, withTolerance(0.1));
            std::size_t drawn = 0;
            for (const Mesh& mesh : made.scene.meshes) drawn += mesh.patchCount();
            EXPECT_EQ(drawn, made.report.patches);
            EXPECT_TRUE(std::isfinite(made.report.limitDistance));
            patches += drawn;
        }
    }
    EXPECT_GT(patches, 10000U);
}

}  // namespace

}  // namespace tessera
