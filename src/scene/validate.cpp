// Scene::validate: what later stations may take for granted.
#include "scene/validate.h"

#include "scene/text.h"
#include "tessera/error.h"

#include <cmath>
#include <string>
#include <string_view>
#include <unordered_set>

namespace tessera {

namespace {

constexpr float kLargestCoordinate = 1e9F;

[[noreturn]] void fail(const std::string& where, const std::string& what) { throw Error(where + ": " + what); }

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Written so that NaN fails.
bool isCoordinate(float value) { return std::abs(value) <= kLargestCoordinate; }
bool isPosition(const glm::vec3& v) { return isCoordinate(v.x) && isCoordinate(v.y) && isCoordinate(v.z); }

std::string pointText(const glm::vec3& v) { return "(" + numberText(v.x) + ", " + numberText(v.y) + ", " + numberText(v.z) + ")"; }

constexpr std::string_view kPositionRule = " is not finite or beyond 1e9; scale or repair the scene";

void checkRotation(const Transform& transform, const std::string& where) {
    const double length = glm::length(glm::dquat(transform.rotation));
    if (!std::isfinite(length)) fail(where, "rotation is not finite; write (1, 0, 0, 0) for none");
    if (length == 0.0) fail(where, "rotation has zero length; write (1, 0, 0, 0) for none");
}

void checkTransform(const Transform& transform, const std::string& where) {
    if (!isPosition(transform.translation)) {
        fail(where, "translation " + pointText(transform.translation) + std::string(kPositionRule));
    }
    checkRotation(transform, where);
}

void checkColor(const glm::vec3& color, const std::string& where) {
    if (!isFinite(color)) fail(where, "colour " + pointText(color) + " is not finite; give three numbers, linear RGB");
}

void checkMesh(const Mesh& mesh, const std::string& where) {
    if (mesh.kind != PatchKind::bezier && mesh.kind != PatchKind::gregory) {
        fail(where, "patches are of no known kind; use bezier or gregory");
    }
    const std::size_t perPatch = pointsPerPatch(mesh.kind);
    if (mesh.points.size() % perPatch != 0) {
        fail(where, "has " + std::to_string(mesh.points.size()) + " points, which is no multiple of the " + std::to_string(perPatch) +
                        " of a " + std::string(name(mesh.kind)) + " patch; give whole patches");
    }
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        if (isPosition(mesh.points[i])) continue;
        fail(where + ", patch " + std::to_string(i / perPatch) + ", point " + std::to_string(i % perPatch),
             pointText(mesh.points[i]) + std::string(kPositionRule));
    }
}

void checkMaterial(const Material& material, const std::string& where) {
    if (material.kind != MaterialKind::matte && material.kind != MaterialKind::plastic) {
        fail(where, "material is of no known kind; use matte or plastic");
    }
    if (!(material.specular >= 0.0F && material.specular <= 1.0F)) {
        fail(where, "specular " + numberText(material.specular) + " is outside its range; give 0 to 1");
    }
    if (!(material.roughness > 0.0F && material.roughness <= 1.0F)) {
        fail(where, "roughness " + numberText(material.roughness) + " is outside its range; give more than 0, at most 1");
    }
}

void checkLight(const Light& light, const std::string& where) {
    checkTransform(light.transform, where);
    checkColor(light.color, where);
    if (!std::isfinite(light.intensity)) fail(where, "intensity is not finite; give a number");
    if (light.kind != LightKind::point && light.kind != LightKind::directional && light.kind != LightKind::hemi) {
        fail(where, "light is of no known kind; use point, directional or hemi");
    }
}

}  // namespace

void validateCamera(const Camera& camera, const std::string& where) {
    // The eye may stand beyond 1e9: that is where it sees all of a scene of that size.
    if (!isFinite(camera.transform.translation)) {
        fail(where, "translation " + pointText(camera.transform.translation) + " is not finite; give a place");
    }
    checkRotation(camera.transform, where);
    if (!(camera.near > 0.0F) || !std::isfinite(camera.near)) {
        fail(where, "near plane at " + numberText(camera.near) + "; give a distance above 0");
    }
    if (!std::isfinite(camera.far)) fail(where, "far plane at " + numberText(camera.far) + "; give a distance");
    if (!(camera.fovy > 0.0F && camera.fovy < 180.0F)) {
        fail(where, "field of view of " + numberText(camera.fovy) + " degrees; give more than 0, less than 180");
    }
}

void Scene::validate() const {
    const std::string prefix = (name.empty() ? std::string("scene") : name) + ": ";
    const auto where = [&](std::string_view kind, const std::string& item) { return prefix + std::string(kind) + " " + quotedName(item); };

    std::unordered_set<std::string_view> meshNames;
    for (const Mesh& mesh : meshes) {
        if (!meshNames.insert(mesh.name).second) fail(where("mesh", mesh.name), "the name is used twice; give each mesh its own");
        checkMesh(mesh, where("mesh", mesh.name));
    }
    for (const Object& object : objects) {
        const std::string item = where("object", object.name);
        if (!meshNames.contains(object.mesh))
            fail(item, "there is no mesh " + quotedName(object.mesh) + "; name one of the scene's meshes");
        checkTransform(object.transform, item);
        checkColor(object.color, item);
        checkMaterial(object.material, item);
    }
    for (const Light& light : lights) checkLight(light, where("light", light.name));
    for (const Camera& camera : cameras) validateCamera(camera, where("camera", camera.name));
}

}  // namespace tessera
