// Generated scenes of loose things: the plane of the eye-split, random patches, spheres.
#include <array>
#include <cmath>
#include <cstddef>

#include "scene/builtin_scenes.h"
#include "scene/generate_families.h"
#include "scene/generate_numbers.h"
#include "tessera/surfaces.h"

namespace tessera {

namespace {

// One mesh a colour, since colours are objects'.
constexpr std::array<glm::vec3, 8> kColors{{{0.7F, 0.12F, 0.08F},
                                            {0.82F, 0.42F, 0.08F},
                                            {0.8F, 0.68F, 0.2F},
                                            {0.25F, 0.5F, 0.14F},
                                            {0.08F, 0.42F, 0.42F},
                                            {0.1F, 0.22F, 0.6F},
                                            {0.42F, 0.16F, 0.5F},
                                            {0.75F, 0.72F, 0.66F}}};
constexpr Material kGlossy{MaterialKind::plastic, 0.35F, 0.12F};

// A sheet of 4 x 4 points in a random pose, each moved by chance as far as its neighbours are away.
void appendRandomPatch(std::vector<glm::vec3>& points, Random& random, double size) {
    const glm::dvec3 centre = random.within(1.0);
    const glm::dvec3 u = random.direction();
    const glm::dvec3 other = random.direction();
    // Two directions may agree so well that nothing is left of their difference.
    glm::dvec3 v = other - u * glm::dot(u, other);
    const double length = glm::length(v);
    v = length > 1e-3 ? v / length : glm::dvec3(u.y, u.z, u.x);
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            points.emplace_back(centre + size * ((i / 3.0 - 0.5) * u + (j / 3.0 - 0.5) * v + 0.5 * random.within(0.5)));
        }
    }
}

// Cells of a cube of side 2 that holds `count` of them.
std::uint64_t cellsAlong(std::uint64_t count) {
    std::uint64_t cells = 1;
    while (cells * cells * cells < count) ++cells;
    return cells;
}

}  // namespace

Scene generateEyesplit(const Making& /*making*/) {
    // Turned against the view and off the middle, so that cuts in the parameters' middles do not fall in with the eye plane.
    const glm::dvec2 along = onCircle(0.07) * 12.0;
    const glm::dvec2 across(along.y, -along.x);
    const glm::dvec2 corner = -0.5 * along - 0.5 * across + glm::dvec2(0.31, -0.17);
    std::vector<glm::vec3> points;
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            const glm::dvec2 place = corner + i / 3.0 * along + j / 3.0 * across;
            points.emplace_back(place.x, 0.0, place.y);
        }
    }
    Scene scene;
    scene.meshes.push_back(bezierMesh("plane", std::move(points)));
    addObject(scene, "plane", "plane", glm::dvec3(0.0), kColors[4], kGlossy);
    addNamedCamera(scene, "camera", {0.0F, 0.11F, 0.0F}, {0.0F, -0.14F, -1.0F}, 30.0F);
    scene.cameras.back().near = 0.001F;
    addDaylight(scene);
    return scene;
}

Scene generateRandomPatches(const Making& making) {
    Scene scene;
    Random random(making.seed);
    std::array<std::vector<glm::vec3>, kColors.size()> points;
    for (std::vector<glm::vec3>& each : points) each.reserve(16 * (making.count / points.size() + 1));
    // Patches get smaller with their number, but slower than the room that each has.
    const double size = 1.1 / std::sqrt(std::sqrt(static_cast<double>(making.count)));
    for (std::uint64_t i = 0; i < making.count; ++i) {
        appendRandomPatch(points[i % points.size()], random, size);
        making.tell(i, making.count);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].empty()) continue;
        const std::string name = "patches " + std::to_string(i + 1);
        scene.meshes.push_back(bezierMesh(name, std::move(points[i])));
        addObject(scene, name, name, glm::dvec3(0.0), kColors[i], kGlossy);
    }
    addNamedCamera(scene, "camera", {1.6F, 1.9F, 4.6F}, {0.0F, -0.05F, 0.0F}, 29.0F);
    addStudioLights(scene);
    return scene;
}

Scene generateSpheres(const Making& making) {
    Scene scene;
    Random random(making.seed);
    const std::uint64_t cells = cellsAlong(making.count);
    const double cell = 2.0 / static_cast<double>(cells);
    // Several sizes, all well within a cell, so that no two spheres touch.
    constexpr std::array<double, 4> sizes{0.42, 0.36, 0.3, 0.24};
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        const double radius = sizes[i] * cell;
        scene.meshes.push_back(sphere("sphere " + std::to_string(i + 1), radius, -radius, radius));
    }
    scene.objects.reserve(making.count);
    for (std::uint64_t i = 0; i < making.count; ++i) {
        const std::size_t size = random.below(sizes.size());
        const double room = (0.5 - sizes[size]) * cell;
        const std::uint64_t row = i / cells;
        const std::uint64_t layer = row / cells;
        const glm::dvec3 corner(static_cast<double>(i % cells), static_cast<double>(layer), static_cast<double>(row % cells));
        const glm::dvec3 off = random.within(room);
        addObject(scene, scene.meshes[size].name, "sphere " + std::to_string(i + 1), cell * (corner + 0.5) - 1.0 + off,
                  kColors[random.below(kColors.size())], kGlossy);
        making.tell(i, making.count);
    }
    addNamedCamera(scene, "camera", {1.9F, 1.7F, 4.4F}, {0.0F, -0.05F, 0.0F}, 29.0F);
    addStudioLights(scene);
    return scene;
}

}  // namespace tessera
