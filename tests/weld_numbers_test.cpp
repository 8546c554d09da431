// Numbers of welded vertices against plain welding: of vertices made on the host, by the bits of their positions.
#include "mesh/weld_numbers.h"

#include "closed_models.h"
#include "mesh/pattern.h"
#include "mesh_host.h"
#include "tessera/weld.h"
#include "weld_models.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

using Bits = std::array<std::uint32_t, 3>;

Bits bitsOf(const MeshVertex& vertex) {
    Bits bits{};
    for (std::size_t c = 0; c < 3; ++c) bits[c] = vertex.position[c] == 0.0F ? 0U : std::bit_cast<std::uint32_t>(vertex.position[c]);
    return bits;
}

std::vector<std::uint64_t> numbersOf(const WeldNumbers& weld, const mesh_pattern& pattern, std::size_t patch) {
    std::vector<std::uint64_t> numbers;
    weld.loop(patch, numbers);
    for (std::uint64_t k = 0; numbers.size() < patternVertices(pattern); ++k) numbers.push_back(weld.firstInner(patch) + k);
    return numbers;
}

// The same bits, the same number, and the other way round; and each patch's new vertices follow each other. With WeldScope::object, bits
// have the object with them.
void expectPlainWelding(const HostMesh& mesh, WeldScope scope, const std::string& name) {
    const MeshOutline outline = mesh.outline();
    const WeldNumbers weld(outline, scope);
    std::map<std::pair<std::uint32_t, Bits>, std::uint64_t> numberOf;
    std::uint64_t next = 0;
    std::size_t wrong = 0;
    for (std::size_t patch = 0; patch < mesh.patches().size(); ++patch) {
        EXPECT_EQ(weld.firstNew(patch), next) << name << ", patch " << patch;
        const std::vector<std::uint64_t> numbers = numbersOf(weld, mesh.patterns[patch], patch);
        const std::uint32_t object = scope == WeldScope::object ? mesh.patches()[patch].object : 0;
        for (std::uint64_t k = 0; k < numbers.size(); ++k) {
            const auto [found, isNew] = numberOf.try_emplace({object, bitsOf(mesh.vertex(patch, k))}, next);
            if (isNew) ++next;
            if (found->second != numbers[k]) ++wrong;
        }
    }
    EXPECT_EQ(wrong, 0U) << name;
    EXPECT_EQ(weld.vertexCount(), next) << name;
}

TEST(WeldNumbers, ClosedModelsAreNumberedAsByTheirPositions) {
    for (const ClosedModel& model : closedModels()) expectPlainWelding(HostMesh(model.scene, 9.0, 4), WeldScope::scene, model.name);
}

TEST(WeldNumbers, RecordsOfMixedLevelsAndKindsAreNumberedAsByTheirPositions) {
    std::mt19937 random(12);
    std::size_t records = 0, levels = 0;
    for (int run = 0; run < 12; ++run) {
        Model model = run % 4 == 3 ? ballModel(5, 4, random) : torusModel(5, 4, run % 2 == 1, random);
        for (int cut = 0; cut < 12 && run % 4 != 3; ++cut) {
            if (run % 3 == 0) turn(model, random);
            halve(model, random() % model.patches.size());
        }
        turn(model, random);
        std::vector<PatchPlace> places;
        Scene scene = sceneOf(model, random, places);
        disturb(scene, 0.3, 1e-5, random);
        static_cast<void>(weld(scene, 1e-5));
        for (const Mesh& mesh : scene.meshes) {
            records += mesh.edges.size();
            for (const EdgeRecord& edge : mesh.edges) levels += edge.level > 1 ? 1 : 0;
        }
        expectPlainWelding(HostMesh(scene, 3.0, 4), WeldScope::scene, "run " + std::to_string(run));
    }
    EXPECT_GT(records, 0U);
    EXPECT_GT(levels, 0U);
}

TEST(WeldNumbers, ObjectsShareOnlyWhereTheyAreOfOneScope) {
    const std::vector<PatchKind> kinds{PatchKind::bezier, PatchKind::pn, PatchKind::gregory};
    Scene scene = placedAnyhow(mixedSolid(3, 2, kinds), 5);
    static_cast<void>(weld(scene, 0.0));
    const HostMesh mesh(scene, 3.0, 4);
    expectPlainWelding(mesh, WeldScope::scene, "scene");
    expectPlainWelding(mesh, WeldScope::object, "object");
    const WeldNumbers all(mesh.outline(), WeldScope::scene), each(mesh.outline(), WeldScope::object),
        none(mesh.outline(), WeldScope::patch);
    EXPECT_LT(all.vertexCount(), each.vertexCount());
    EXPECT_LT(each.vertexCount(), none.vertexCount());
    EXPECT_EQ(none.vertexCount(), mesh.outline().sizes.distinctVertices);
}

TEST(WeldNumbers, PatchesOutsideTheViewHaveNone) {
    HostMesh mesh(placedAnyhow({polarSolid(4, 4, 3)}, 5), 4.0, 4);
    for (std::size_t patch = 0; patch < mesh.patterns.size(); patch += 3) mesh.patterns[patch] = {};
    mesh.finish();
    expectPlainWelding(mesh, WeldScope::scene, "every third patch left out");
}

TEST(WeldNumbers, APatchThatMeetsItselfSharesItsOwnBorder) {
    // A tube of one patch: its sides 1 and 3 are the same curve, bent; and side 0 runs there and back on one line.
    Mesh tube;
    tube.name = "tube";
    for (int v = 0; v < 4; ++v) {
        const auto z = static_cast<float>(v);
        const float bend = 0.1F * z * z, wide = v == 0 ? 0.0F : 2.0F;
        tube.points.insert(tube.points.end(), {{bend, 0, z}, {3.0F + bend, wide, z}, {3.0F + bend, -wide, z}, {bend, 0, z}});
    }
    Scene scene;
    scene.meshes.push_back(tube);
    Object object;
    object.name = object.mesh = "tube";
    scene.objects.push_back(object);
    for (const double density : {0.3, 1.0, 1.3, 2.0}) expectPlainWelding(HostMesh(scene, density, 4), WeldScope::scene, "tube");
}

}  // namespace
}  // namespace tessera::test
