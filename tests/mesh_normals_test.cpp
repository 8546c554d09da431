// Normals that the vertex stage of a tessellation makes: of exact surfaces, and their limits at poles and corners without tangents.
#include "closed_models.h"
#include "exact_patches.h"
#include "hand_patterns.h"
#include "patch_eval.h"

#include "tessera/surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tessera::meshing {
namespace {

using reference::Random;

class MeshNormals : public ::testing::TestWithParam<int> {
protected:
    VerticesRig rig{TESSERA_TEST_CACHE, GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Lanes, MeshNormals, ::testing::Values(16, 8, 1, VerticesRig::gpuShape),
                         [](const auto& lanes) { return "of" + std::to_string(lanes.param); });

// The angle from each normal to what `exact` gives for its position.
template <typename Exact>
double worstTurn(const std::vector<MeshVertex>& vertices, Exact exact) {
    double worst = 0;
    for (const MeshVertex& vertex : vertices) {
        const glm::dvec3 normal(vertex.normal[0], vertex.normal[1], vertex.normal[2]);
        const glm::dvec3 position(vertex.position[0], vertex.position[1], vertex.position[2]);
        worst = std::max(worst, glm::length(normal - exact(position, vertex)));
    }
    return worst;
}

// Rational patches divide sums of some roundings each; 1e-5 is the promise.
TEST_P(MeshNormals, NormalsOfSpheresConesAndToriAreExactAtTheirPolesToo) {
    const double size = 2.5;
    const Scene ball = reference::sceneOf({sphere("ball", size, -size, size)});
    static_cast<void>(patternsByEdges(rig, ball));
    EXPECT_LE(worstTurn(rig.all(), [](const glm::dvec3& p, const MeshVertex&) { return glm::normalize(p); }), 1e-5);

    const Scene ring = reference::sceneOf({torus("ring", 2.0, 0.5)});
    static_cast<void>(patternsByEdges(rig, ring));
    EXPECT_LE(worstTurn(rig.all(), [](const glm::dvec3& p,
                                      const MeshVertex&) { return glm::normalize(p - 2.0 * glm::normalize(glm::dvec3(p.x, p.y, 0.0))); }),
              1e-5);

    // The apex has the normal of where its parameters are, on each patch's first border.
    const Scene hat = reference::sceneOf({cone("hat", 2.0, 1.0)});
    static_cast<void>(patternsByEdges(rig, hat));
    std::size_t apexes = 0;
    const Mesh& mesh = hat.meshes.front();
    EXPECT_LE(worstTurn(rig.all(),
                        [&](const glm::dvec3& p, const MeshVertex& vertex) {
                            if (p.z < 2.0) return glm::normalize(glm::dvec3(2.0 * glm::dvec2(p) / glm::length(glm::dvec2(p)), 1.0));
                            ++apexes;
                            const test::SurfacePoint below = test::patchPoint(mesh, vertex.patch, vertex.u, 0.5);
                            return glm::normalize(below.normal());
                        }),
              1e-5);
    EXPECT_EQ(apexes, mesh.patchCount());
}

TEST_P(MeshNormals, BallsOfEveryKindHaveTheLimitAtTheirPoles) {
    Mesh polar = test::polarSolid(3, 8, 6);
    const Mesh gregory = reference::asGregory(polar);
    const Mesh rational = reference::weighted(polar, 1.0, 1);
    for (const Mesh& mesh : {polar, gregory, rational}) {
        const Scene scene = reference::sceneOf({mesh});
        const std::vector<mesh_pattern> patterns = patternsByEdges(rig, scene);
        std::size_t poles = 0;
        const double worst = worstTurn(rig.all(), [&](const glm::dvec3& p, const MeshVertex& vertex) {
            const std::vector<glm::dvec3> points = reference::patchPoints(mesh, vertex.patch);
            if (std::count(patterns[vertex.patch].side, patterns[vertex.patch].side + 4, 0U) > 0 && (p == points[0] || p == points.back()))
                ++poles;
            const std::vector<double> weights = reference::patchWeights(mesh, vertex.patch);
            return reference::unitNormal(mesh.kind, points, vertex.u, vertex.v, weights);
        });
        EXPECT_LE(worst, mesh.kind == PatchKind::gregory ? 3e-4 : 3e-5);
    }
}

// Corners where control points coincide, or the tangents are parallel.
TEST_P(MeshNormals, CornersWithoutTangentsHaveTheLimit) {
    Mesh mesh = reference::bumpyBezierMesh(8, 3);
    mesh.points[1] = mesh.points[0];
    mesh.points[4] = mesh.points[0];
    mesh.points[16 + 2] = mesh.points[16 + 3];
    mesh.points[32 + 11] = mesh.points[32 + 14];
    for (const Mesh& form : {mesh, reference::weighted(mesh, 1.0, 1)}) {
        const Scene scene = reference::sceneOf({form});
        static_cast<void>(patternsByEdges(rig, scene));
        EXPECT_LE(worstTurn(rig.all(),
                            [&](const glm::dvec3&, const MeshVertex& vertex) {
                                return reference::unitNormal(form.kind, reference::patchPoints(form, vertex.patch), vertex.u, vertex.v,
                                                             reference::patchWeights(form, vertex.patch));
                            }),
                  5e-5);
    }
}

TEST_P(MeshNormals, NormalsHaveUnitLengthAtAnySizeAndAreZeroOnPatchesWithoutArea) {
    for (const float scale : {1e-18F, 1e-9F, 1e9F, 1e17F}) {
        Mesh mesh = reference::bumpyBezierMesh(8, 3);
        for (glm::vec3& p : mesh.points) p *= scale;
        for (const Mesh& form : {mesh, reference::asGregory(mesh), reference::weighted(mesh, 2.0, 1)}) {
            static_cast<void>(patternsByEdges(rig, reference::sceneOf({form})));
            for (const MeshVertex& vertex : rig.all())
                ASSERT_NEAR(std::hypot(vertex.normal[0], vertex.normal[1], vertex.normal[2]), 1.0, 1e-6) << scale;
        }
    }
    Mesh line = reference::bumpyBezierMesh(8, 1);
    for (std::size_t i = 0; i < 16; ++i) line.points[i] = {static_cast<float>(i % 4), 0.0F, 0.0F};
    Random random(1);
    rig.set(reference::sceneOf({line}), {ring({3, 3, 3, 3}, 4, 4, random)});
    for (const MeshVertex& vertex : rig.all()) ASSERT_EQ(glm::vec3(vertex.normal[0], vertex.normal[1], vertex.normal[2]), glm::vec3(0.0F));
}

// The vertex of a side that is unity point is the first corner's, in the loop's order.
TEST_P(MeshNormals, APointHasTheParametersOfItsFirstCorner) {
    const std::array<glm::vec2, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    const std::array<std::array<std::size_t, 2>, 4> firstAndStep{{{0, 1}, {3, 4}, {12, 1}, {0, 4}}};
    Random random(2);
    for (std::size_t s = 0; s < 4; ++s) {
        Mesh mesh = reference::bumpyBezierMesh(8, 1);
        for (std::size_t i = 1; i < 4; ++i)
            mesh.points[firstAndStep.at(s)[0] + i * firstAndStep.at(s)[1]] = mesh.points[firstAndStep.at(s)[0]];
        std::array<std::uint32_t, 4> sides{5, 6, 7, 8};
        sides.at(s) = 0;
        const mesh_pattern pattern = ring(sides, 4, 4, random);
        rig.set(reference::sceneOf({mesh}), {pattern});
        const MeshVertex vertex =
            rig.all().at(loopVertex(pattern, static_cast<int>((s + 1) % 4), s == 0 || s == 3 ? 0 : pattern.side[(s + 1) % 4]));
        EXPECT_EQ(glm::vec2(vertex.u, vertex.v), corners.at(s)) << s;
        EXPECT_EQ(glm::vec3(vertex.position[0], vertex.position[1], vertex.position[2]), mesh.points[firstAndStep.at(s)[0]]);
        EXPECT_NEAR(std::hypot(vertex.normal[0], vertex.normal[1], vertex.normal[2]), 1.0, 1e-6);
    }
}

}  // namespace
}  // namespace tessera::meshing
