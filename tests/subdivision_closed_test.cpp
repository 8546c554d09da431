// What the tessellator promises of subdivided cages: closed 2-manifolds with the cage's Euler number wherever the cage is closed, at any
// tolerance and camera, and elsewhere no edge open but along the cage's boundaries; the same vertices on both sides of every border.
#include "border_segments.h"
#include "closed_models.h"
#include "mesh_kept.h"
#include "quad_rig.h"
#include "sample_meshes.h"
#include "subdivision_shapes.h"
#include "tessera/subdivision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace tessera::test {
namespace {

constexpr std::array surfaces{SubdivisionSurface::exact, SubdivisionSurface::gregory};

Scene subdivided(const NamedCage& shape, SubdivisionSurface surface) {
    Scene scene = sceneOf(shape);
    SubdivisionOptions options;
    options.surface = surface;
    static_cast<void>(subdivide(scene, options));
    return scene;
}

std::string inWords(SubdivisionSurface surface) { return surface == SubdivisionSurface::exact ? ", exact" : ", gregory"; }

// Vertices in one place are one, of the mesh as of the cage: numbers agree even where holes touch.
void expectAsTheCage(const KeptMesh& mesh, const Drawn& drawn, const std::string& where) {
    const Closedness is = closedness(mesh);
    EXPECT_GT(is.triangles, 1U) << where;
    EXPECT_EQ(is.crossedEdges + is.crowdedEdges + is.degenerate, 0U) << where << ": " << is.text();
    EXPECT_EQ(is.euler(), drawn.euler) << where << ": " << is.text();
    if (drawn.closed()) {
        EXPECT_TRUE(is.closed()) << where << ": " << is.text();
    } else {
        EXPECT_GE(is.openEdges, drawn.boundaryEdges) << where << ": " << is.text();
    }
}

// How many connected lines the edges of a single triangle form.
std::size_t openLoops(const KeptMesh& mesh) {
    using Place = std::array<float, 3>;
    std::map<std::pair<Place, Place>, int> edges;
    const auto place = [&](std::size_t k) {
        const float* p = mesh.vertices[mesh.indices[k]].position;
        return Place{p[0] + 0.0F, p[1] + 0.0F, p[2] + 0.0F};
    };
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3)
        for (std::size_t c = 0; c < 3; ++c) ++edges[std::minmax(place(t + c), place(t + (c + 1) % 3))];
    std::map<Place, Place> parent;
    const auto root = [&](Place at) {
        while (parent[at] != at) at = parent[at];
        return at;
    };
    for (const auto& [edge, uses] : edges) {
        if (uses != 1) continue;
        parent.emplace(edge.first, edge.first);
        parent.emplace(edge.second, edge.second);
        parent[root(edge.first)] = root(edge.second);
    }
    return static_cast<std::size_t>(
        std::count_if(parent.begin(), parent.end(), [](const auto& item) { return item.first == item.second; }));
}

TEST(SubdivisionClosed, AnyToleranceGivesTheCagesTopology) {
    Tessellator tessellator(meshTestSettings());
    reference::Random random(7);
    for (const NamedCage& shape : everyShape(2)) {
        const Drawn drawn = drawnOf(shape.cage);
        for (const SubdivisionSurface surface : surfaces) {
            tessellator.setScene(subdivided(shape, surface));
            for (int k = 0; k < 3; ++k) {
                TessellateOptions options;
                options.tolerance = sizeOf(shape.cage) * std::exp(random.between(std::log(5e-4), std::log(0.1)));
                options.positionsOnly = true;
                expectAsTheCage(keep(tessellator.tessellate(options), true), drawn,
                                shape.name + inWords(surface) + ", tolerance " + std::to_string(options.tolerance));
            }
        }
    }
}

TEST(SubdivisionClosed, AnyCameraGivesTheCagesTopology) {
    constexpr std::array kinds{ViewKind::far,    ViewKind::near, ViewKind::grazing, ViewKind::throughNearPlane,
                               ViewKind::inside, ViewKind::aside};
    Tessellator tessellator(meshTestSettings());
    reference::Random random(9);
    std::uint64_t seed = 1000;
    for (const NamedCage& shape : everyShape(2, 1)) {
        const Drawn drawn = drawnOf(shape.cage);
        for (const SubdivisionSurface surface : surfaces) {
            const Scene scene = subdivided(shape, surface);
            tessellator.setScene(scene);
            for (int k = 0; k < 3; ++k, ++seed) {
                TessellateOptions options;
                options.width = 128;
                options.height = 96;
                options.camera = randomView(scene, kinds[seed % kinds.size()], seed);
                options.pixelError = std::exp(random.between(std::log(0.5), std::log(8.0)));
                options.cull = false;
                options.positionsOnly = true;
                expectAsTheCage(keep(tessellator.tessellate(options), true), drawn,
                                shape.name + inWords(surface) + ", camera " + std::to_string(seed));
            }
        }
    }
}

// A crack would be a loop of its own, or two boundaries that touch where the cage's do not.
TEST(SubdivisionClosed, OpenEdgesFormTheCagesBoundaries) {
    Tessellator tessellator(meshTestSettings());
    const std::map<std::string, std::size_t> loops{
        {"grid_5x4_corner", 1}, {"grid_5x4_edge", 1},  {"grid_5x4_none", 1}, {"grid_tagged_edge", 1}, {"concave_corner", 1},
        {"fan_7", 1},           {"strip_1x4_edge", 1}, {"triangle_edge", 1}, {"box_hole", 1},         {"prism_hole", 1}};
    std::size_t seen = 0;
    for (const NamedCage& shape : allShapes()) {
        const auto expected = loops.find(shape.name);
        if (expected == loops.end()) continue;
        ++seen;
        for (const SubdivisionSurface surface : surfaces) {
            tessellator.setScene(subdivided(shape, surface));
            for (const double share : {0.05, 0.01, 0.002}) {
                TessellateOptions options;
                options.tolerance = share * sizeOf(shape.cage);
                options.positionsOnly = true;
                const KeptMesh mesh = keep(tessellator.tessellate(options), true);
                EXPECT_EQ(openLoops(mesh), expected->second) << shape.name << inWords(surface) << ", tolerance " << share;
            }
        }
    }
    EXPECT_EQ(seen, loops.size());
}

// The renderer's own vertices, rates and cuts, as edge_bits_test.cpp has them of other surfaces.
TEST(SubdivisionClosed, DicedBordersHaveTheSameBits) {
    splitting::QuadRig rig(kernelSources());
    reference::Random random(6);
    std::size_t borders = 0;
    for (const NamedCage& shape : everyShape(7)) {
        if (!drawnOf(shape.cage).closed()) continue;
        for (const SubdivisionSurface surface : surfaces) {
            const Scene scene = subdivided(shape, surface);
            const Bounds box = worldBounds(scene);
            const glm::dvec3 middle = 0.5 * (glm::dvec3(box.lower) + glm::dvec3(box.upper));
            const double radius = 0.5 * glm::distance(glm::dvec3(box.lower), glm::dvec3(box.upper));
            for (int view = 0; view < 2; ++view) {
                const glm::dvec3 away = glm::normalize(random.inCube(1.0) + glm::dvec3(1e-3, 0.0, 0.0));
                RenderOptions options;
                options.mode = DiceMode::watertight;
                options.width = options.height = 128;
                options.pixelSamples = 1;
                options.gridSize = view == 0 ? 8 : 2;
                options.shadingRate = view == 0 ? 16.0F : 64.0F;
                rig.place(scene, reference::cameraAt(middle + 3.0 * radius * away, middle, 45), options);
                const auto found = findBounded(rig, 1000);
                const auto walked = rig.borders(found.diced);
                borders += walked.size();
                EXPECT_EQ(splitting::openSegments(walked), 0U) << shape.name << inWords(surface) << ", view " << view;
            }
        }
    }
    EXPECT_GT(borders, 10000U);
}

}  // namespace
}  // namespace tessera::test
