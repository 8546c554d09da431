// The tessellator's contract: sizes told first, buffers used again, pieces and chunks that change nothing, points that change, budgets.
#include "closed_models.h"
#include "mesh_kept.h"
#include "sample_meshes.h"
#include "tessera/error.h"
#include "tessera/surfaces.h"
#include "tessera/weld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

TessellateOptions within(double tolerance) {
    TessellateOptions options;
    options.tolerance = tolerance;
    return options;
}

Scene mixedScene() {
    Scene scene = placedAnyhow(mixedSolid(5, 3, {PatchKind::bezier, PatchKind::gregory, PatchKind::rational, PatchKind::pn}), 3);
    scene.name = "mixed";
    weld(scene);
    return scene;
}

Scene sphereScene(double radius = 1.0) {
    Scene scene = reference::sceneOf({sphere("ball", radius, -radius, radius)});
    scene.name = "spheres";
    return scene;
}

std::string refusal(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(TessellatorTest, SizesToldFirstAreTheMeshs) {
    Tessellator tessellator(meshTestSettings());
    tessellator.setScene(mixedScene());
    const MeshSizes told = tessellator.measure(within(0.01));
    const DeviceMesh mesh = tessellator.tessellate(within(0.01));
    EXPECT_EQ(told.vertices, mesh.sizes.vertices);
    EXPECT_EQ(told.triangles, mesh.sizes.triangles);
    EXPECT_EQ(told.vertexBytes, 40 * told.vertices);
    EXPECT_EQ(told.indexBytes, 12 * told.triangles);
    EXPECT_EQ(told.patches, mixedScene().placedPatchCount());
    const KeptMesh kept = keep(mesh);
    for (const std::uint32_t index : kept.indices) ASSERT_LT(index, kept.vertices.size());
    std::vector<bool> used(kept.vertices.size());
    for (const std::uint32_t index : kept.indices) used[index] = true;
    EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
}

TEST(TessellatorTest, PiecesPutTogetherAreTheWhole) {
    Tessellator tessellator(meshTestSettings());
    tessellator.setScene(mixedScene());
    const KeptMesh whole = keep(tessellator.tessellate(within(2e-4)));
    KeepingSink sink;
    tessellator.stream(within(2e-4), sink);
    EXPECT_EQ(sink.sizes.vertices, whole.vertices.size());
    expectSameMesh(whole, sink.mesh);
}

TEST(TessellatorTest, ASmallBudgetGivesTheSameMeshInMorePiecesAndChunks) {
    Scene scene;
    scene.name = "many";
    for (int k = 0; k < 40; ++k) {
        scene.meshes.push_back(reference::bumpyBezierMesh(static_cast<std::uint64_t>(k), 1500));
        scene.meshes.back().name = "m" + std::to_string(k);
        scene.objects.push_back(
            {"o" + std::to_string(k), {{0.0F, 0.0F, static_cast<float>(k)}}, scene.meshes.back().name, glm::vec3(1.0F), {}});
    }
    Tessellator tessellator(meshTestSettings());
    tessellator.setScene(scene);
    KeepingSink large, small;
    TessellateOptions options = within(0.05);
    tessellator.stream(options, large);
    EXPECT_EQ(tessellator.statistics().chunks, 1U);
    options.memoryBytes = std::uint64_t{20} << 20;
    tessellator.stream(options, small);
    EXPECT_GT(tessellator.statistics().chunks, 1U);
    EXPECT_GT(small.pieces, large.pieces);
    EXPECT_LE(tessellator.statistics().deviceBytesPeak, options.memoryBytes);
    expectSameMesh(large.mesh, small.mesh);
}

TEST(TessellatorTest, ADenseSceneStreamsWithinTheLeastBudget) {
    Tessellator tessellator(meshTestSettings());
    tessellator.setScene(sphereScene());
    TessellateOptions options = within(5e-6);
    options.memoryBytes = 1;
    const std::string told = refusal([&] {
        KeepingSink sink;
        tessellator.stream(options, sink);
    });
    const std::size_t at = told.find("--memory ");
    ASSERT_NE(at, std::string::npos) << told;
    options.memoryBytes = std::stoull(told.substr(at + 9)) << 20;
    KeepingSink small, large;
    tessellator.stream(options, small);
    EXPECT_LE(tessellator.statistics().deviceBytesPeak, options.memoryBytes);
    options.memoryBytes = 0;
    tessellator.stream(options, large);
    expectSameMesh(large.mesh, small.mesh);
    EXPECT_TRUE(closedness(small.mesh).closed()) << closedness(small.mesh).text();
}

TEST(TessellatorTest, ReplacedPointsGiveTheMeshOfASceneThatHasThem) {
    Scene before = reference::sceneOf({sphere("ball", 1.0, -1.0, 1.0), reference::bumpyBezierMesh(4, 30)});
    Scene after = before;
    for (glm::vec3& p : after.meshes[0].points) p *= glm::vec3(1.5F, 0.7F, 1.0F);
    // A side that becomes one point.
    for (int k = 1; k < 4; ++k) after.meshes[1].points[static_cast<std::size_t>(k)] = after.meshes[1].points[0];
    Tessellator fresh(meshTestSettings()), changed(meshTestSettings());
    fresh.setScene(after);
    changed.setScene(before);
    (void)changed.tessellate(within(0.01));
    changed.replacePoints(0, after.meshes[0].points);
    changed.replacePoints(1, after.meshes[1].points);
    expectSameMesh(keep(fresh.tessellate(within(0.01))), keep(changed.tessellate(within(0.01))));
}

TEST(TessellatorTest, FramesUseTheSameBuffers) {
    Tessellator tessellator(meshTestSettings());
    const Scene scene = sphereScene();
    tessellator.setScene(scene);
    const DeviceMesh first = tessellator.tessellate(within(0.001));
    std::vector<glm::vec3> points = scene.meshes[0].points;
    for (int frame = 0; frame < 3; ++frame) {
        for (glm::vec3& p : points) p *= 0.9F;
        tessellator.replacePoints(0, points);
        const DeviceMesh next = tessellator.tessellate(within(0.001));
        EXPECT_EQ(next.vertices, first.vertices);
        EXPECT_EQ(next.indices, first.indices);
        EXPECT_LT(next.sizes.vertices, first.sizes.vertices);
    }
}

TEST(TessellatorTest, ReplacingIsRefusedWhereItCannotHold) {
    Tessellator tessellator(meshTestSettings());
    const Scene scene = mixedScene();
    tessellator.setScene(scene);
    const std::vector<glm::vec3> points(16);
    EXPECT_NE(refusal([&] { tessellator.replacePoints(9, points); }).find("there is no mesh 9"), std::string::npos);
    EXPECT_NE(refusal([&] { tessellator.replacePoints(0, scene.meshes[0].points); }).find("edge records"), std::string::npos);
    tessellator.setScene(sphereScene());
    EXPECT_NE(refusal([&] { tessellator.replacePoints(0, points); }).find("give as many"), std::string::npos);
    std::vector<glm::vec3> bad = sphereScene().meshes[0].points;
    bad[7].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(refusal([&] { tessellator.replacePoints(0, bad); }).find("not finite"), std::string::npos);
    // As it was.
    expectSameMesh(keep(tessellator.tessellate(within(0.01))), [] {
        Tessellator other(meshTestSettings());
        other.setScene(sphereScene());
        return keep(other.tessellate(within(0.01)));
    }());
}

TEST(TessellatorTest, WhatIsNotInTheViewIsLeftOut) {
    Scene scene = sphereScene();
    scene.objects.push_back({"behind", {{0.0F, 0.0F, 30.0F}}, scene.meshes[0].name, glm::vec3(1.0F), {}});
    Tessellator tessellator(meshTestSettings());
    tessellator.setScene(scene);
    TessellateOptions options;
    options.pixelError = 0.5;
    options.camera = reference::cameraAt({0, 0, 5}, {0, 0, 0}, 60);
    EXPECT_EQ(tessellator.measure(options).patchesCulled, 8U);
    options.cull = false;
    EXPECT_EQ(tessellator.measure(options).patchesCulled, 0U);
    options.cull = true;
    options.camera = reference::cameraAt({0, 0, 50}, {0, 0, 100}, 60);
    const DeviceMesh nothing = tessellator.tessellate(options);
    EXPECT_EQ(nothing.sizes.patchesCulled, 16U);
    EXPECT_EQ(nothing.sizes.triangles, 0U);
}

TEST(TessellatorTest, BadOptionsAreRefused) {
    Tessellator tessellator(meshTestSettings());
    EXPECT_NE(refusal([&] { (void)tessellator.measure(within(0.1)); }).find("no scene is set"), std::string::npos);
    tessellator.setScene(sphereScene());
    for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
        EXPECT_NE(refusal([&] { (void)tessellator.measure(within(bad)); }).find("tolerance"), std::string::npos) << bad;
    EXPECT_NE(refusal([&] { (void)tessellator.measure(within(1e-30)); }).find("is the least"), std::string::npos);
    TessellateOptions both = within(0.1);
    both.pixelError = 1;
    EXPECT_NE(refusal([&] { (void)tessellator.measure(both); }).find("give one"), std::string::npos);
    both.tolerance = 0;
    EXPECT_NE(refusal([&] { (void)tessellator.measure(both); }).find("needs a camera"), std::string::npos);
    TessellateOptions tight = within(1e-5);
    tight.memoryBytes = std::uint64_t{9} << 20;
    EXPECT_NE(refusal([&] { (void)tessellator.tessellate(tight); }).find("memory"), std::string::npos);
    // None of it harmed it.
    EXPECT_GT(tessellator.tessellate(within(0.1)).sizes.triangles, 0U);
}

}  // namespace
}  // namespace tessera::test
