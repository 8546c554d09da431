// How far tessellations are from their surfaces, by dense measures in double precision, and how many triangles they take for it.
#include "mesh_rig.h"
#include "pattern_drawing.h"

#include "closed_models.h"
#include "mesh/pattern.h"
#include "patch_eval.h"
#include "ray_caster.h"

#include "tessera/surfaces.h"
#include "tessera/triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace tessera::test {
namespace {

// A placed patch in double precision, world space.
struct WorldPatch {
    PatchKind kind = PatchKind::bezier;
    std::vector<glm::dvec3> points;
    std::vector<double> weights;

    [[nodiscard]] Surface surface() const {
        return [this](double u, double v) { return reference::evaluate(kind, points, u, v, weights).position; };
    }
};

std::vector<WorldPatch> worldPatches(const Scene& scene, const MeshRig& rig) {
    std::vector<WorldPatch> patches;
    for (const placed_patch& placed : rig.placed()) {
        const Object& object = scene.objects[placed.object];
        const Mesh& mesh = *scene.findMesh(object.mesh);
        WorldPatch patch{mesh.kind, reference::patchPoints(mesh, placed.index_in_mesh),
                         reference::patchWeights(mesh, placed.index_in_mesh)};
        const reference::Placement place = reference::placement(object.transform);
        for (std::size_t k = 0; k < positionsPerPatch(mesh.kind); ++k) patch.points[k] = place(patch.points[k]);
        patches.push_back(std::move(patch));
    }
    return patches;
}

double sizeOf(const std::vector<WorldPatch>& patches) {
    double most = 0.0;
    for (const WorldPatch& patch : patches) most = std::max(most, reference::patchSize(patch.points));
    return most;
}

struct Figures {
    std::uint64_t triangles = 0;
    std::uint64_t least = 0;
    double farthest = 0.0;  // in parts of tolerance
};

std::uint64_t trianglesOfGrid(const WorldPatch& patch, std::uint32_t m, std::uint32_t n) {
    return patch.kind == PatchKind::pn ? std::uint64_t{m} * m : 2 * std::uint64_t{m} * n;
}

bool good(const WorldPatch& patch, std::uint32_t m, std::uint32_t n, double tolerance) {
    const PatternDrawing grid = patch.kind == PatchKind::pn ? drawTriangleGrid(m) : drawGrid(m, n);
    return farthestAtEqualPlaces(grid, patch.surface(), 4, tolerance) <= tolerance;
}

// The least n with which m x n cells are good, as far as more are never worse; `most` + 1 where none is.
std::uint32_t leastRows(const WorldPatch& patch, std::uint32_t m, std::uint32_t most, double tolerance) {
    std::uint32_t bad = 0;
    std::uint32_t fine = most + 1;
    while (fine - bad > 1) {
        const std::uint32_t middle = (bad + fine) / 2;
        (good(patch, m, middle, tolerance) ? fine : bad) = middle;
    }
    return fine;
}

// Triangles of the best plain grid by the papers' error, of those that have no more than `known` ones.
std::uint64_t leastTriangles(const WorldPatch& patch, double tolerance, std::uint64_t known) {
    std::uint64_t least = std::max<std::uint64_t>(known, 1);
    if (patch.kind == PatchKind::pn) {
        for (std::uint32_t m = 1; std::uint64_t{m} * m < least; ++m) {
            if (good(patch, m, m, tolerance)) return std::uint64_t{m} * m;
        }
        return least;
    }
    for (std::uint32_t m = 1; m <= least / 2; ++m) {
        const auto most = static_cast<std::uint32_t>(least / 2 / m);
        const std::uint32_t n = leastRows(patch, m, most, tolerance);
        if (n <= most) least = std::min(least, trianglesOfGrid(patch, m, n));
    }
    return least;
}

Figures measure(MeshRig& rig, const Scene& scene, double tolerance, bool search) {
    rig.place(scene);
    const std::vector<WorldPatch> patches = worldPatches(scene, rig);
    const std::vector<mesh_pattern> patterns = rig.factors(viewOf(tolerance));
    Figures figures;
    for (std::size_t k = 0; k < patches.size(); ++k) {
        const PatternDrawing drawing = drawPattern(patterns[k]);
        figures.triangles += drawing.triangles.size();
        figures.farthest = std::max(figures.farthest, farthest(drawing, patches[k].surface(), 4) / tolerance);
        if (search) figures.least += leastTriangles(patches[k], tolerance, 4 * drawing.triangles.size());
    }
    return figures;
}

Scene flatScene(Mesh mesh) { return reference::sceneOf({std::move(mesh)}); }

struct Model {
    const char* name;
    Scene scene;
    double coarsest;  // in parts of the largest patch: from here on the number of triangles is held to the optimum's
};

std::vector<Model> models() {
    std::vector<Model> result;
    result.push_back({"bicubics", flatScene(reference::bumpyBezierMesh(11, 6)), 3e-3});
    result.push_back({"sphere", flatScene(sphere("sphere", 1.0, -1.0, 1.0)), 0.03});
    result.push_back({"torus", flatScene(torus("torus", 1.0, 0.4)), 0.03});
    result.push_back({"PN", flatScene(triangleSolid(5, 1, TriangleLook::smooth)), 0.01});
    result.push_back({"teapot", builtinScene("teapot"), 0.03});
    result.push_back({"quadrics", builtinScene("quadrics"), 0.03});
    result.push_back({"NURBS", builtinScene("nurbs"), 0.01});
    return result;
}

// Sums over the patches of a model. Where a surface is straight one way its patches take fewer than any grid that keeps all points where
// they are, for they may move along it.
TEST(FactorBounds, TakeFewerThanTwiceTheTrianglesOfTheBestPlainGrids) {
    MeshRig rig;
    for (const Model& model : models()) {
        for (const double part : {0.03, 0.01, 3e-3, 1e-3}) {
            if (part > model.coarsest) continue;
            SCOPED_TRACE(::testing::Message() << model.name << ", tolerance " << part);
            rig.place(model.scene);
            const Figures f = measure(rig, model.scene, part * sizeOf(worldPatches(model.scene, rig)), true);
            EXPECT_LT(static_cast<double>(f.triangles), 2.0 * static_cast<double>(f.least));
            EXPECT_LE(f.farthest, 1.0);
        }
    }
}

TEST(FactorBounds, KnowWhatIsStraightOneWay) {
    MeshRig rig;
    const auto triangles = [&](const Mesh& mesh) { return measure(rig, flatScene(mesh), 1e-3, false).triangles; };
    // Quarter circles of 27 segments.
    EXPECT_LE(triangles(cylinder("cylinder", 1.0, -1.0, 1.0)), 4U * 2U * 27U);
    EXPECT_LE(triangles(cone("cone", 2.0, 1.0)), 4U * 27U);
    EXPECT_LE(triangles(disk("disk", 0.0, 1.0)), 4U * 27U);
    EXPECT_LE(triangles(hyperboloid("hyperboloid", {1.0, 0.0, -1.0}, {0.5, 0.8, 1.0})), 6000U);
    EXPECT_LE(triangles(paraboloid("paraboloid", 1.0, 0.0, 2.0)), 5000U);
    EXPECT_EQ(triangles(bilinearMesh("flat", std::vector<std::array<glm::vec3, 4>>{{glm::vec3(0, 0, 0), {3, 0, 0}, {2, 1, 0}, {0, 1, 0}}})),
              2U);
}

// Across what is straight less than one cell would do: that must not be made up for along the arcs. The bound holds their mixed
// derivatives, which lie in the surface, for errors, so that it is far from the optimum here.
TEST(FactorBounds, TakeFewTrianglesWhereRationalPatchesAreStraightOneWay) {
    MeshRig rig;
    for (const Mesh& mesh : {disk("disk", 0.0, 1.0), cone("cone", 2.0, 1.0), cylinder("cylinder", 1.0, 0.0, 2.0)}) {
        SCOPED_TRACE(mesh.name);
        for (const double tolerance : {0.1, 0.01}) {
            const Figures f = measure(rig, reference::sceneOf({mesh}), tolerance, false);
            EXPECT_LE(f.farthest, 1.0);
            EXPECT_LT(static_cast<double>(f.triangles), 10.0 / tolerance);
        }
    }
}

// A sheet between straight borders that bulges inside.
Mesh bulge() {
    Mesh mesh{"bulge", PatchKind::bezier, {}};
    for (int v = 0; v < 4; ++v) {
        for (int u = 0; u < 4; ++u) {
            const bool inner = u % 3 != 0 && v % 3 != 0;
            mesh.points.emplace_back(static_cast<float>(u) / 3, static_cast<float>(v) / 3, inner ? 1.0F : 0.0F);
        }
    }
    return mesh;
}

Mesh scaled(Mesh mesh, const glm::vec3& factor) {
    for (glm::vec3& point : mesh.points) point *= factor;
    return mesh;
}

// Borders that are points, at one end and at both.
Mesh collapsed(Mesh mesh) {
    for (std::size_t first = 0; first < mesh.points.size(); first += 16) {
        for (std::size_t k = 1; k < 4; ++k) mesh.points[first + k] = mesh.points[first];
        for (std::size_t k = 12; k < 15 && first % 32 == 0; ++k) mesh.points[first + k] = mesh.points[first + 15];
    }
    return mesh;
}

std::vector<Mesh> hardMeshes() {
    const Mesh sheets = reference::bumpyBezierMesh(21, 12);
    const Mesh thin = scaled(sheets, {1.0F, 0.01F, 0.02F});
    return {sheets,
            thin,
            bulge(),
            collapsed(sheets),
            reference::asGregory(sheets),
            reference::parted(reference::asGregory(sheets), 0.3, 5),
            reference::parted(reference::asGregory(bulge()), 0.2, 6),
            reference::weighted(sheets, 1.2, 7),
            reference::weighted(sheets, 5.0, 8),
            reference::weighted(thin, 3.0, 9),
            reference::bumpyPnMesh(22, 12),
            scaled(reference::bumpyPnMesh(23, 12), {1.0F, 0.02F, 1.0F}),
            sphere("sphere", 1.0, -0.5, 1.0),
            cone("cone", 2.0, 1.0),
            triangleSolid(6, 1, TriangleLook::creased)};
}

TEST(FactorBounds, KeepAllKindsWithinTolerance) {
    MeshRig rig;
    std::size_t number = 0;
    for (Mesh& mesh : hardMeshes()) {
        SCOPED_TRACE(::testing::Message() << "mesh " << number++);
        const Scene scene = reference::sceneOf({std::move(mesh)});
        for (const double tolerance : {0.5, 0.1, 0.02, 4e-3}) EXPECT_LE(measure(rig, scene, tolerance, false).farthest, 1.0) << tolerance;
    }
}

// Pixels between the pictures of a point of the surface and of the triangle's nearest one, where the point is in view.
double pixelsOff(const mesh_view& view, double focal, const glm::dvec3& point, const std::array<glm::dvec3, 3>& triangle) {
    const auto eye = [&](const glm::dvec3& p) {
        glm::dvec3 result(0.0);
        for (std::size_t row = 0; row < 3; ++row) {
            const float* m = view.eye_from_world + 4 * row;
            result[static_cast<int>(row)] = m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3];
        }
        return result;
    };
    const glm::dvec3 seen = eye(point);
    if (seen.z < view.near_plane || std::abs(seen.x) > view.slope_x * seen.z || std::abs(seen.y) > view.slope_y * seen.z) return 0.0;
    // A ball around the point covers so many pixels at most, along the picture's diagonal.
    return focal * distanceTo(triangle, point) / (view.depth_share * seen.z);
}

TEST(FactorBounds, KeepWhatIsSeenWithinPixels) {
    MeshRig rig;
    for (const ClosedModel& model : closedModels()) {
        SCOPED_TRACE(model.name);
        rig.place(model.scene);
        const std::vector<WorldPatch> patches = worldPatches(model.scene, rig);
        for (const ViewKind kind : {ViewKind::near, ViewKind::throughNearPlane, ViewKind::inside}) {
            const Camera camera = randomView(model.scene, kind, 5);
            const double focal = 0.5 * 96 / std::tan(0.5 * glm::radians(static_cast<double>(camera.fovy)));
            const mesh_view view = viewOf(camera, 2.0, 128, 96, true);
            const std::vector<mesh_pattern> patterns = rig.factors(view);
            for (std::size_t k = 0; k < patches.size(); k += 2) {
                if (patterns[k].form == MESH_NOTHING || patternTriangles(patterns[k]) > 20000) continue;
                const double most = greatest(
                    drawPattern(patterns[k]), patches[k].surface(),
                    [&](const glm::dvec3& point, const std::array<glm::dvec3, 3>& t) { return pixelsOff(view, focal, point, t); }, 2,
                    1e300);
                EXPECT_LE(most, 2.0) << "patch " << k;
            }
        }
    }
}

TEST(FactorBounds, NeverCullWhatIsSeen) {
    MeshRig rig;
    std::size_t culled = 0;
    for (const ClosedModel& model : closedModels()) {
        SCOPED_TRACE(model.name);
        rig.place(model.scene);
        const std::vector<WorldPatch> patches = worldPatches(model.scene, rig);
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            for (const ViewKind kind : {ViewKind::near, ViewKind::aside, ViewKind::inside}) {
                const mesh_view view = viewOf(randomView(model.scene, kind, seed), 1.0, 128, 96, true);
                const std::vector<mesh_pattern> patterns = rig.factors(view);
                for (std::size_t k = 0; k < patches.size(); ++k) {
                    if (patterns[k].form != MESH_NOTHING) continue;
                    ++culled;
                    const auto seen = [&](const glm::dvec3& point, const std::array<glm::dvec3, 3>&) {
                        return pixelsOff(view, 1.0, point, {point + 1.0, point + 1.0, point + 1.0});
                    };
                    const PatternDrawing grid = patches[k].kind == PatchKind::pn ? drawTriangleGrid(6) : drawGrid(6, 6);
                    EXPECT_EQ(greatest(grid, patches[k].surface(), seen, 2, 1e300), 0.0) << "patch " << k;
                }
            }
        }
    }
    EXPECT_GT(culled, 100U);
}

}  // namespace
}  // namespace tessera::test
