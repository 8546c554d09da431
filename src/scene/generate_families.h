// The families of scenes that are made by rule, a file each, and what they share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tessera/progress.h"
#include "tessera/scene.h"

namespace tessera {

// What generateScene() was asked for; `count` is in the family's range.
struct Making {
    std::uint64_t count = 1;
    std::uint32_t seed = 1;
    const Progress& progress;

    // Tells how far it is, now and then.
    void tell(std::uint64_t done, std::uint64_t all) const {
        if (progress && done % 1024 == 0) progress("generate", std::min(1.0, static_cast<double>(done) / static_cast<double>(all)));
    }
};

[[nodiscard]] Scene generateHair(const Making& making);
[[nodiscard]] Scene generateColumns(const Making& making);
[[nodiscard]] Scene generateCity(const Making& making);
[[nodiscard]] Scene generateEyesplit(const Making& making);
[[nodiscard]] Scene generateRandomPatches(const Making& making);
[[nodiscard]] Scene generateSpheres(const Making& making);

// Adds a camera of that name which looks from `eye` at `target`.
void addNamedCamera(Scene& scene, std::string name, const glm::vec3& eye, const glm::vec3& target, float fovyDegrees);

// Sunlight from the left, behind the viewer, and a sky: for scenes under it.
void addDaylight(Scene& scene);

// Adds an object that stands at `at`, neither turned nor scaled.
void addObject(Scene& scene, const std::string& mesh, std::string name, const glm::dvec3& at, const glm::vec3& color,
               const Material& material);

[[nodiscard]] inline Mesh bezierMesh(std::string name, std::vector<glm::vec3> points) {
    Mesh mesh;
    mesh.name = std::move(name);
    mesh.points = std::move(points);
    return mesh;
}

}  // namespace tessera
