// The scenes that need no file: their names, the teapot's, and what all of them are made with.
#include "scene/builtin_scenes.h"
#include "scene/teapot.h"
#include "scene/text.h"
#include "tessera/error.h"
#include "tessera/scene.h"

#include <algorithm>
#include <utility>

namespace tessera {

namespace {

Scene teapotScene() {
    Scene scene;
    scene.name = "teapot";
    scene.meshes.push_back(teapotMesh());

    Object teapot;
    teapot.name = "teapot";
    teapot.mesh = scene.meshes.front().name;
    teapot.transform.rotation = uprightRotation();
    teapot.color = {0.62F, 0.085F, 0.035F};
    teapot.material = {MaterialKind::plastic, 0.45F, 0.12F};
    scene.objects.push_back(std::move(teapot));

    addStudioLights(scene);
    addCamera(scene, {3.4F, 4.2F, 9.0F}, {0.4F, 1.48F, 0.0F}, 26.0F);
    return scene;
}

}  // namespace

Light lightFrom(std::string lightName, LightKind kind, const glm::vec3& from, const glm::vec3& color, float intensity) {
    Light light;
    light.name = std::move(lightName);
    light.kind = kind;
    light.transform.rotation = lookAt(from, glm::vec3(0.0F), 45.0F).transform.rotation;
    light.color = color;
    light.intensity = intensity;
    return light;
}

void addStudioLights(Scene& scene) {
    scene.lights.push_back(lightFrom("key", LightKind::directional, {-0.6F, 0.65F, 0.8F}, {1.0F, 0.96F, 0.9F}, 0.95F));
    scene.lights.push_back(lightFrom("fill", LightKind::directional, {0.9F, 0.3F, 0.6F}, {0.75F, 0.85F, 1.0F}, 0.25F));
    scene.lights.push_back(lightFrom("sky", LightKind::hemi, {0.0F, 1.0F, 0.0F}, {0.85F, 0.92F, 1.0F}, 0.3F));
}

void addCamera(Scene& scene, const glm::vec3& eye, const glm::vec3& target, float fovyDegrees) {
    Camera camera = lookAt(eye, target, fovyDegrees);
    camera.name = "camera";
    scene.cameras.push_back(std::move(camera));
}

glm::quat uprightRotation() { return {0.70710678F, -0.70710678F, 0.0F, 0.0F}; }

const std::vector<std::string_view>& builtinSceneNames() {
    static const std::vector<std::string_view> names{"teapot", "sphere", "torus", "quadrics", "nurbs", "pn", "cube_creases", "character"};
    return names;
}

bool isBuiltinScene(std::string_view sceneName) {
    const std::vector<std::string_view>& names = builtinSceneNames();
    return std::find(names.begin(), names.end(), sceneName) != names.end();
}

Scene builtinScene(std::string_view sceneName) {
    if (sceneName == "teapot") return teapotScene();
    if (sceneName == "sphere") return sphereScene();
    if (sceneName == "torus") return torusScene();
    if (sceneName == "quadrics") return quadricsScene();
    if (sceneName == "nurbs") return nurbsScene();
    if (sceneName == "pn") return pnScene();
    if (sceneName == "cube_creases") return cubeCreasesScene();
    if (sceneName == "character") return characterScene();
    std::string known;
    for (const std::string_view one : builtinSceneNames()) known += (known.empty() ? "" : ", ") + std::string(one);
    throw Error("no built-in scene " + quotedName(sceneName) + "; there is: " + known + ", or give the path of a file");
}

}  // namespace tessera
