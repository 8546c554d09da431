// Scenes of one cage made meshes, and what to ask of the PN triangles that come out.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "cage_host.h"
#include "tessera/scene.h"
#include "tessera/subdivision.h"

namespace tessera::test {

inline Object placing(const std::string& objectName, const std::string& mesh) {
    Object object;
    object.name = objectName;
    object.mesh = mesh;
    return object;
}

inline SubdivisionOptions withTolerance(double tolerance) {
    SubdivisionOptions options;
    options.tolerance = tolerance;
    return options;
}

inline SubdivisionOptions withAngle(double angle) {
    SubdivisionOptions options;
    options.creaseAngle = angle;
    return options;
}

inline Scene sceneOf(Cage cage, SubdivisionScheme scheme) {
    cage.scheme = scheme;
    Scene scene;
    scene.name = "test";
    scene.objects.push_back(placing("object", cage.name));
    scene.cages.push_back(std::move(cage));
    return scene;
}

struct Made {
    Scene scene;
    CageReport report;

    [[nodiscard]] const Mesh& mesh() const { return scene.meshes.at(0); }
};

inline Made subdivided(const Cage& cage, SubdivisionScheme scheme, const SubdivisionOptions& options = {}) {
    Made made{sceneOf(cage, scheme), {}};
    made.report = subdivide(made.scene, options).at(0);
    made.scene.validate();
    return made;
}

inline Cage octahedron() {
    return cageOf({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                  {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

using Place = std::tuple<float, float, float>;
inline Place place(const glm::vec3& p) { return {p.x, p.y, p.z}; }

// The points of a pn patch's sides, each from its corner to the next, and the normals there: corner, middle, corner.
struct Side {
    std::array<Place, 4> points{};
    std::array<Place, 3> normals{};
};

inline std::array<Side, 3> sidesOf(const Mesh& mesh, std::size_t patch) {
    const glm::vec3* p = &mesh.points[patch * 16];
    const auto side = [&](std::array<int, 4> points, std::array<int, 3> normals) {
        Side made;
        for (std::size_t k = 0; k < 4; ++k) made.points[k] = place(p[points[k]]);
        for (std::size_t k = 0; k < 3; ++k) made.normals[k] = place(p[normals[k]]);
        return made;
    };
    return {side({0, 1, 2, 3}, {10, 11, 12}), side({3, 6, 8, 9}, {12, 14, 15}), side({9, 7, 4, 0}, {15, 13, 10})};
}

// How many sides have no partner that runs along the same curve the other way, to the bit; and of those that have one, how many have other
// normals.
inline std::pair<std::size_t, std::size_t> loneAndCreasedSides(const Mesh& mesh) {
    std::map<std::array<Place, 4>, std::array<Place, 3>> all;
    for (std::size_t patch = 0; patch < mesh.patchCount(); ++patch) {
        for (const Side& side : sidesOf(mesh, patch)) EXPECT_TRUE(all.emplace(side.points, side.normals).second);
    }
    std::size_t lone = 0, creased = 0;
    for (const auto& side : all) {
        std::array<Place, 4> points = side.first;
        std::array<Place, 3> normals = side.second;
        std::reverse(points.begin(), points.end());
        std::reverse(normals.begin(), normals.end());
        const auto partner = all.find(points);
        lone += partner == all.end() ? 1U : 0U;
        creased += partner != all.end() && partner->second != normals ? 1U : 0U;
    }
    return {lone, creased};
}

}  // namespace tessera::test
