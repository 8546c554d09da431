// The built-in scenes of subdivision surfaces: cubes and prisms of every sharpness, and a figure grown from a box.
#include "scene/builtin_scenes.h"
#include "scene/figure.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tessera {

namespace {

// Side 2 around the origin.
Cage cube() {
    Cage cage;
    for (int i = 0; i < 8; ++i) {
        cage.points.emplace_back((i & 1) != 0 ? 1.0F : -1.0F, (i & 2) != 0 ? 1.0F : -1.0F, (i & 4) != 0 ? 1.0F : -1.0F);
    }
    cage.faceSizes.assign(6, 4);
    cage.faceVertices = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    return cage;
}

// Two polygons of `sides` corners, one above the other, and what is between.
Cage prism(std::uint32_t sides) {
    Cage cage;
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = glm::two_pi<double>() * (i + 0.5) / sides;
        for (const double y : {-1.0, 1.0}) cage.points.emplace_back(1.15 * std::cos(angle), y, -1.15 * std::sin(angle));
    }
    cage.faceSizes = {sides, sides};
    for (std::uint32_t i = 0; i < sides; ++i) cage.faceVertices.push_back(2 * i + 1);
    for (std::uint32_t i = sides; i-- > 0;) cage.faceVertices.push_back(2 * i);
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t next = (i + 1) % sides;
        cage.faceSizes.push_back(4);
        cage.faceVertices.insert(cage.faceVertices.end(), {2 * i, 2 * next, 2 * next + 1, 2 * i + 1});
    }
    return cage;
}

// Creases every edge alike.
void crease(Cage& cage, float sharpness) {
    if (sharpness == 0.0F) return;
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::size_t first = 0;
    for (const std::uint32_t size : cage.faceSizes) {
        for (std::uint32_t k = 0; k < size; ++k) {
            edges.insert(std::minmax(cage.faceVertices[first + k], cage.faceVertices[first + (k + 1) % size]));
        }
        first += size;
    }
    for (const auto& [a, b] : edges) cage.creases.push_back({a, b, sharpness});
}

void place(Scene& scene, Cage cage, const Transform& transform, const glm::vec3& color) {
    Object object;
    object.name = cage.name;
    object.mesh = cage.name;
    object.transform = transform;
    object.color = color;
    object.material = {MaterialKind::plastic, 0.4F, 0.12F};
    scene.objects.push_back(std::move(object));
    scene.cages.push_back(std::move(cage));
}

}  // namespace

Scene cubeCreasesScene() {
    constexpr std::array<std::pair<float, const char*>, 5> kSharpnesses{
        {{0.0F, "0"}, {1.0F, "1"}, {2.0F, "2"}, {3.5F, "3.5"}, {10.0F, "10"}}};
    Scene scene;
    scene.name = "cube_creases";
    const glm::quat turned = glm::angleAxis(0.6F, glm::vec3(0.0F, 1.0F, 0.0F));
    float x = -5.2F;
    for (const auto& [sharpness, text] : kSharpnesses) {
        Cage box = cube(), drum = prism(6);
        box.name = std::string("cube ") + text;
        drum.name = std::string("prism ") + text;
        crease(box, sharpness);
        crease(drum, sharpness);
        place(scene, std::move(box), {{x, 1.4F, 0.0F}, turned}, {0.62F, 0.085F, 0.035F});
        place(scene, std::move(drum), {{x, -1.4F, 0.0F}, turned}, {0.05F, 0.26F, 0.4F});
        x += 2.6F;
    }
    addStudioLights(scene);
    addCamera(scene, {0.0F, 3.5F, 17.0F}, {0.0F, -0.1F, 0.0F}, 26.0F);
    return scene;
}

Scene characterScene() {
    Scene scene;
    scene.name = "character";
    Cage cage = figureCage();
    cage.name = "character";
    place(scene, std::move(cage), {}, {0.42F, 0.22F, 0.1F});
    addStudioLights(scene);
    addCamera(scene, {5.0F, 5.2F, 14.0F}, {0.0F, 3.4F, 0.0F}, 36.0F);
    return scene;
}

}  // namespace tessera
