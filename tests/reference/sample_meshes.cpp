// Meshes for tests, made from a seed.
#include "sample_meshes.h"

#include "patch_eval.h"

#include <cmath>

namespace tessera::reference {

double Random::unit() {
    // A Weyl sequence through the finalizer of SplitMix64.
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53;
}

glm::dvec3 Random::inCube(double halfWidth) {
    glm::dvec3 result;
    for (int axis = 0; axis < 3; ++axis) result[axis] = between(-halfWidth, halfWidth);
    return result;
}

Mesh bumpyBezierMesh(std::uint64_t seed, std::size_t patches) {
    Random random(seed);
    Mesh mesh;
    for (std::size_t patch = 0; patch < patches; ++patch) {
        const glm::dvec3 along = glm::normalize(random.inCube(1.0) + glm::dvec3(1e-3));
        const glm::dvec3 other = glm::normalize(glm::cross(along, random.inCube(1.0) + glm::dvec3(0, 1e-3, 0)));
        const glm::dvec3 center = patches == 1 ? glm::dvec3(0.0) : random.inCube(1.0);
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 4; ++i)
                mesh.points.emplace_back(center + (0.5 * i - 0.75) * along + (0.5 * j - 0.75) * other + random.inCube(0.3));
    }
    return mesh;
}

Mesh asGregory(const Mesh& bezier) {
    Mesh mesh{bezier.name, PatchKind::gregory, {}};
    for (std::size_t patch = 0; patch < bezier.patchCount(); ++patch)
        for (const glm::dvec3& point : gregoryFromBezier(patchPoints(bezier, patch))) mesh.points.emplace_back(point);
    return mesh;
}

Mesh parted(const Mesh& gregory, double distance, std::uint64_t seed) {
    Random random(seed);
    Mesh mesh = gregory;
    for (std::size_t patch = 0; patch < mesh.patchCount(); ++patch)
        for (std::size_t i = 12; i < 20; ++i) mesh.points[20 * patch + i] += glm::vec3(random.inCube(distance));
    return mesh;
}

Mesh weighted(const Mesh& bezier, double factor, std::uint64_t seed) {
    Random random(seed);
    Mesh mesh{bezier.name, PatchKind::rational, bezier.points};
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        mesh.weights.push_back(static_cast<float>(std::pow(factor, random.between(-1.0, 1.0))));
    return mesh;
}

Mesh bumpyPnMesh(std::uint64_t seed, std::size_t patches) {
    Random random(seed);
    Mesh mesh{"", PatchKind::pn, {}};
    for (std::size_t patch = 0; patch < patches; ++patch) {
        const glm::dvec3 along = glm::normalize(random.inCube(1.0) + glm::dvec3(1e-3));
        const glm::dvec3 up = glm::normalize(glm::cross(along, random.inCube(1.0) + glm::dvec3(0, 1e-3, 0)));
        const glm::dvec3 other = glm::cross(up, along);
        const glm::dvec3 center = patches == 1 ? glm::dvec3(0.0) : random.inCube(1.0);
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i + j < 4; ++i)
                mesh.points.emplace_back(center + (0.5 * i - 0.5) * along + (0.5 * j - 0.5) * other + random.inCube(0.3));
        for (int k = 0; k < 6; ++k) mesh.points.emplace_back(up + random.inCube(0.4));
    }
    return mesh;
}

Scene sceneOf(std::vector<Mesh> meshes) {
    Scene scene;
    scene.name = "sample";
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        meshes[i].name = "mesh" + std::to_string(i);
        Object object;
        object.name = "object" + std::to_string(i);
        object.mesh = meshes[i].name;
        scene.objects.push_back(object);
    }
    scene.meshes = std::move(meshes);
    return scene;
}

Camera cameraAt(const glm::dvec3& eye, const glm::dvec3& target, double fovyDegrees) {
    const glm::dvec3 back = glm::normalize(eye - target);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back));
    const glm::dvec3 up = glm::cross(back, right);
    Camera camera;
    camera.transform.translation = glm::vec3(eye);
    camera.transform.rotation = glm::quat(glm::quat_cast(glm::dmat3(right, up, back)));
    camera.fovy = static_cast<float>(fovyDegrees);
    return camera;
}

}  // namespace tessera::reference
