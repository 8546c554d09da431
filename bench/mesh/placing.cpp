// Objects, cameras and lamps of the mesh benchmark's scenes.
#include "mesh/placing.h"

#include <utility>

namespace tessera::bench {

glm::quat upright() { return {0.70710678F, -0.70710678F, 0.0F, 0.0F}; }

std::string addMesh(Scene& scene, Mesh mesh) {
    std::string name = mesh.name;
    if (scene.findMesh(name) == nullptr) scene.meshes.push_back(std::move(mesh));
    return name;
}

void place(Scene& scene, const std::string& mesh, const glm::vec3& at, const glm::quat& turned, const glm::vec3& color) {
    Object object;
    object.name = mesh + " " + std::to_string(scene.objects.size() + 1);
    object.mesh = mesh;
    object.transform.translation = at;
    object.transform.rotation = turned;
    object.color = color;
    object.material = {MaterialKind::plastic, 0.35F, 0.12F};
    scene.objects.push_back(std::move(object));
}

void addView(Scene& scene, const std::string& name, const glm::vec3& eye, const glm::vec3& target, float fovyDegrees) {
    Camera camera = lookAt(eye, target, fovyDegrees);
    camera.name = name;
    scene.cameras.push_back(std::move(camera));
}

void addLamps(Scene& scene) {
    Light lamp;
    lamp.name = "lamp";
    lamp.transform.rotation = lookAt({-0.6F, 0.8F, 0.7F}, glm::vec3(0.0F), 45.0F).transform.rotation;
    scene.lights.push_back(lamp);
    Light sky;
    sky.name = "sky";
    sky.kind = LightKind::hemi;
    sky.intensity = 0.3F;
    sky.transform.rotation = upright();
    scene.lights.push_back(sky);
}

}  // namespace tessera::bench
