// Writes .mscene files. A scene is written as it is, sound or not: the reader judges.
#include "formats/mscene.h"
#include "formats/mscene_cage.h"
#include "formats/mscene_lists.h"
#include "formats/output_file.h"
#include "scene/text.h"
#include "tessera/error.h"

#include "mscene.capnp.h"

#include <capnp/message.h>
#include <capnp/serialize-packed.h>
#include <kj/io.h>

#include <cstdint>
#include <limits>

namespace tessera {

namespace {

// Cap'n Proto keeps a list's length in 29 bits.
constexpr std::size_t kLongestList = (std::size_t{1} << 29U) - 1;

}  // namespace

std::uint32_t msceneListSize(std::size_t size, const std::string& what) {
    if (size > kLongestList) {
        throw Error(what + ": " + std::to_string(size) + " are more than the " + std::to_string(kLongestList) +
                    " that a list in an .mscene file holds; split it");
    }
    return static_cast<std::uint32_t>(size);
}

namespace {

capnp::Text::Reader text(const std::string& value) { return {value.c_str(), value.size()}; }

void write(schema::Vec3::Builder target, const glm::vec3& value) {
    target.setX(value.x);
    target.setY(value.y);
    target.setZ(value.z);
}

void write(schema::Transform::Builder target, const Transform& transform) {
    write(target.initTranslation(), transform.translation);
    schema::Quaternion::Builder rotation = target.initRotation();
    rotation.setR(transform.rotation.w);
    rotation.setI(transform.rotation.x);
    rotation.setJ(transform.rotation.y);
    rotation.setK(transform.rotation.z);
}

schema::Mesh::Type meshType(PatchKind kind) {
    switch (kind) {
        case PatchKind::bezier:
            return schema::Mesh::Type::BEZIER;
        case PatchKind::gregory:
            return schema::Mesh::Type::GREGORY;
        case PatchKind::rational:
            return schema::Mesh::Type::RATIONAL;
        case PatchKind::pn:
            return schema::Mesh::Type::PN;
    }
    return schema::Mesh::Type::BEZIER;
}

void write(schema::Mesh::Builder target, const Mesh& mesh) {
    target.setName(text(mesh.name));
    target.setType(meshType(mesh.kind));
    auto positions = target.initPositions(msceneListSize(mesh.points.size() * 3, "mesh " + quotedName(mesh.name) + ", coordinates"));
    std::uint32_t i = 0;
    for (const glm::vec3& point : mesh.points) {
        positions.set(i++, point.x);
        positions.set(i++, point.y);
        positions.set(i++, point.z);
    }
    if (mesh.weights.empty()) return;
    auto weights = target.initWeights(msceneListSize(mesh.weights.size(), "mesh " + quotedName(mesh.name) + ", weights"));
    for (i = 0; i < weights.size(); ++i) weights.set(i, mesh.weights[i]);
}

schema::LightSource::Type lightType(LightKind kind) {
    if (kind == LightKind::point) return schema::LightSource::Type::POINT;
    return kind == LightKind::hemi ? schema::LightSource::Type::HEMI : schema::LightSource::Type::DIRECTIONAL;
}

void write(schema::LightSource::Builder target, const Light& light) {
    target.setName(text(light.name));
    write(target.initTransform(), light.transform);
    write(target.initColor(), light.color);
    target.setIntensity(light.intensity);
    target.setType(lightType(light.kind));
}

// What a reader takes where the file says nothing.
bool isDefault(const Material& material) {
    const Material standard;
    return material.kind == standard.kind && material.specular == standard.specular && material.roughness == standard.roughness;
}

void write(schema::Object::Builder target, const Object& object) {
    target.setName(text(object.name));
    write(target.initTransform(), object.transform);
    target.setMeshname(text(object.mesh));
    write(target.initColor(), object.color);
    // Left out where it says nothing new: Micropolis' own scenes come out as Micropolis wrote them.
    if (isDefault(object.material)) return;
    schema::Material::Builder material = target.initMaterial();
    material.setKind(object.material.kind == MaterialKind::plastic ? schema::Material::Kind::PLASTIC : schema::Material::Kind::MATTE);
    material.setSpecular(object.material.specular);
    material.setRoughness(object.material.roughness);
}

void write(schema::Cage::Builder target, const Cage& cage) { writeCage(target, cage); }

void write(schema::Camera::Builder target, const Camera& camera) {
    target.setName(text(camera.name));
    write(target.initTransform(), camera.transform);
    target.setNear(camera.near);
    target.setFar(camera.far);
    target.setFovy(camera.fovy);
}

template <typename List, typename Item>
void writeAll(List target, const std::vector<Item>& items) {
    for (std::uint32_t i = 0; i < items.size(); ++i) write(target[i], items[i]);
}

}  // namespace

std::vector<std::byte> serializeMscene(const Scene& scene) {
    capnp::MallocMessageBuilder message;
    schema::Scene::Builder root = message.initRoot<schema::Scene>();
    writeAll(root.initMeshes(msceneListSize(scene.meshes.size(), "meshes")), scene.meshes);
    writeAll(root.initLights(msceneListSize(scene.lights.size(), "lights")), scene.lights);
    writeAll(root.initObjects(msceneListSize(scene.objects.size(), "objects")), scene.objects);
    writeAll(root.initCameras(msceneListSize(scene.cameras.size(), "cameras")), scene.cameras);
    // Left out where there are none: scenes without cages keep the bytes that they had before there were any.
    if (!scene.cages.empty()) writeAll(root.initCages(msceneListSize(scene.cages.size(), "cages")), scene.cages);
    kj::VectorOutputStream stream;
    capnp::writePackedMessage(stream, message);
    const kj::ArrayPtr<kj::byte> packed = stream.getArray();
    const auto* first = reinterpret_cast<const std::byte*>(packed.begin());
    return {first, first + packed.size()};
}

void writeMscene(const Scene& scene, const std::filesystem::path& path) { writeOutputFile(path, serializeMscene(scene)); }

}  // namespace tessera
