// Limits of a tessellator's memory: what one mesh took never stands in another's way, what is told to be enough is enough, and patches that
// make nothing are told from those out of view.
#include "closed_models.h"
#include "mesh_kept.h"
#include "sample_meshes.h"
#include "tessera/error.h"
#include "tessera/surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

namespace tessera::test {
namespace {

constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20;

TessellateOptions within(double tolerance, std::uint64_t memoryBytes, bool positionsOnly = false) {
    TessellateOptions options;
    options.tolerance = tolerance;
    options.memoryBytes = memoryBytes;
    options.positionsOnly = positionsOnly;
    return options;
}

Scene ball() {
    Scene scene = reference::sceneOf({sphere("ball", 1.0, -1.0, 1.0)});
    scene.name = "ball";
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

// The least tolerance, of those that halve in area, at which the mesh still fits.
double leastTolerance(std::uint64_t memoryBytes, bool positionsOnly) {
    Tessellator tessellator(meshTestSettings());
    tessellator.setScene(ball());
    double least = 1e-3;
    while (refusal([&] { (void)tessellator.tessellate(within(least * 0.8, memoryBytes, positionsOnly)); }).empty()) least *= 0.8;
    return least;
}

TEST(TessellatorLimits, AMeshOfAnotherShapeFitsWhereItWouldAlone) {
    const std::uint64_t memory = 16 * mebibyte;
    const double whole = leastTolerance(memory, false), positions = leastTolerance(memory, true);
    ASSERT_LT(positions, whole);
    Tessellator tessellator(meshTestSettings());
    tessellator.setScene(ball());
    for (int round = 0; round < 2; ++round) {
        EXPECT_EQ(refusal([&] { (void)tessellator.tessellate(within(whole, memory)); }), "");
        EXPECT_EQ(refusal([&] { (void)tessellator.tessellate(within(positions, memory, true)); }), "");
        EXPECT_LE(tessellator.statistics().deviceBytesPeak, memory);
        KeepingSink sink;
        EXPECT_EQ(refusal([&] { tessellator.stream(within(positions / 2, memory, true), sink); }), "");
    }
}

TEST(TessellatorLimits, ASurfaceThatGrowsSeldomNeedsOtherBuffers) {
    Scene scene = ball();
    Tessellator tessellator(meshTestSettings());
    tessellator.setScene(scene);
    DeviceMesh before = tessellator.tessellate(within(1e-4, 0));
    const MeshSizes first = before.sizes;
    int changes = 0, larger = 0;
    for (int frame = 0; frame < 40; ++frame) {
        for (glm::vec3& point : scene.meshes[0].points) point *= 1.02F;
        tessellator.replacePoints(0, scene.meshes[0].points);
        const DeviceMesh next = tessellator.tessellate(within(1e-4, 0));
        changes += next.vertices != before.vertices || next.indices != before.indices ? 1 : 0;
        larger += next.sizes.vertices > before.sizes.vertices ? 1 : 0;
        before = next;
    }
    EXPECT_GT(before.sizes.vertices, 2 * first.vertices);
    EXPECT_GT(larger, 20);
    // Each of the two buffers takes a quarter more than it needs; a new one may by chance be where the old one was.
    const double growth = static_cast<double>(before.sizes.vertices) / static_cast<double>(first.vertices);
    EXPECT_LE(changes, 2 * static_cast<int>(std::ceil(std::log(growth) / std::log(1.25))));
}

// A larger budget makes for larger chunks of patches, which take a part of what it gives more.
TEST(TessellatorLimits, TheMemoryThatIsToldIsEnough) {
    Scene scene;
    scene.name = "many";
    scene.meshes.push_back(reference::bumpyBezierMesh(1, 20000));
    scene.meshes.back().name = "m";
    for (int k = 0; k < 4; ++k)
        scene.objects.push_back({"o" + std::to_string(k), {{0.0F, 0.0F, static_cast<float>(k)}}, "m", glm::vec3(1.0F), {}});
    Tessellator tessellator(meshTestSettings());
    tessellator.setScene(scene);
    std::size_t refused = 0;
    for (const double tolerance : {0.3, 0.1}) {
        for (std::uint64_t memory = 12 * mebibyte; memory < 90 * mebibyte; memory += 18 * mebibyte) {
            const std::string told = refusal([&] { (void)tessellator.tessellate(within(tolerance, memory)); });
            if (told.empty()) continue;
            ++refused;
            const std::size_t at = told.find('(', told.find("a larger tolerance or "));
            ASSERT_NE(at, std::string::npos) << told;
            const std::uint64_t enough = std::stoull(told.substr(at + 1));
            EXPECT_EQ(refusal([&] { (void)tessellator.tessellate(within(tolerance, enough)); }), "") << told;
            EXPECT_LE(tessellator.statistics().deviceBytesPeak, enough);
        }
    }
    EXPECT_GT(refused, 5U);
}

TEST(TessellatorLimits, AStreamsTimesAreOfAllStages) {
    Tessellator tessellator(meshTestSettings());
    tessellator.setScene(ball());
    (void)tessellator.measure(within(0.01, 0));
    for (int round = 0; round < 2; ++round) {
        KeepingSink sink;
        tessellator.stream(within(0.01, 0), sink);
        const MeshStatistics& times = tessellator.statistics();
        for (const double ms : {times.placeMs, times.factorsMs, times.offsetsMs, times.vertexMs, times.indexMs}) EXPECT_GT(ms, 0.0);
    }
}

TEST(TessellatorLimits, WhatHasNoAreaIsNotOutOfView) {
    Scene scene = ball();
    scene.meshes[0].points.assign(scene.meshes[0].points.size(), glm::vec3(1.0F));
    Tessellator tessellator(meshTestSettings());
    tessellator.setScene(scene);
    const MeshSizes sizes = tessellator.measure(within(0.1, 0));
    EXPECT_EQ(sizes.triangles, 0U);
    EXPECT_EQ(sizes.patchesCulled, 0U);
    // The buffers are there even so.
    const DeviceMesh empty = tessellator.tessellate(within(0.1, 0));
    EXPECT_NE(empty.vertices, nullptr);
    EXPECT_NE(empty.indices, nullptr);
}

}  // namespace
}  // namespace tessera::test
