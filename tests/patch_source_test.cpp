// Chunks gathered on the host: what stands in them, against the scene itself, and what they are said to take.
#include "chunk_scenes.h"

#include "surface/patch_source.h"
#include "surface/patch_stream.h"

#include "tessera/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace tessera::chunks {
namespace {

std::vector<float> floatsOf(const Mesh& mesh, std::size_t patch) {
    std::vector<float> floats;
    const std::size_t each = pointsPerPatch(mesh.kind);
    for (std::size_t k = patch * each; k < (patch + 1) * each; ++k) {
        const glm::vec3 p = mesh.points[k];
        const float w = mesh.kind == PatchKind::rational ? mesh.weights[k] : 1.0F;
        floats.insert(floats.end(), {w * p.x, w * p.y, w * p.z});
        if (mesh.kind == PatchKind::rational) floats.push_back(w);
    }
    if (mesh.kind == PatchKind::rational) {
        for (const std::size_t corner : {0U, 3U, 12U, 15U}) {
            const glm::vec3 p = mesh.points[patch * each + corner];
            floats.insert(floats.end(), {p.x, p.y, p.z});
        }
    }
    return floats;
}

std::vector<float> floatsOf(const EdgeRecord& record) {
    std::vector<float> floats;
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::vec3 p = record.weights[k] * record.points[k];
        floats.insert(floats.end(), {p.x, p.y, p.z, record.weights[k]});
    }
    return floats;
}

std::vector<float> part(const std::vector<float>& floats, std::size_t first, std::size_t count) {
    if (first + count > floats.size()) return {};
    return {floats.begin() + static_cast<std::ptrdiff_t>(first), floats.begin() + static_cast<std::ptrdiff_t>(first + count)};
}

void expectPatch(const PatchChunk& chunk, std::size_t k, const PlacedPatch& patch) {
    const placed_patch& placed = chunk.placed[k];
    const std::vector<float> floats = floatsOf(*patch.mesh, patch.index);
    ASSERT_EQ(part(chunk.floats, placed.first_float, floats.size()), floats);
    ASSERT_LT(placed.object, chunk.objects.size());
    ASSERT_EQ(chunk.objects[placed.object], patch.object);
    ASSERT_EQ(placed.index_in_mesh, patch.index);
    std::uint32_t flags = patch.mesh->name == "mesh0" && patch.index == 0 ? SIDE_DEGENERATE : 0U;
    std::size_t record = placed.first_record;
    for (const EdgeRecord& edge : patch.mesh->edges) {
        if (edge.patch != patch.index) continue;
        flags |= SIDE_RECORDED << edge.side;
        ASSERT_LT(record, chunk.records.size());
        const edge_info& info = chunk.records[record++];
        const bool rational = std::any_of(edge.weights.begin(), edge.weights.end(), [](float w) { return w != 1.0F; });
        ASSERT_EQ(part(chunk.floats, info.first_float, RECORD_FLOATS), floatsOf(edge));
        ASSERT_EQ(info.object, placed.object);
        ASSERT_EQ((std::array{info.level, info.index, info.reversed, info.rational, info.cuts}),
                  (std::array<std::uint32_t, 5>{edge.level, edge.index, edge.reversed ? 1U : 0U, rational ? 1U : 0U, edge.cuts}));
    }
    ASSERT_EQ(placed.flags, flags);
    // The next patch's records follow: chunks hold no others.
    ASSERT_EQ(record, k + 1 < chunk.placed.size() ? chunk.placed[k + 1].first_record : chunk.records.size());
}

void expectChunk(const PatchChunk& chunk, const std::vector<PlacedPatch>& all, std::uint32_t first, std::uint32_t end) {
    ASSERT_EQ(chunk.first, first);
    ASSERT_EQ(chunk.patches, end - first);
    ASSERT_EQ(chunk.placed.size(), chunk.patches);
    const std::array<std::uint32_t, 5> ends{0, chunk.bezierPatches, chunk.gregoryEnd, chunk.rationalEnd, chunk.patches};
    for (std::uint32_t k = 0; k < chunk.patches; ++k) {
        const auto kind = static_cast<std::size_t>(all[first + k].mesh->kind);
        ASSERT_TRUE(k >= ends[kind] && k < ends[kind + 1]) << "patch " << first + k;
        ASSERT_NO_FATAL_FAILURE(expectPatch(chunk, k, all[first + k])) << "patch " << first + k << " of chunk from " << first;
    }
}

void expectSize(const PatchChunk& chunk, const ChunkSize& size, std::uint64_t eyeFloats) {
    ASSERT_EQ(size.patches, chunk.patches);
    ASSERT_EQ(size.floats, chunk.floats.size());
    ASSERT_EQ(size.records, chunk.records.size());
    ASSERT_EQ(size.objects, chunk.objects.size());
    ASSERT_EQ(size.eyeFloats, eyeFloats);
}

std::uint64_t eyeFloatsOf(const PatchChunk& chunk) {
    PatchSet set;
    setCounts(set, chunk);
    return set.eyeBytes() / sizeof(float);
}

TEST(PatchSource, ChunksOfAnySizeHoldTheScenesPatchesAndWhatTheyAreSaidTo) {
    const Scene scene = sceneOfEveryKind(1);
    const std::vector<PlacedPatch> all = placedPatches(scene);
    const PatchSource source(scene);
    ASSERT_EQ(source.patches(), all.size());
    PatchChunk chunk;  // used again, as streaming does
    std::size_t checked = 0;
    for (const std::uint32_t each : {1U, 2U, 5U, 64U, 310U, 2000U}) {
        const ChunkSize most = source.largest(each);
        ChunkSize seen;
        for (std::uint32_t first = 0; first < source.patches(); first += each) {
            const std::uint32_t end = std::min(source.patches(), first + each);
            source.gather(first, end, chunk);
            ASSERT_NO_FATAL_FAILURE(expectChunk(chunk, all, first, end));
            checked += chunk.patches;
            const ChunkSize size = source.sizeOf(first, end);
            ASSERT_NO_FATAL_FAILURE(expectSize(chunk, size, eyeFloatsOf(chunk)));
            seen = {std::max(seen.patches, size.patches), std::max(seen.floats, size.floats), std::max(seen.eyeFloats, size.eyeFloats),
                    std::max(seen.records, size.records), std::max(seen.objects, size.objects)};
        }
        EXPECT_EQ((std::array{most.patches, most.floats, most.eyeFloats, most.records, most.objects}),
                  (std::array{seen.patches, seen.floats, seen.eyeFloats, seen.records, seen.objects}));
    }
    EXPECT_EQ(checked, 6 * all.size());
}

TEST(PatchSource, RunsFromAnywhereHoldTheirPatches) {
    const Scene scene = sceneOfEveryKind(2);
    const std::vector<PlacedPatch> all = placedPatches(scene);
    const PatchSource source(scene);
    Random random(3);
    PatchChunk chunk;
    for (int run = 0; run < 60; ++run) {
        const auto first = static_cast<std::uint32_t>(random.between(0, source.patches()));
        const auto end = static_cast<std::uint32_t>(random.between(first, source.patches() + 0.99));
        source.gather(first, end, chunk);
        ASSERT_NO_FATAL_FAILURE(expectChunk(chunk, all, first, end));
        ASSERT_NO_FATAL_FAILURE(expectSize(chunk, source.sizeOf(first, end), eyeFloatsOf(chunk)));
    }
}

std::uint64_t floatsOnce(const Mesh& mesh) { return mesh.patchCount() * floatsOf(mesh, 0).size() + RECORD_FLOATS * mesh.edges.size(); }

// Objects of one mesh: three of them, and chunks that begin and end within.
TEST(PatchSource, WhatObjectsShareOfAMeshStandsInAChunkOnce) {
    Scene scene = reference::sceneOf({recorded(reference::bumpyBezierMesh(4, 20), 5)});
    scene.objects.assign(3, scene.objects[0]);
    const PatchSource source(scene);
    PatchChunk chunk;
    for (std::uint32_t first = 0; first < 60; ++first) {
        for (std::uint32_t end = first + 1; end <= 60; ++end) {
            source.gather(first, end, chunk);
            std::vector<bool> held(20, false);
            for (std::uint32_t patch = first; patch < end; ++patch) held[patch % 20] = true;
            std::size_t floats = 0;
            for (std::size_t patch = 0; patch < 20; ++patch)
                floats += held[patch] ? floatsOf(scene.meshes[0], patch).size() : std::size_t{0};
            for (const EdgeRecord& edge : scene.meshes[0].edges) floats += held[edge.patch] ? std::size_t{RECORD_FLOATS} : 0;
            ASSERT_EQ(chunk.floats.size(), floats) << first << " to " << end;
        }
    }
}

// 10 million placed patches: 20,000 objects of two meshes. Walking single patches for each of the sizes asked here would take hours.
TEST(PatchSource, TenMillionPlacedPatchesArePlannedByTheirObjects) {
    Scene scene = reference::sceneOf({reference::bumpyBezierMesh(6, 400), recorded(reference::bumpyPnMesh(7, 600), 8)});
    const std::vector<Object> pair = scene.objects;
    for (int k = 1; k < 10000; ++k) scene.objects.insert(scene.objects.end(), pair.begin(), pair.end());
    const PatchSource source(scene);
    ASSERT_EQ(source.patches(), 10'000'000U);
    std::uint64_t before = 0;
    for (std::uint32_t each = 64; each <= 4'000'000; each = each * 5 / 4) {
        const ChunkSize most = source.largest(each);
        EXPECT_LE(most.floats, floatsOnce(scene.meshes[0]) + floatsOnce(scene.meshes[1]));
        EXPECT_EQ(most.patches, each);
        EXPECT_GE(most.inputBytes(false) + most.placedBytes(false), before);
        before = most.inputBytes(false) + most.placedBytes(false);
    }
    PatchChunk chunk;
    source.gather(9'999'000, 10'000'000, chunk);
    EXPECT_EQ(chunk.objects, (std::vector<std::uint32_t>{19997, 19999}));
    EXPECT_EQ(chunk.placed.back().index_in_mesh, 599U);
}

TEST(PatchSource, RefusesMorePlacedPatchesThanCanBeCounted) {
    Scene scene = reference::sceneOf({reference::bumpyBezierMesh(9, 1024)});
    scene.objects.assign(std::size_t{1} << 21, scene.objects[0]);
    EXPECT_THROW(PatchSource{scene}, Error);
    scene.objects.pop_back();
    EXPECT_EQ(PatchSource(scene).patches(), (1U << 31) - 1024U);
}

TEST(PatchSource, ASceneWithoutPatchesIsAChunkOfNone) {
    const PatchSource source;
    PatchChunk chunk;
    source.gather(0, 0, chunk);
    EXPECT_EQ(source.patches(), 0U);
    EXPECT_EQ(chunk.patches, 0U);
    EXPECT_EQ(source.largest(7).floats, 0U);
}

}  // namespace
}  // namespace tessera::chunks
