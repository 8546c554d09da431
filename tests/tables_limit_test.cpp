// Table-driven surfaces against the limit by subdivision alone, and their edges against each other, to the bit.
#include "catmull_clark_reference.h"
#include "cell_checks.h"
#include "mesh_kept.h"
#include "subdivision_shapes.h"
#include "tessera/subdivision_tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

constexpr double kMostDistance = 1e-5;  // of the cage's size
constexpr double kMostDegrees = 0.1;
// OpenSubdiv's tangents are not exact at vertices where edges of several sharpnesses meet.
constexpr double kMostCornerDegrees = 0.5;

// A square of the cage that a table may stand for, and by how many quarters its parameters are turned.
struct Square {
    std::uint32_t face = 0;
    std::optional<std::uint32_t> quarter;  // of the face, after a step of subdivision
    std::uint32_t turned = 0;
};

bool allQuads(const Cage& cage) {
    return std::all_of(cage.faceSizes.begin(), cage.faceSizes.end(), [](std::uint32_t size) { return size == 4; });
}

// (u, v) a quarter turn on, `times`.
glm::dvec2 turned(glm::dvec2 uv, std::uint32_t times) {
    for (std::uint32_t k = 0; k < times; ++k) uv = {1.0 - uv.y, uv.x};
    return uv;
}

class TableLimit {
public:
    TableLimit(const Cage& cage, bool quartered) : cage_(cage), reference_(cage), coarse_(quartered || !allQuads(cage)) {}

    [[nodiscard]] bool coarse() const { return coarse_; }

    [[nodiscard]] LimitPoint at(const Square& square, const glm::dvec2& given) const {
        const glm::dvec2 uv = turned(given, square.turned);
        if (!square.quarter) return reference_.at(square.face, 0, uv.x, uv.y);
        if (cage_.faceSizes[square.face] != 4) return reference_.at(square.face, *square.quarter, uv.x, uv.y);
        const glm::dvec2 part = turned(0.5 * uv, *square.quarter);
        return reference_.at(square.face, 0, part.x, part.y);
    }

    // The one whose corners are these: at (0, 0), (1, 0), (1, 1), (0, 1).
    [[nodiscard]] std::optional<Square> find(const std::array<glm::dvec3, 4>& corners, double tolerance) const {
        constexpr std::array<glm::dvec2, 4> places{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        for (std::uint32_t face = 0; face < cage_.faceCount(); ++face) {
            for (std::uint32_t quarter = 0; quarter < (coarse_ ? cage_.faceSizes[face] : 1U); ++quarter) {
                for (std::uint32_t turn = 0; turn < 4; ++turn) {
                    const Square square{face, coarse_ ? std::optional(quarter) : std::nullopt, turn};
                    std::size_t k = 0;
                    while (k < 4 && glm::distance(at(square, places[k]).position, corners[k]) <= tolerance) ++k;
                    if (k == 4) return square;
                }
            }
        }
        return std::nullopt;
    }

private:
    const Cage& cage_;
    CatmullClarkReference reference_;
    bool coarse_;
};

glm::dvec3 positionOf(const MeshVertex& vertex) { return {vertex.position[0], vertex.position[1], vertex.position[2]}; }
glm::dvec2 parametersOf(const MeshVertex& vertex) { return {vertex.u, vertex.v}; }

std::vector<std::vector<const MeshVertex*>> byPatch(const KeptMesh& mesh) {
    std::vector<std::vector<const MeshVertex*>> patches;
    for (const MeshVertex& vertex : mesh.vertices) {
        if (vertex.patch >= patches.size()) patches.resize(vertex.patch + 1U);
        patches[vertex.patch].push_back(&vertex);
    }
    return patches;
}

std::optional<Square> squareOf(const TableLimit& limit, const std::vector<const MeshVertex*>& vertices, double tolerance) {
    constexpr std::array<glm::dvec2, 4> places{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    std::array<glm::dvec3, 4> corners{};
    for (std::size_t k = 0; k < 4; ++k) {
        const auto at = std::find_if(vertices.begin(), vertices.end(), [&](const MeshVertex* v) { return parametersOf(*v) == places[k]; });
        if (at == vertices.end()) return std::nullopt;
        corners[k] = positionOf(**at);
    }
    return limit.find(corners, tolerance);
}

struct Worst {
    double distance = 0.0;  // of the size
    double degrees = 0.0;
    double cornerDegrees = 0.0;
    std::size_t points = 0;
};

Worst compare(const TableLimit& limit, double size, const KeptMesh& mesh, const std::string& where) {
    Worst worst;
    std::mt19937 random(8);
    const auto patches = byPatch(mesh);
    for (std::size_t k = 0; k < 8; ++k) {
        const std::vector<const MeshVertex*>& vertices = patches[random() % patches.size()];
        const std::optional<Square> square = squareOf(limit, vertices, kMostDistance * size);
        EXPECT_TRUE(square.has_value()) << where << ": a patch with corners of no square";
        if (!square) return worst;
        for (int sample = 0; sample < 10; ++sample) {
            const MeshVertex& vertex = *vertices[random() % vertices.size()];
            const LimitPoint expected = limit.at(*square, parametersOf(vertex));
            worst.distance = std::max(worst.distance, glm::distance(positionOf(vertex), expected.position) / size);
            ++worst.points;
            const glm::dvec3 normal(vertex.normal[0], vertex.normal[1], vertex.normal[2]);
            if (!expected.hasNormal) continue;
            const glm::dvec2 at = parametersOf(vertex);
            const bool corner = (at.x == 0.0 || at.x == 1.0) && (at.y == 0.0 || at.y == 1.0);
            double& degrees = corner ? worst.cornerDegrees : worst.degrees;
            degrees = std::max(degrees, degreesBetween(normal, expected.normal));
        }
    }
    return worst;
}

Worst compareAt(TableTessellator& tessellator, const NamedCage& shape, const TableOptions& options) {
    const std::string where = shape.name + ", level " + std::to_string(options.level);
    const Worst worst =
        compare(TableLimit(shape.cage, options.level > 5), sizeOf(shape.cage), keep(tessellator.tessellate(options)), where);
    EXPECT_LT(worst.distance, kMostDistance) << where;
    EXPECT_LT(worst.degrees, kMostDegrees) << where;
    EXPECT_LT(worst.cornerDegrees, kMostCornerDegrees) << where;
    return worst;
}

TEST(TablesLimit, VerticesLieOnTheLimitSurface) {
    TableTessellator tessellator(meshTestSettings());
    std::size_t number = 0, points = 0;
    for (const NamedCage& shape : allShapes()) {
        tessellator.setScene(sceneOf(shape));
        TableOptions options;
        for (const int level : {3, 1, 5, 6}) {
            // All at one level, some at others.
            if (level != 3 && number % (level == 6 ? 12U : 4U) != 0) continue;
            // Squares are quarters from level 6 on; those of other faces are quarters before.
            if (level == 6 && !allQuads(shape.cage)) continue;
            options.level = level;
            options.order = number % 5 == 4 ? TableOrder::unordered : TableOrder::global;
            points += compareAt(tessellator, shape, options).points;
        }
        ++number;
    }
    EXPECT_GT(points, 20000U);
}

// Every drawn edge is as many segments as its level says; on both sides they have the same ends, to the bit, or the mesh were open there.
TEST(TablesLimit, MeshesAreAsClosedAsTheirCages) {
    TableTessellator tessellator(meshTestSettings());
    for (const NamedCage& shape : allShapes()) {
        tessellator.setScene(sceneOf(shape));
        const Drawn drawn = drawnOf(shape.cage);
        const std::size_t halves = allQuads(shape.cage) ? 1U : 2U;
        for (const int level : {1, 2, 4}) {
            TableOptions options;
            options.level = level;
            options.positionsOnly = level == 4;
            const Closedness is = closedness(keep(tessellator.tessellate(options), options.positionsOnly));
            const std::string where = shape.name + ", level " + std::to_string(level) + ": " + is.text();
            EXPECT_EQ(is.openEdges, (drawn.boundaryEdges * halves) << level) << where;
            EXPECT_EQ(is.crossedEdges + is.crowdedEdges + is.degenerate + is.pinched, 0U) << where;
            EXPECT_EQ(is.euler(), drawn.euler) << where;
        }
    }
}

// Neighbours of different levels meet as well.
TEST(TablesLimit, AdaptiveMeshesAreAsClosedAsTheirCages) {
    TableTessellator tessellator(meshTestSettings());
    std::size_t mixed = 0;
    for (const NamedCage& shape : everyShape(2)) {
        tessellator.setScene(sceneOf(shape));
        const Drawn drawn = drawnOf(shape.cage);
        for (const double share : {0.02, 0.005, 0.001}) {
            TableOptions options;
            options.tolerance = share * sizeOf(shape.cage);
            const KeptMesh mesh = keep(tessellator.tessellate(options));
            const Closedness is = closedness(mesh);
            const std::string where = shape.name + ", tolerance " + std::to_string(share) + ": " + is.text();
            EXPECT_EQ(is.openEdges == 0, drawn.closed()) << where;
            EXPECT_EQ(is.crossedEdges + is.crowdedEdges + is.degenerate + is.pinched, 0U) << where;
            EXPECT_EQ(is.euler(), drawn.euler) << where;
            std::map<std::size_t, int> sizes;
            for (const auto& patch : byPatch(mesh)) ++sizes[patch.size()];
            mixed += sizes.size() > 1 ? 1U : 0U;
        }
    }
    EXPECT_GT(mixed, 20U);
}

}  // namespace
}  // namespace tessera::test
