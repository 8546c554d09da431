// Scenes that tests of pictures share.
#include "picture_scenes.h"

#include <utility>

namespace tessera::test {

namespace {

Object plastic(Object object) {
    object.material = {MaterialKind::plastic, 0.4F, 0.15F};
    return object;
}

// A light at infinity in the direction `from` from the origin.
Light sun(const glm::vec3& from, const glm::vec3& color) {
    Light light;
    light.name = "sun";
    light.transform.rotation = lookAt(from, glm::vec3(0.0F), 45.0F).transform.rotation;
    light.color = color;
    return light;
}

}  // namespace

Mesh bilinearPatch(const Corners& corners) {
    Mesh mesh;
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            const double u = i / 3.0;
            const double v = j / 3.0;
            mesh.points.emplace_back((1 - v) * ((1 - u) * corners[0] + u * corners[1]) + v * ((1 - u) * corners[3] + u * corners[2]));
        }
    }
    return mesh;
}

Object& addObject(Scene& scene, Mesh mesh, const glm::vec3& color) {
    mesh.name = "mesh" + std::to_string(scene.meshes.size());
    Object object;
    object.name = "object" + std::to_string(scene.objects.size());
    object.mesh = mesh.name;
    object.color = color;
    scene.meshes.push_back(std::move(mesh));
    scene.objects.push_back(std::move(object));
    return scene.objects.back();
}

Camera Screen::camera() const {
    Camera camera;
    camera.name = "screen";
    camera.near = 0.125F;
    camera.fovy = 90.0F;
    return camera;
}

glm::dvec3 Screen::at(double x, double y, double depth) const {
    const double scale = depth / this->depth();
    return {(x - 0.5 * width_) * scale, (0.5 * height_ - y) * scale, -depth};
}

Mesh closedMesh(double radius) {
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            for (int j = 0; j < 4; ++j) {
                for (int i = 0; i < 4; ++i) {
                    // Thirds of integers, so that both patches of an edge begin with the same bits.
                    glm::dvec3 point;
                    point[axis] = 3 * side;
                    point[(axis + 1) % 3] = 2 * (side > 0 ? i : j) - 3;
                    point[(axis + 2) % 3] = 2 * (side > 0 ? j : i) - 3;
                    mesh.points.emplace_back(radius * glm::normalize(point));
                }
            }
        }
    }
    return mesh;
}

Scene mixedScene() {
    using namespace reference;
    Scene scene = sceneOf({bumpyBezierMesh(5, 3), parted(asGregory(bumpyBezierMesh(6, 3)), 0.2, 7), bumpyBezierMesh(11, 1)});
    scene.objects.push_back(plastic(scene.objects[0]));
    scene.objects.push_back(plastic(scene.objects[1]));
    scene.objects[1].transform.rotation = glm::quat(0.5F, 1.0F, -0.3F, 0.2F);
    scene.objects[2].transform.translation = {-1.0F, 0.4F, 0.2F};
    scene.objects[3].transform.rotation = glm::quat(1.0F, 0.1F, 0.8F, -0.4F);
    scene.objects[3].transform.translation = {1.5F, -0.5F, 0.3F};
    scene.objects[4].transform.rotation = glm::quat(0.2F, 0.3F, 0.9F, 0.1F);
    scene.objects[4].transform.translation = {-0.8F, -0.6F, -0.5F};
    const std::array<glm::vec3, 5> colors{
        {{0.8F, 0.3F, 0.2F}, {0.2F, 0.6F, 0.3F}, {0.25F, 0.35F, 0.8F}, {0.75F, 0.7F, 0.2F}, {0.6F, 0.3F, 0.7F}}};
    for (std::size_t k = 0; k < colors.size(); ++k) scene.objects[k].color = colors[k];
    scene.lights.push_back(sun({1.0F, 2.0F, 3.0F}, {1.0F, 0.95F, 0.9F}));
    Light sky;
    sky.name = "sky";
    sky.kind = LightKind::hemi;
    sky.intensity = 0.3F;
    sky.transform.rotation = lookAt({0.0F, 1.0F, 0.0F}, glm::vec3(0.0F), 45.0F).transform.rotation;
    scene.lights.push_back(sky);
    scene.cameras.push_back(cameraAt({1, 1, 7}, {0.2, 0, 0}, 32));
    return scene;
}

Scene coincidentScene() {
    using namespace reference;
    Scene scene;
    const Mesh mesh = bumpyBezierMesh(21, 2);
    addObject(scene, mesh, {1.0F, 0.0F, 0.0F});
    Object twin = scene.objects.front();
    twin.name = "twin";
    twin.color = {0.0F, 1.0F, 0.0F};
    scene.objects.push_back(twin);
    addObject(scene, bumpyBezierMesh(22, 1), {0.0F, 0.0F, 1.0F});
    scene.cameras.push_back(cameraAt({0.5, 1, 5}, {0, 0, 0}, 35));
    return scene;
}

}  // namespace tessera::test
