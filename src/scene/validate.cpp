// Scene::validate: what later stations may take for granted.
#include "scene/validate.h"

#include "scene/text.h"
#include "tessera/error.h"

#include <cmath>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>

namespace tessera {

namespace {

constexpr float kLargestCoordinate = 1e9F;

[[noreturn]] void fail(const std::string& where, const std::string& what) { throw Error(where + ": " + what); }

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Written so that NaN fails.
bool isCoordinate(float value) { return std::abs(value) <= kLargestCoordinate; }
bool isPosition(const glm::vec3& v) { return isCoordinate(v.x) && isCoordinate(v.y) && isCoordinate(v.z); }

// Weights further from 1 leave too little of single precision.
bool isWeight(float value) { return value >= 1e-6F && value <= 1e6F; }

std::string pointText(const glm::vec3& v) { return "(" + numberText(v.x) + ", " + numberText(v.y) + ", " + numberText(v.z) + ")"; }

constexpr std::string_view kPositionRule = " is not finite or beyond 1e9; scale or repair the scene";
constexpr std::string_view kWeightRule = " is not above 0, or not within 1e-6 to 1e6; give weights around 1";

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

void checkPoints(const Mesh& mesh, const std::string& where) {
    const std::size_t perPatch = pointsPerPatch(mesh.kind), positions = positionsPerPatch(mesh.kind);
    if (mesh.points.size() % perPatch != 0) {
        fail(where, "has " + std::to_string(mesh.points.size()) + " points, which is no multiple of the " + std::to_string(perPatch) +
                        " of a " + std::string(name(mesh.kind)) + " patch; give whole patches");
    }
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const bool isNormal = i % perPatch >= positions;
        if (isNormal ? isFinite(mesh.points[i]) : isPosition(mesh.points[i])) continue;
        fail(where + ", patch " + std::to_string(i / perPatch) + ", point " + std::to_string(i % perPatch),
             pointText(mesh.points[i]) + std::string(isNormal ? " is a normal that is not finite; compute it anew" : kPositionRule));
    }
}

void checkWeights(const Mesh& mesh, const std::string& where) {
    if (mesh.kind != PatchKind::rational) {
        if (mesh.weights.empty()) return;
        fail(where, "has weights, which a " + std::string(name(mesh.kind)) + " patch has not; leave them out, or make it rational");
    }
    if (mesh.weights.size() != mesh.points.size()) {
        fail(where, "has " + std::to_string(mesh.weights.size()) + " weights for " + std::to_string(mesh.points.size()) +
                        " points; give one for each");
    }
    for (std::size_t i = 0; i < mesh.weights.size(); ++i) {
        if (isWeight(mesh.weights[i])) continue;
        fail(where + ", patch " + std::to_string(i / 16) + ", point " + std::to_string(i % 16),
             "weight " + numberText(mesh.weights[i]) + std::string(kWeightRule));
    }
}

// What is wrong with an edge record by itself; empty where it is sound.
std::string edgeFault(const Mesh& mesh, const EdgeRecord& edge) {
    if (edge.patch >= mesh.patchCount()) return "there are only " + std::to_string(mesh.patchCount()) + " patches; weld anew";
    if (edge.side > 3 || (edge.side == 2 && mesh.kind == PatchKind::pn)) {
        return "a " + std::string(name(mesh.kind)) + " patch has no such side; weld anew";
    }
    for (const glm::vec3& point : edge.points) {
        if (!isPosition(point)) return pointText(point) + std::string(kPositionRule);
    }
    for (const float weight : edge.weights) {
        if (!isWeight(weight)) return "weight " + numberText(weight) + std::string(kWeightRule);
    }
    if (edge.cuts > 8) return "is cut " + std::to_string(edge.cuts) + " times; at most 8 are possible";
    if (edge.level > edge.cuts) {
        return "is of level " + std::to_string(edge.level) + ", but cut " + std::to_string(edge.cuts) + " times; cut it as often at least";
    }
    if (edge.index >= 1U << edge.level) {
        return "is part " + std::to_string(edge.index) + " of " + std::to_string(1U << edge.level) + "; count from 0";
    }
    return {};
}

void checkEdges(const Mesh& mesh, const std::string& where) {
    const EdgeRecord* previous = nullptr;
    for (const EdgeRecord& edge : mesh.edges) {
        std::string fault = edgeFault(mesh, edge);
        if (fault.empty() && previous != nullptr) {
            const std::pair before(previous->patch, previous->side), now(edge.patch, edge.side);
            if (before == now) fault = "there are two; keep one";
            if (before > now) fault = "is not in order; sort edge records by patch and side";
        }
        if (!fault.empty()) {
            fail(where + ", edge record of patch " + std::to_string(edge.patch) + ", side " + std::to_string(edge.side), fault);
        }
        previous = &edge;
    }
}

void checkTexture(const Mesh& mesh, const std::string& where) {
    if (mesh.textureNets.empty()) return;
    if (mesh.textureNets.size() != 16 * mesh.patchCount()) {
        fail(where, "has " + std::to_string(mesh.textureNets.size()) + " texture points for " + std::to_string(mesh.patchCount()) +
                        " patches; give 16 a patch, or none");
    }
    for (std::size_t i = 0; i < mesh.textureNets.size(); ++i) {
        if (std::isfinite(mesh.textureNets[i].x) && std::isfinite(mesh.textureNets[i].y)) continue;
        fail(where + ", patch " + std::to_string(i / 16), "a texture point is not finite; repair it");
    }
}

// Lists that do not fit each other are told when the cage is read as a surface (subdivide()): here only what would break any reader.
void checkCage(const Cage& cage, const std::string& where) {
    for (std::size_t i = 0; i < cage.points.size(); ++i) {
        if (isPosition(cage.points[i])) continue;
        fail(where + ", point " + std::to_string(i), pointText(cage.points[i]) + std::string(kPositionRule));
    }
    for (const Crease& crease : cage.creases) {
        if (crease.sharpness >= 0.0F) continue;
        fail(where + ", crease of vertices " + std::to_string(crease.a) + " and " + std::to_string(crease.b),
             "sharpness " + numberText(crease.sharpness) + " is outside its range; give 0 to 10");
    }
    for (const Corner& corner : cage.corners) {
        if (corner.sharpness >= 0.0F) continue;
        fail(where + ", corner " + std::to_string(corner.vertex),
             "sharpness " + numberText(corner.sharpness) + " is outside its range; give 0 to 10");
    }
    for (std::size_t i = 0; i < cage.texturePoints.size(); ++i) {
        if (std::isfinite(cage.texturePoints[i].x) && std::isfinite(cage.texturePoints[i].y)) continue;
        fail(where + ", texture point " + std::to_string(i), "is not finite; repair it");
    }
}

void checkMesh(const Mesh& mesh, const std::string& where) {
    if (mesh.kind != PatchKind::bezier && mesh.kind != PatchKind::gregory && mesh.kind != PatchKind::rational &&
        mesh.kind != PatchKind::pn) {
        fail(where, "patches are of no known kind; use bezier, gregory, rational or pn");
    }
    checkPoints(mesh, where);
    checkWeights(mesh, where);
    checkEdges(mesh, where);
    checkTexture(mesh, where);
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

void validatePoints(const Mesh& mesh, const std::string& where) { checkPoints(mesh, where); }

void requireMeshes(const Scene& scene) {
    if (scene.cages.empty()) return;
    fail((scene.name.empty() ? std::string("scene") : scene.name) + ": cage " + quotedName(scene.cages.front().name),
         "is no mesh yet; make meshes of cages by subdivide()");
}

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
    for (const Cage& cage : cages) {
        if (!meshNames.insert(cage.name).second) fail(where("cage", cage.name), "the name is used twice; give each mesh its own");
        checkCage(cage, where("cage", cage.name));
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
