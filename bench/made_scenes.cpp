// Heavy scenes that need no file. The random numbers are a generator of our own kind: the standard's distributions differ
// between libraries.
#include "made_scenes.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace tessera::bench {

namespace {

// Weyl sequence with a mixing step: 0 to 1, 24 bits.
class Random {
public:
    float next() {
        state_ += 0x9E3779B97F4A7C15U;
        const std::uint64_t mixed = (state_ ^ (state_ >> 29U)) * 0xD6E8FEB86659FD93U;
        return static_cast<float>(mixed >> 40U) / 16777216.0F;
    }
    float between(float least, float most) { return least + (most - least) * next(); }

private:
    std::uint64_t state_ = 1;
};

Light sky() {
    Light light;
    light.name = "sky";
    light.kind = LightKind::hemi;
    light.transform = lookAt({0.3F, 1.0F, 0.5F}, glm::vec3(0.0F), 45.0F).transform;
    return light;
}

// A ribbon's spine: `along` runs from 0 at the root to 1 at the tip, which bends over by `lean` and sinks.
glm::vec3 spine(const glm::vec3& root, const glm::vec3& lean, float length, float along) {
    return root + lean * (along * along * length) + glm::vec3(0.0F, length * (along - 0.9F * along * along), 0.0F);
}

void addRibbon(std::vector<glm::vec3>& points, Random& random) {
    constexpr int patches = 3;
    const float x = random.between(-1.0F, 1.0F);
    const float z = random.between(-1.0F, 1.0F);
    const glm::vec3 root(x, 0.4F * std::cos(1.2F * x) * std::cos(1.2F * z), z);
    const float angle = random.between(0.0F, 6.2831853F);
    const glm::vec3 lean(std::cos(angle), 0.0F, std::sin(angle));
    const glm::vec3 side(-lean.z, 0.0F, lean.x);
    const float length = random.between(0.15F, 0.5F);
    const float width = random.between(0.001F, 0.003F);
    for (int patch = 0; patch < patches; ++patch) {
        for (int v = 0; v < 4; ++v) {
            const float along = (static_cast<float>(patch) + static_cast<float>(v) / 3.0F) / patches;
            const glm::vec3 middle = spine(root, lean, length, along);
            const float half = width * (1.0F - 0.8F * along);
            for (int u = 0; u < 4; ++u) points.push_back(middle + side * (half * (static_cast<float>(u) / 1.5F - 1.0F)));
        }
    }
}

}  // namespace

Scene teapotGrid(int columns, int rows) {
    Scene scene = builtinScene("teapot");
    scene.name = "made_teapots";
    const Object teapot = scene.objects.front();
    scene.objects.clear();
    constexpr float spacing = 6.5F;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            Object placed = teapot;
            placed.name = "teapot " + std::to_string(row) + " " + std::to_string(column);
            const float x = spacing * (static_cast<float>(column) - 0.5F * static_cast<float>(columns - 1));
            const float z = spacing * (static_cast<float>(row) - 0.5F * static_cast<float>(rows - 1));
            placed.transform.translation += glm::vec3(x, 0.0F, z);
            scene.objects.push_back(std::move(placed));
        }
    }
    scene.cameras = {framingCamera(scene, 40.0F)};
    return scene;
}

Scene strands(int count) {
    Mesh mesh;
    mesh.name = "strands";
    Random random;
    for (int i = 0; i < count; ++i) addRibbon(mesh.points, random);
    Object object;
    object.name = "strands";
    object.mesh = mesh.name;
    object.color = {0.45F, 0.3F, 0.15F};
    Scene scene;
    scene.name = "made_strands";
    scene.meshes.push_back(std::move(mesh));
    scene.objects.push_back(std::move(object));
    scene.lights.push_back(sky());
    scene.cameras = {lookAt({0.0F, 1.9F, 2.4F}, {0.0F, 0.3F, 0.0F}, 40.0F)};
    return scene;
}

}  // namespace tessera::bench
