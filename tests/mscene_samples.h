// Small scenes that the tests of the .mscene reader start from, and its fuzzer's seeds are made of; what the reader says of bytes.
#pragma once

#include "formats/mscene.h"
#include "tessera/error.h"
#include "tessera/scene.h"

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tessera {

// A flat patch of side 1, the way Micropolis writes scenes.
inline Scene plainScene() {
    Scene scene;
    scene.meshes.resize(1);
    Mesh& mesh = scene.meshes.front();
    mesh.name = "plate";
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            mesh.points.emplace_back(static_cast<float>(column) / 3.0F, static_cast<float>(row) / 3.0F, 0.0F);
        }
    }
    Object object;
    object.name = "a";
    object.mesh = mesh.name;
    object.color = {0.5F, 0.25F, 0.125F};
    scene.objects.push_back(object);
    Light light;
    light.name = "sun";
    light.intensity = 2.0F;
    scene.lights.push_back(light);
    Camera camera;
    camera.name = "front";
    camera.transform.translation = {0.5F, 0.5F, 3.0F};
    scene.cameras.push_back(camera);
    return scene;
}

// Patches of Tessera's own kinds: `count` rational ones with a weight of its own for each point.
inline Mesh rationalMesh(const std::string& name, int count) {
    Mesh mesh;
    mesh.name = name;
    mesh.kind = PatchKind::rational;
    for (int i = 0; i < 16 * count; ++i) {
        const int row = i / 4;
        mesh.points.emplace_back(static_cast<float>(i % 4) * 0.7F, static_cast<float>(row), static_cast<float>(i % 3) * 0.2F);
        mesh.weights.push_back(0.25F + static_cast<float>(i % 16) * 0.125F);
    }
    return mesh;
}

// A PN triangle of side 1, flat: points by thirds, then six normals along z.
inline Mesh pnTriangle(const std::string& name) {
    Mesh mesh;
    mesh.name = name;
    mesh.kind = PatchKind::pn;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4 - row; ++column) {
            mesh.points.emplace_back(static_cast<float>(column) / 3.0F, static_cast<float>(row) / 3.0F, 0.0F);
        }
    }
    mesh.points.insert(mesh.points.end(), 6, glm::vec3(0.0F, 0.0F, 1.0F));
    return mesh;
}

// All kinds of patches, lights and materials, an object for each mesh, names beyond ASCII.
inline Scene richScene() {
    Scene scene = plainScene();
    Mesh gregory;
    gregory.name = "greg";
    gregory.kind = PatchKind::gregory;
    for (int i = 0; i < 40; ++i)
        gregory.points.emplace_back(static_cast<float>(i % 5) * 0.3F, static_cast<float>(i % 7), static_cast<float>(-i));
    scene.meshes.push_back(gregory);
    scene.objects[0].material = {MaterialKind::plastic, 0.75F, 0.2F};
    Object second = scene.objects[0];
    second.name = "b";
    second.mesh = gregory.name;
    second.transform.translation = {1.0F, -2.0F, 0.5F};
    second.transform.rotation = glm::quat(0.5F, -0.5F, 0.25F, 1.0F);
    second.material = {MaterialKind::matte, 0.3F, 0.9F};
    scene.objects.push_back(second);
    for (Mesh& mesh : std::vector{rationalMesh("ratio", 2), pnTriangle("tri")}) {
        Object object = second;
        object.name = "of " + mesh.name;
        object.mesh = mesh.name;
        scene.objects.push_back(object);
        scene.meshes.push_back(std::move(mesh));
    }
    for (const LightKind kind : {LightKind::point, LightKind::hemi}) {
        Light light = scene.lights[0];
        light.name = "l\xC3\xA4mp";
        light.kind = kind;
        light.color = {1.0F, 0.5F, 0.0F};
        light.transform.translation = {0.0F, 9.0F, 0.0F};
        scene.lights.push_back(light);
    }
    Camera sideCamera = scene.cameras[0];
    sideCamera.name = "side";
    sideCamera.near = 0.5F;
    sideCamera.far = 50.0F;
    sideCamera.fovy = 28.5F;
    scene.cameras.push_back(sideCamera);
    return scene;
}

using Bytes = std::vector<std::byte>;

// What the reader says of `bytes`, under the name "file"; empty where it gives a scene.
inline std::string complaint(std::span<const std::byte> bytes, std::vector<std::string>* warnings = nullptr) {
    try {
        static_cast<void>(parseMscene(bytes, "file", warnings));
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace tessera
