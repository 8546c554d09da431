// A surface of genus 2 of 1536 triangles: two tori side by side, a square cut out of each where they face each other, and a neck between.
#include "mesh/closed_meshes.h"
#include "mesh/mesh_scenes.h"
#include "mesh/placing.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tessera::bench {

namespace {

constexpr std::uint32_t kRings = 24;
constexpr std::uint32_t kSides = 16;
constexpr std::uint32_t kCut = 4;  // segments along the square that is cut out
constexpr double kMajor = 1.0;
constexpr double kMinor = 0.4;
constexpr double kCentre = 1.75;  // of the left torus, at -x; it reaches to 1.4 of that

bool isCut(std::uint32_t ring, std::uint32_t side) { return (ring + kCut / 2) % kRings < kCut && (side + kCut / 2) % kSides < kCut; }

// The left torus lies in the x-z plane; ring 0 and side 0 are where it comes nearest to x = 0.
glm::dvec3 torusPoint(std::uint32_t ring, std::uint32_t side) {
    const double along = glm::two_pi<double>() * ring / kRings;
    const double around = glm::two_pi<double>() * side / kSides;
    const double radius = kMajor + kMinor * std::cos(around);
    return {radius * std::cos(along) - kCentre, kMinor * std::sin(around), radius * std::sin(along)};
}

// The left torus without the triangles of its square.
TriangleMesh cutTorus() {
    TriangleMesh torus = ringTube("double torus", kRings, kSides, torusPoint);
    std::vector<std::array<std::uint32_t, 3>> kept;
    for (std::uint32_t quad = 0; quad < kRings * kSides; ++quad) {
        if (isCut(quad / kSides, quad % kSides)) continue;
        kept.push_back(torus.triangles[2 * std::size_t{quad}]);
        kept.push_back(torus.triangles[2 * std::size_t{quad} + 1]);
    }
    torus.triangles = std::move(kept);
    return torus;
}

// The square's border on the torus, once around.
std::vector<std::uint32_t> cutBorder() {
    std::vector<std::uint32_t> border;
    const auto add = [&border](std::uint32_t ring, std::uint32_t side) {
        border.push_back((ring + kRings - kCut / 2) % kRings * kSides + (side + kSides - kCut / 2) % kSides);
    };
    for (std::uint32_t i = 0; i < kCut; ++i) add(i, 0);
    for (std::uint32_t i = 0; i < kCut; ++i) add(kCut, i);
    for (std::uint32_t i = 0; i < kCut; ++i) add(kCut - i, kCut);
    for (std::uint32_t i = 0; i < kCut; ++i) add(0, kCut - i);
    return border;
}

// Adds a row of quads between two closed lines of points, `turned` the other way round.
void addRow(TriangleMesh& mesh, const std::vector<std::uint32_t>& from, const std::vector<std::uint32_t>& to, bool turned) {
    for (std::size_t i = 0; i < from.size(); ++i) {
        const std::size_t next = (i + 1) % from.size();
        std::array<std::uint32_t, 3> one{from[i], to[next], to[i]};
        std::array<std::uint32_t, 3> other{from[i], from[next], to[next]};
        if (turned) {
            std::swap(one[1], one[2]);
            std::swap(other[1], other[2]);
        }
        mesh.triangles.push_back(one);
        mesh.triangles.push_back(other);
    }
}

// Adds the mirror image in x = 0; its points follow the mesh's.
void addMirrored(TriangleMesh& mesh) {
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    const std::size_t triangles = mesh.triangles.size();
    for (std::uint32_t i = 0; i < count; ++i) mesh.positions.push_back(mesh.positions[i] * glm::vec3(-1.0F, 1.0F, 1.0F));
    for (std::size_t i = 0; i < triangles; ++i) {
        const auto [a, b, c] = mesh.triangles[i];
        mesh.triangles.push_back({a + count, c + count, b + count});
    }
}

TriangleMesh doubleTorusMesh() {
    TriangleMesh mesh = cutTorus();
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    addMirrored(mesh);
    const std::vector<std::uint32_t> left = cutBorder();
    std::vector<std::uint32_t> middle;
    std::vector<std::uint32_t> right;
    for (const std::uint32_t point : left) {
        middle.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        right.push_back(point + count);
        // A little narrower than the border, which is what a neck is.
        mesh.positions.push_back(mesh.positions[point] * glm::vec3(0.0F, 0.85F, 0.85F));
    }
    addRow(mesh, left, middle, true);
    addRow(mesh, middle, right, true);
    return mesh;
}

}  // namespace

Scene doubleTorus() {
    Scene scene;
    scene.name = "double_torus";
    place(scene, addMesh(scene, pnMesh(doubleTorusMesh(), false)), glm::vec3(0.0F), glm::quat(1.0F, 0.0F, 0.0F, 0.0F), {0.2F, 0.35F, 0.6F});
    addLamps(scene);
    addView(scene, "camera", {1.5F, 4.5F, 6.5F}, glm::vec3(0.0F), 38.0F);
    return scene;
}

}  // namespace tessera::bench
