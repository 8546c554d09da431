// What tests of cameras and scenes share: where things are seen.
#pragma once

#include "tessera/scene.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace tessera::test {

// A point as `camera` sees it: x and y over half the picture's height, z the distance along the view axis.
inline glm::dvec3 seenBy(const Camera& camera, const glm::dvec3& point) {
    const glm::dvec3 eye = glm::transpose(rotationMatrix(camera.transform)) * (point - glm::dvec3(camera.transform.translation));
    const double scale = 1.0 / (-eye.z * std::tan(glm::radians(static_cast<double>(camera.fovy)) * 0.5));
    return {eye.x * scale, eye.y * scale, -eye.z};
}

// The control points of all objects, in the world.
inline std::vector<glm::dvec3> placedPoints(const Scene& scene) {
    std::vector<glm::dvec3> points;
    for (const Object& object : scene.objects) {
        for (const Cage& cage : scene.cages) {
            if (cage.name != object.mesh) continue;
            for (const glm::vec3& point : cage.points) points.emplace_back(matrix(object.transform) * glm::dvec4(glm::dvec3(point), 1.0));
        }
        if (scene.findMesh(object.mesh) == nullptr) continue;
        const Mesh& mesh = *scene.findMesh(object.mesh);
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
            if (i % pointsPerPatch(mesh.kind) >= positionsPerPatch(mesh.kind)) continue;  // a normal
            points.emplace_back(matrix(object.transform) * glm::dvec4(glm::dvec3(mesh.points[i]), 1.0));
        }
    }
    return points;
}

}  // namespace tessera::test
