// Assimp's lights and cameras made Tessera's.
#include "formats/mesh_lights.h"

#include "scene/text.h"

#include <assimp/commonMetaData.h>
#include <assimp/version.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace tessera {

namespace {

glm::dvec3 vector(const aiVector3D& v) { return {v.x, v.y, v.z}; }
std::string_view text(const aiString& name) { return {name.data, name.length}; }

// Where scenes may have things; written so that NaN fails.
bool isPosition(const glm::dvec3& p) { return std::abs(p.x) <= 1e9 && std::abs(p.y) <= 1e9 && std::abs(p.z) <= 1e9; }

// At `position`, -z along `direction`, y as near to `up` as may be. Nothing where there is no direction, or no such place.
std::optional<Transform> facing(const glm::dvec3& position, const glm::dvec3& direction, const glm::dvec3& up) {
    const double length = glm::length(direction);
    if (!isPosition(position) || !std::isfinite(length) || length == 0.0) return std::nullopt;
    const glm::dvec3 back = -direction / length;
    const glm::dvec3 sideward = glm::cross(up, back);
    const double sine = glm::length(sideward);
    Transform transform;
    if (std::isfinite(sine) && sine > 1e-6 * glm::length(up)) {
        const glm::dvec3 right = sideward / sine;
        transform.rotation = glm::quat(glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back)));
    } else {
        transform.rotation = lookAt(glm::vec3(back), glm::vec3(0.0F), 45.0F).transform.rotation;
    }
    transform.translation = glm::vec3(position);
    return transform;
}

// What kind of light Tessera has for it.
std::optional<LightKind> kindOf(aiLightSourceType type) {
    if (type == aiLightSource_POINT || type == aiLightSource_SPOT) return LightKind::point;
    if (type == aiLightSource_DIRECTIONAL) return LightKind::directional;
    return std::nullopt;
}

std::optional<Light> makeLight(const aiLight& source, const glm::dmat4& place) {
    const std::optional<LightKind> kind = kindOf(source.mType);
    if (!kind.has_value()) return std::nullopt;
    Light light;
    light.kind = *kind;
    light.transform.translation = glm::vec3(place * glm::dvec4(vector(source.mPosition), 1.0));
    if (!isPosition(glm::dvec3(light.transform.translation))) return std::nullopt;
    if (light.kind == LightKind::directional) {
        const glm::dmat3 turn(place);
        const std::optional<Transform> transform =
            facing(glm::dvec3(light.transform.translation), turn * vector(source.mDirection), turn * vector(source.mUp));
        if (!transform.has_value()) return std::nullopt;
        light.transform = *transform;
    }
    // Assimp's colours have the light's strength in them.
    const glm::vec3 color(source.mColorDiffuse.r, source.mColorDiffuse.g, source.mColorDiffuse.b);
    const float strength = std::max({color.x, color.y, color.z});
    if (!std::isfinite(color.x) || !std::isfinite(color.y) || !std::isfinite(color.z)) return std::nullopt;
    light.intensity = strength > 0.0F ? strength : 1.0F;
    light.color = color / light.intensity;
    return light;
}

// "glTF Importer", "glTF2 Importer": by its first letters.
bool isGltf(const aiScene& source) {
    aiString format;
    return source.mMetaData != nullptr && source.mMetaData->Get(AI_METADATA_SOURCE_FORMAT, format) && text(format).starts_with("glTF");
}

// Degrees. Assimp's documentation calls what it has half the angle; its readers give the whole.
double verticalAngle(const aiCamera& source, bool gltf) {
    const double aspect = source.mAspect > 0.0F ? static_cast<double>(source.mAspect) : 1.0;
    const auto horizontal = static_cast<double>(source.mHorizontalFOV);
    // Before 5.3, angles of glTF files were made horizontal by multiplication, as if they were lengths.
    const bool multiplied = gltf && (aiGetVersionMajor() < 5 || (aiGetVersionMajor() == 5 && aiGetVersionMinor() < 3));
    return glm::degrees(multiplied ? horizontal / aspect : 2.0 * std::atan(std::tan(horizontal * 0.5) / aspect));
}

std::optional<Camera> makeCamera(const aiCamera& source, const glm::dmat4& place, bool gltf) {
    if (source.mOrthographicWidth > 0.0F) return std::nullopt;
    const glm::dmat3 turn(place);
    // Cameras of glTF stand in their node and look along -z; Assimp gives them their node's place a second time.
    const glm::dvec3 position = gltf ? glm::dvec3(0.0) : vector(source.mPosition);
    const glm::dvec3 direction = gltf ? glm::dvec3(0.0, 0.0, -1.0) : vector(source.mLookAt);
    const std::optional<Transform> transform =
        facing(glm::dvec3(place * glm::dvec4(position, 1.0)), turn * direction, turn * vector(source.mUp));
    if (!transform.has_value()) return std::nullopt;
    Camera camera;
    camera.transform = *transform;
    camera.fovy = static_cast<float>(verticalAngle(source, gltf));
    if (!(camera.fovy > 0.0F && camera.fovy < 180.0F)) return std::nullopt;
    if (source.mClipPlaneNear > 0.0F && std::isfinite(source.mClipPlaneNear)) camera.near = source.mClipPlaneNear;
    if (source.mClipPlaneFar > camera.near && std::isfinite(source.mClipPlaneFar)) camera.far = source.mClipPlaneFar;
    return camera;
}

}  // namespace

void addMeshLights(const aiScene& source, const NodePlace& place, const MeshNotes& notes, Scene& scene) {
    UniqueNames names("light");
    for (unsigned i = 0; i < source.mNumLights; ++i) {
        const aiLight& one = *source.mLights[i];
        const std::string item = "light " + quotedName(text(one.mName));
        std::optional<Light> light = makeLight(one, place(one.mName));
        if (!light.has_value()) {
            notes.warn(item + " is left out: only point, spot and directional lights with finite values are read");
            continue;
        }
        if (one.mType == aiLightSource_SPOT) notes.warn(item + " is a spot: it shines all around here");
        light->name = names.make(text(one.mName));
        scene.lights.push_back(std::move(*light));
    }
}

void addMeshCameras(const aiScene& source, const NodePlace& place, const MeshNotes& notes, Scene& scene) {
    UniqueNames names("camera");
    for (unsigned i = 0; i < source.mNumCameras; ++i) {
        const aiCamera& one = *source.mCameras[i];
        std::optional<Camera> camera = makeCamera(one, place(one.mName), isGltf(source));
        if (!camera.has_value()) {
            notes.warn("camera " + quotedName(text(one.mName)) + " is left out: only perspective ones with finite values are read");
            continue;
        }
        camera->name = names.make(text(one.mName));
        scene.cameras.push_back(std::move(*camera));
    }
}

}  // namespace tessera
