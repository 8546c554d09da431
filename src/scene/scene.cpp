// Looking things up in a scene, and where its objects stand in the world.
#include "tessera/scene.h"

#include <algorithm>
#include <unordered_map>

namespace tessera {

namespace {

template <typename Item>
const Item* findByName(const std::vector<Item>& items, std::string_view wanted) {
    const auto found = std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.name == wanted; });
    return found == items.end() ? nullptr : &*found;
}

// Calls visit(object, item) for every object whose item, one of `items`, exists. Hashed: a linear search for each
// object would take minutes on a scene of a hundred thousand.
template <typename Item, typename Visit>
void forEachPlaced(const std::vector<Item>& items, const Scene& scene, Visit visit) {
    std::unordered_map<std::string_view, const Item*> named;
    for (const Item& item : items) named.emplace(item.name, &item);
    for (const Object& object : scene.objects) {
        if (const auto found = named.find(object.mesh); found != named.end()) visit(object, *found->second);
    }
}

}  // namespace

glm::dmat3 rotationMatrix(const Transform& transform) {
    const glm::dquat rotation(transform.rotation);
    return glm::mat3_cast(rotation / glm::length(rotation));
}

glm::dmat4 matrix(const Transform& transform) {
    glm::dmat4 result(rotationMatrix(transform));
    result[3] = glm::dvec4(glm::dvec3(transform.translation), 1.0);
    return result;
}

std::string_view name(PatchKind kind) {
    switch (kind) {
        case PatchKind::bezier:
            return "bezier";
        case PatchKind::gregory:
            return "gregory";
        case PatchKind::rational:
            return "rational";
        case PatchKind::pn:
            return "pn";
    }
    return "unknown";
}

std::string_view name(LightKind kind) {
    switch (kind) {
        case LightKind::point:
            return "point";
        case LightKind::directional:
            return "directional";
        case LightKind::hemi:
            return "hemi";
    }
    return "unknown";
}

const Mesh* Scene::findMesh(std::string_view meshName) const { return findByName(meshes, meshName); }

const Camera* Scene::findCamera(std::string_view cameraName) const { return findByName(cameras, cameraName); }

std::size_t Scene::placedPatchCount() const {
    std::size_t count = 0;
    forEachPlaced(meshes, *this, [&](const Object&, const Mesh& mesh) { count += mesh.patchCount(); });
    return count;
}

void Bounds::include(const glm::vec3& point) {
    lower = glm::min(lower, point);
    upper = glm::max(upper, point);
}

Bounds worldBounds(const Scene& scene) {
    Bounds bounds;
    forEachPlaced(scene.meshes, scene, [&](const Object& object, const Mesh& mesh) {
        const glm::dmat3 rotation = rotationMatrix(object.transform);
        const glm::dvec3 translation(object.transform.translation);
        const std::size_t step = pointsPerPatch(mesh.kind), positions = positionsPerPatch(mesh.kind);
        for (std::size_t k = 0; k < mesh.points.size(); ++k) {
            if (k % step < positions) bounds.include(glm::vec3(rotation * glm::dvec3(mesh.points[k]) + translation));
        }
    });
    forEachPlaced(scene.cages, scene, [&](const Object& object, const Cage& cage) {
        const glm::dmat4 place = matrix(object.transform);
        for (const glm::vec3& point : cage.points) bounds.include(glm::vec3(place * glm::dvec4(point, 1.0)));
    });
    return bounds;
}

}  // namespace tessera
