// Heavy scenes that need no file, beside those that the library makes (tessera/generate.h).
#include "made_scenes.h"

#include <string>
#include <utility>

namespace tessera::bench {

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

}  // namespace tessera::bench
