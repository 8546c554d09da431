// The built-in scene of PN triangles: a trefoil knot and a gem from a handful of triangles, and what they are without curving.
#include "scene/builtin_scenes.h"
#include "tessera/triangles.h"

#include <glm/gtc/constants.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace tessera {

namespace {

// A tube along a trefoil knot, around the z axis, some 3 in radius.
TriangleMesh knot(std::string name, std::uint32_t segments, std::uint32_t sides, double radius) {
    const auto centre = [](double t) {
        return glm::dvec3(std::sin(t) + 2.0 * std::sin(2.0 * t), std::cos(t) - 2.0 * std::cos(2.0 * t), -std::sin(3.0 * t));
    };
    TriangleMesh mesh;
    mesh.name = std::move(name);
    for (std::uint32_t i = 0; i < segments; ++i) {
        const double t = glm::two_pi<double>() * i / segments;
        const glm::dvec3 along = glm::normalize(centre(t + 1e-4) - centre(t - 1e-4));
        // A frame turned to the axis closes after a round, as one carried along the curve would not.
        const glm::dvec3 outward = glm::normalize(glm::cross(glm::cross(along, glm::dvec3(0.0, 0.0, 1.0)), along));
        const glm::dvec3 sideward = glm::cross(along, outward);
        for (std::uint32_t j = 0; j < sides; ++j) {
            const double angle = glm::two_pi<double>() * j / sides;
            mesh.positions.emplace_back(centre(t) + radius * (std::cos(angle) * outward + std::sin(angle) * sideward));
        }
    }
    for (std::uint32_t i = 0; i < segments; ++i) {
        for (std::uint32_t j = 0; j < sides; ++j) {
            const std::uint32_t here = i * sides, next = (i + 1) % segments * sides, right = (j + 1) % sides;
            mesh.triangles.push_back({here + j, next + right, next + j});
            mesh.triangles.push_back({here + j, here + right, next + right});
        }
    }
    return mesh;
}

// An icosahedron around the origin, drawn out along y.
TriangleMesh gem(std::string name) {
    constexpr std::uint32_t kRing = 5;
    TriangleMesh mesh;
    mesh.name = std::move(name);
    mesh.positions.emplace_back(0.0F, 1.35F, 0.0F);
    for (std::uint32_t i = 0; i < 2 * kRing; ++i) {
        const double angle = glm::pi<double>() * i / kRing;  // upper and lower ring in turn
        mesh.positions.emplace_back(0.9 * std::cos(angle), i % 2 == 0 ? 0.45 : -0.45, -0.9 * std::sin(angle));
    }
    mesh.positions.emplace_back(0.0F, -1.35F, 0.0F);
    const auto ring = [](std::uint32_t i) { return 1 + i % (2 * kRing); };
    for (std::uint32_t i = 0; i < 2 * kRing; i += 2) {
        mesh.triangles.push_back({0, ring(i), ring(i + 2)});
        mesh.triangles.push_back({ring(i), ring(i + 1), ring(i + 2)});
        mesh.triangles.push_back({ring(i + 2), ring(i + 1), ring(i + 3)});
        mesh.triangles.push_back({2 * kRing + 1, ring(i + 3), ring(i + 1)});
    }
    return mesh;
}

void place(Scene& scene, Mesh mesh, const Transform& transform, const glm::vec3& color, const Material& material) {
    Object object;
    object.name = mesh.name;
    object.mesh = mesh.name;
    object.transform = transform;
    object.color = color;
    object.material = material;
    scene.objects.push_back(std::move(object));
    scene.meshes.push_back(std::move(mesh));
}

}  // namespace

Scene pnScene() {
    Scene scene;
    scene.name = "pn";
    const glm::quat unturned(1.0F, 0.0F, 0.0F, 0.0F);
    place(scene, pnMesh(knot("knot", 36, 6, 0.62), false), {{0.0F, 0.35F, -0.6F}, unturned}, {0.05F, 0.26F, 0.4F},
          {MaterialKind::plastic, 0.5F, 0.1F});
    const glm::quat turned = glm::angleAxis(0.35F, glm::vec3(0.0F, 1.0F, 0.0F));
    place(scene, pnMesh(gem("gem"), false), {{-2.9F, -2.4F, 1.6F}, turned}, {0.6F, 0.07F, 0.12F}, {MaterialKind::plastic, 0.6F, 0.08F});
    place(scene, pnMesh(gem("cut gem"), true), {{2.9F, -2.4F, 1.6F}, turned}, {0.1F, 0.38F, 0.12F}, {MaterialKind::plastic, 0.6F, 0.08F});
    addStudioLights(scene);
    addCamera(scene, {1.6F, 1.8F, 15.0F}, {0.0F, -0.35F, 0.0F}, 31.0F);
    return scene;
}

}  // namespace tessera
