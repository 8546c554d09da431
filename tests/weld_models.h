// Models for the tests of weld(): closed patchworks whose neighbours are known, and what the renderer would draw of their borders.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "tessera/scene.h"

namespace tessera::test {

// A patch with the numbers of the vertices in its corners: (0, 0), (1, 0), (1, 1), (0, 1). Bezier, Gregory or rational.
struct ModelPatch {
    PatchKind kind = PatchKind::bezier;
    std::array<glm::dvec3, 16> net{};  // as for PatchKind::bezier
    std::array<double, 16> weights{};
    std::array<int, 4> corners{};
};

struct Model {
    std::vector<ModelPatch> patches;
    std::map<std::pair<int, int>, int> middles;  // edge (lower vertex first) to the vertex that halves it
    int vertices = 0;
};

// `columns` x `rows` patches around a bumpy torus, at least 3 each way; `mixed`: kinds and weights at random, else Bezier.
[[nodiscard]] Model torusModel(int columns, int rows, bool mixed, std::mt19937& random);

// The same around a ball, closed by a pole at either end.
[[nodiscard]] Model ballModel(int columns, int rows, std::mt19937& random);

// Halves patch `index` along u; its second half becomes the last patch.
void halve(Model& model, std::size_t index);

// Turns patches about, and scales the weights of each.
void turn(Model& model, std::mt19937& random);

// Two meshes of each kind, patches between them by chance. `places` is told each patch's mesh and number there.
struct PatchPlace {
    std::size_t mesh = 0;
    std::size_t patch = 0;
};
[[nodiscard]] Scene sceneOf(const Model& model, std::mt19937& random, std::vector<PatchPlace>& places);

[[nodiscard]] double diagonal(const Mesh& mesh);  // of its bounds

// Moves every control point by up to `distance`, or `part` of the least tolerance of the meshes, each `tolerance` times its diagonal.
void disturb(Scene& scene, double distance, std::mt19937& random);
void disturb(Scene& scene, double part, double tolerance, std::mt19937& random);

// What is drawn at parameter `t` of a border, by the rule of EdgeRecord: the record where t lies inside its curve, a corner's own point at
// the curve's ends, else the patch's border.
[[nodiscard]] glm::vec3 drawnPoint(const Mesh& mesh, std::size_t patch, std::size_t side, float t);

// How many places of the model's edges are drawn with different bits by the patches around them.
[[nodiscard]] std::size_t openPlaces(const Model& model, const Scene& scene, const std::vector<PatchPlace>& places);

// The points of a border, in the border's direction.
[[nodiscard]] std::array<glm::vec3, 4> borderOf(const Mesh& mesh, std::size_t patch, std::size_t side);

}  // namespace tessera::test
