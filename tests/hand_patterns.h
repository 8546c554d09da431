// Tessellation patterns made by hand, for tests of the stages that take them.
#pragma once

#include "mesh_vertices_rig.h"
#include "sample_meshes.h"

#include "mesh/pattern.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace tessera::meshing {

constexpr std::uint32_t unity = 1U << 24;

[[nodiscard]] std::uint32_t between(reference::Random& random, std::uint32_t low, std::uint32_t high);

// MESH_RING, its inner lines a third to a whole cell from the sides.
[[nodiscard]] mesh_pattern ring(std::array<std::uint32_t, 4> sides, std::uint32_t cellsU, std::uint32_t cellsV, reference::Random& random);

// A scene with a pattern for each of its placed patches, in the order in which the device numbers them.
struct Model {
    Scene scene;
    std::vector<mesh_pattern> patterns;
    struct Patch {
        PatchKind kind;
        std::uint32_t object, patch;
        std::vector<glm::dvec3> points;  // world, for objects that stand as their meshes do
        std::vector<double> weights;
    };
    std::vector<Patch> patches;
};

// Patches of all kinds, and patterns of all forms in turn, about every tenth of which is cut.
[[nodiscard]] Model allKinds();

// Patterns whose sides' segments come from their middles' bits, which both their patches have; none where a side is one point. They are
// set in the rig.
[[nodiscard]] std::vector<mesh_pattern> patternsByEdges(VerticesRig& rig, const Scene& scene);

using Position = std::array<std::uint32_t, 3>;
[[nodiscard]] inline std::array<std::uint32_t, 10> bitsOf(const MeshVertex& vertex) {
    return std::bit_cast<std::array<std::uint32_t, 10>>(vertex);
}
[[nodiscard]] inline Position positionBits(const MeshVertex& vertex) {
    const auto bits = bitsOf(vertex);
    return {bits[0], bits[1], bits[2]};
}
// -0 as 0.
[[nodiscard]] inline std::uint32_t bitsOf(float value) { return value == 0.0F ? 0U : std::bit_cast<std::uint32_t>(value); }

// Calls f(patch, number in its pattern, vertex) for all of them.
template <typename F>
void forEach(const std::vector<mesh_pattern>& patterns, const std::vector<MeshVertex>& vertices, F f) {
    std::size_t at = 0;
    std::vector<std::uint64_t> numbers;
    for (std::size_t patch = 0; patch < patterns.size(); ++patch) {
        for (std::uint32_t unit = 0; unit < patternUnits(patterns[patch]); ++unit) {
            unitVertexNumbers(patterns[patch], unit, numbers);
            for (const std::uint64_t number : numbers) f(patch, number, vertices.at(at++));
        }
    }
    ASSERT_EQ(at, vertices.size());
}

}  // namespace tessera::meshing
