// What the tessellator promises of closed surfaces: whatever tolerance and camera, the mesh is a closed 2-manifold of the surface's genus.
#include "closed_models.h"
#include "mesh_kept.h"
#include "sample_meshes.h"
#include "tessera/surfaces.h"
#include "tessera/weld.h"
#include "weld_models.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

// A vase without a hole: a profile of degree 3 with its ends on the axis, swept around by four quarter circles.
Mesh nurbsBody() {
    const std::vector<glm::dvec2> profile{{0.0, -1.0}, {0.9, -1.0}, {1.1, -0.3}, {0.2, 0.1}, {0.7, 0.6}, {0.5, 1.0}, {0.0, 1.0}};
    Nurbs body;
    body.name = "vase";
    body.uDegree = 2;
    body.uKnots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
    body.uCount = 9;
    body.vKnots = {0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4};
    const double corner = 1.0 / std::numbers::sqrt2;
    const std::vector<glm::dvec3> circle{{1, 0, 1},        {1, 1, corner}, {0, 1, 1},       {-1, 1, corner}, {-1, 0, 1},
                                         {-1, -1, corner}, {0, -1, 1},     {1, -1, corner}, {1, 0, 1}};
    for (const glm::dvec2& p : profile) {
        for (const glm::dvec3& c : circle) {
            body.points.emplace_back(p.x * c.x, p.x * c.y, p.y);
            body.weights.push_back(c.z);
        }
    }
    return nurbsMesh(body);
}

// Patches beside two halves of others, whose borders were disturbed and welded again.
Scene halvedTorus(bool mixed) {
    std::mt19937 random(5);
    Model model = torusModel(5, 4, mixed, random);
    for (const std::size_t patch : {std::size_t{3}, std::size_t{8}, std::size_t{14}}) halve(model, patch);
    std::vector<PatchPlace> places;
    Scene scene = sceneOf(model, random, places);
    disturb(scene, 0.3, 1e-5, random);
    weld(scene);
    // randomView() looks at the first mesh.
    const auto bare = [&](const std::string& name) { return scene.findMesh(name)->points.empty(); };
    std::erase_if(scene.objects, [&](const Object& object) { return bare(object.mesh); });
    std::erase_if(scene.meshes, [](const Mesh& mesh) { return mesh.points.empty(); });
    return scene;
}

std::vector<ClosedModel> models() {
    std::vector<ClosedModel> all = closedModels();
    for (ClosedModel& model : all) weld(model.scene);
    for (const bool mixed : {false, true}) all.push_back({mixed ? "halved torus of all kinds" : "halved torus", halvedTorus(mixed)});
    all.push_back({"NURBS body", placedAnyhow({nurbsBody()}, 200)});
    weld(all.back().scene);
    return all;
}

long eulerOf(const std::string& name) { return name.find("torus") == std::string::npos ? 2 : 0; }

void expectClosed(Tessellator& tessellator, const TessellateOptions& options, const ClosedModel& model, const std::string& where) {
    const DeviceMesh mesh = tessellator.tessellate(options);
    const Closedness is = closedness(keep(mesh, options.positionsOnly));
    EXPECT_TRUE(is.closed()) << model.name << ", " << where << ": " << is.text();
    EXPECT_EQ(is.euler(), eulerOf(model.name)) << model.name << ", " << where << ": " << is.text();
    EXPECT_GT(is.triangles, 3U) << model.name << ", " << where;
}

TEST(MeshClosed, AnyToleranceGivesAClosedManifold) {
    Tessellator tessellator(meshTestSettings());
    for (const ClosedModel& model : models()) {
        tessellator.setScene(model.scene);
        reference::Random random(7);
        for (int k = 0; k < 100 && !HasFailure(); ++k) {
            TessellateOptions options;
            options.tolerance = std::exp(random.between(std::log(2e-3), std::log(0.15)));
            options.positionsOnly = k % 2 == 0;
            expectClosed(tessellator, options, model, "tolerance " + std::to_string(options.tolerance));
        }
    }
}

TEST(MeshClosed, AnyCameraGivesAClosedManifold) {
    constexpr ViewKind kinds[] = {ViewKind::far,    ViewKind::near, ViewKind::grazing, ViewKind::throughNearPlane,
                                  ViewKind::inside, ViewKind::aside};
    Tessellator tessellator(meshTestSettings());
    for (const ClosedModel& model : models()) {
        tessellator.setScene(model.scene);
        reference::Random random(9);
        for (int k = 0; k < 100 && !HasFailure(); ++k) {
            TessellateOptions options;
            options.width = 128;
            options.height = 96;
            options.camera = randomView(model.scene, kinds[k % 6], 1000 + static_cast<std::uint64_t>(k));
            options.pixelError = std::exp(random.between(std::log(0.5), std::log(8.0)));
            options.cull = false;
            options.positionsOnly = true;
            expectClosed(tessellator, options, model,
                         "camera " + std::to_string(k) + ", pixel error " + std::to_string(options.pixelError));
        }
    }
}

}  // namespace
}  // namespace tessera::test
