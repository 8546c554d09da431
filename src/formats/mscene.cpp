// Reads .mscene files. The bytes are trusted in nothing: sizes are bounded before memory is taken, and every
// failure is an Error that names file and item.
#include "formats/mscene.h"

#include "formats/mscene_cage.h"
#include "formats/mscene_reading.h"
#include "scene/text.h"
#include "tessera/error.h"

#include "mscene.capnp.h"

#include <capnp/serialize-packed.h>
#include <kj/exception.h>
#include <kj/io.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <fstream>
#include <new>
#include <string_view>
#include <system_error>
#include <unordered_set>
#include <utility>

namespace tessera {

namespace {

constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30U;

// Unpacked, a file may take this many times its bytes and this much more. Coordinates pack to a third at best,
// a bomb of packed zeros to a thousandth.
constexpr std::uint64_t kUnpackedPerByte = 8;
constexpr std::uint64_t kUnpackedAllowance = 1U << 20U;

glm::vec3 readVec3(schema::Vec3::Reader vector) { return {vector.getX(), vector.getY(), vector.getZ()}; }

// Item is any of the schema's structs with a transform.
template <typename Item>
Transform readTransform(const MsceneReading& reading, Item source, const std::string& item) {
    Transform transform;
    const schema::Transform::Reader stored = source.getTransform();
    if (stored.hasTranslation()) transform.translation = readVec3(stored.getTranslation());
    if (stored.hasRotation()) {
        const schema::Quaternion::Reader rotation = stored.getRotation();
        transform.rotation = glm::quat(rotation.getR(), rotation.getI(), rotation.getJ(), rotation.getK());
    }
    if (!stored.hasTranslation() || !stored.hasRotation()) {
        reading.warn(item + " has no " + (stored.hasTranslation() ? "rotation" : "place") + ": none is taken");
    }
    return transform;
}

template <typename Item>
glm::vec3 readColor(const MsceneReading& reading, Item source, const std::string& item) {
    if (source.hasColor()) return readVec3(source.getColor());
    reading.warn(item + " has no colour: white is taken");
    return glm::vec3(1.0F);
}

PatchKind readKind(const MsceneReading& reading, schema::Mesh::Reader source, const std::string& item) {
    switch (source.getType()) {
        case schema::Mesh::Type::BEZIER:
            return PatchKind::bezier;
        case schema::Mesh::Type::GREGORY:
            return PatchKind::gregory;
        case schema::Mesh::Type::RATIONAL:
            return PatchKind::rational;
        case schema::Mesh::Type::PN:
            return PatchKind::pn;
    }
    // A file may hold any number here.
    reading.fail(item + ": unknown type " + std::to_string(static_cast<int>(source.getType())) + "; use bezier, gregory, rational or pn");
}

std::vector<glm::vec3> readPoints(const MsceneReading& reading, schema::Mesh::Reader source, PatchKind kind, const std::string& item) {
    // Fetched once: each fetch counts against the message's traversal limit.
    const capnp::List<float>::Reader positions = source.getPositions();
    const std::uint32_t perPatch = static_cast<std::uint32_t>(pointsPerPatch(kind)) * 3;
    if (positions.size() % perPatch != 0) {
        reading.fail(item + ": " + std::to_string(positions.size()) + " numbers are no multiple of the " + std::to_string(perPatch) +
                     " of a " + std::string(name(kind)) + " patch; give whole patches");
    }
    if (positions.size() == 0) reading.warn(item + " has no patches");
    std::vector<glm::vec3> points;
    points.reserve(positions.size() / 3);
    for (std::uint32_t i = 0; i < positions.size(); i += 3) points.emplace_back(positions[i], positions[i + 1], positions[i + 2]);
    return points;
}

// Only their number is judged here: their values are a matter of Scene::validate().
std::vector<float> readWeights(const MsceneReading& reading, schema::Mesh::Reader source, const Mesh& mesh, const std::string& item) {
    const capnp::List<float>::Reader stored = source.getWeights();
    if (mesh.kind != PatchKind::rational) {
        if (stored.size() == 0) return {};
        reading.fail(item + ": has weights, which " + std::string(name(mesh.kind)) +
                     " patches have not; make it rational or leave them out");
    }
    if (stored.size() != mesh.points.size()) {
        reading.fail(item + ": " + std::to_string(stored.size()) + " weights do not fit its " + std::to_string(mesh.points.size()) +
                     " control points; give one a point");
    }
    std::vector<float> weights;
    weights.reserve(stored.size());
    for (const float weight : stored) weights.push_back(weight);
    return weights;
}

Mesh readMesh(const MsceneReading& reading, schema::Mesh::Reader source, std::size_t index) {
    Mesh mesh;
    mesh.name = readName(reading, source.getName(), itemText("mesh", index));
    const std::string item = "mesh " + quotedName(mesh.name);
    mesh.kind = readKind(reading, source, item);
    mesh.points = readPoints(reading, source, mesh.kind, item);
    mesh.weights = readWeights(reading, source, mesh, item);
    return mesh;
}

Light readLight(const MsceneReading& reading, schema::LightSource::Reader source, std::size_t index) {
    Light light;
    light.name = readName(reading, source.getName(), itemText("light", index));
    const std::string item = "light " + quotedName(light.name);
    switch (source.getType()) {
        case schema::LightSource::Type::POINT:
            light.kind = LightKind::point;
            break;
        case schema::LightSource::Type::DIRECTIONAL:
            light.kind = LightKind::directional;
            break;
        case schema::LightSource::Type::HEMI:
            light.kind = LightKind::hemi;
            break;
        default:
            reading.fail(item + ": unknown type " + std::to_string(static_cast<int>(source.getType())) +
                         "; use point, directional or hemi");
    }
    light.transform = readTransform(reading, source, item);
    light.color = readColor(reading, source, item);
    light.intensity = source.getIntensity();
    return light;
}

Material readMaterial(const MsceneReading& reading, schema::Material::Reader source, const std::string& item) {
    Material material;
    switch (source.getKind()) {
        case schema::Material::Kind::MATTE:
            material.kind = MaterialKind::matte;
            break;
        case schema::Material::Kind::PLASTIC:
            material.kind = MaterialKind::plastic;
            break;
        default:
            reading.fail(item + ": unknown material " + std::to_string(static_cast<int>(source.getKind())) + "; use matte or plastic");
    }
    material.specular = source.getSpecular();
    material.roughness = source.getRoughness();
    return material;
}

Object readObject(const MsceneReading& reading, schema::Object::Reader source, std::size_t index) {
    Object object;
    object.name = readName(reading, source.getName(), itemText("object", index));
    const std::string item = "object " + quotedName(object.name);
    object.mesh = readName(reading, source.getMeshname(), item + ", mesh");
    object.transform = readTransform(reading, source, item);
    object.color = readColor(reading, source, item);
    if (source.hasMaterial()) object.material = readMaterial(reading, source.getMaterial(), item);
    return object;
}

Camera readCamera(const MsceneReading& reading, schema::Camera::Reader source, std::size_t index) {
    Camera camera;
    camera.name = readName(reading, source.getName(), itemText("camera", index));
    camera.transform = readTransform(reading, source, "camera " + quotedName(camera.name));
    camera.near = source.getNear();
    camera.far = source.getFar();
    camera.fovy = source.getFovy();
    return camera;
}

Scene readScene(const MsceneReading& reading, schema::Scene::Reader source) {
    Scene scene;
    scene.name = reading.file();
    scene.meshes = readList<Mesh>(reading, "mesh", source.getMeshes(), readMesh);
    scene.lights = readList<Light>(reading, "light", source.getLights(), readLight);
    scene.objects = readList<Object>(reading, "object", source.getObjects(), readObject);
    scene.cameras = readList<Camera>(reading, "camera", source.getCameras(), readCamera);
    scene.cages = readList<Cage>(reading, "cage", source.getCages(), readCage);
    return scene;
}

void warnOfOddities(const MsceneReading& reading, const Scene& scene) {
    if (scene.objects.empty()) reading.warn("the scene has no objects: there is nothing to see");
    std::unordered_set<std::string_view> names;
    for (const Camera& camera : scene.cameras) {
        if (!names.insert(camera.name).second) reading.warn("camera " + quotedName(camera.name) + " is there twice: the first is taken");
    }
}

// The most bytes that a message in a file of `fileBytes` may unpack to.
std::uint64_t unpackedLimit(std::uint64_t fileBytes) { return fileBytes * kUnpackedPerByte + kUnpackedAllowance; }

// Bytes that packed `bytes` stand for. Cap'n Proto's own count refuses what does not end where a word ends; here
// the end is left to the reader, which knows where the message stops and says what is wrong with it.
std::uint64_t unpackedSize(kj::ArrayPtr<const kj::byte> bytes) {
    std::uint64_t words = 0;
    for (std::size_t i = 0; i < bytes.size();) {
        const kj::byte tag = bytes[i];
        i += 1 + static_cast<std::size_t>(std::popcount(tag));
        ++words;
        if ((tag != 0x00 && tag != 0xFF) || i >= bytes.size()) continue;
        const std::size_t run = bytes[i++];
        words += run;
        if (tag == 0xFF) i += run * sizeof(capnp::word);
    }
    return words * sizeof(capnp::word);
}

void refuseBombs(const MsceneReading& reading, kj::ArrayPtr<const kj::byte> bytes) {
    const std::uint64_t unpacked = unpackedSize(bytes);
    const std::uint64_t limit = unpackedLimit(bytes.size());
    if (unpacked <= limit) return;
    reading.fail("unpacks to " + std::to_string(unpacked) + " bytes, more than the " + std::to_string(limit) + " that a scene in " +
                 std::to_string(bytes.size()) + " bytes may take" + std::string(kDamaged));
}

Scene unpackScene(const MsceneReading& reading, kj::ArrayPtr<const kj::byte> bytes) {
    refuseBombs(reading, bytes);
    capnp::ReaderOptions options;
    // Bounds what the message claims to hold as well, before any of it is allocated.
    options.traversalLimitInWords = unpackedLimit(bytes.size()) / sizeof(capnp::word);
    options.nestingLimit = 16;
    kj::ArrayInputStream stream(bytes);
    Scene scene;
    {
        // Reads what is left of the message when it goes, and so may throw then.
        capnp::PackedMessageReader message(stream, options);
        scene = readScene(reading, message.getRoot<schema::Scene>());
    }
    if (const std::size_t left = stream.tryGetReadBuffer().size(); left > 0) {
        reading.warn(std::to_string(left) + " bytes after the scene's end are ignored");
    }
    return scene;
}

std::vector<std::byte> readBytes(const std::filesystem::path& path) {
    const std::string file = path.string();
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw Error(file + ": cannot be found; check the name");
    if (std::filesystem::is_directory(status)) throw Error(file + ": is a folder; name a scene file in it");
    if (!std::filesystem::is_regular_file(status)) throw Error(file + ": is no ordinary file; copy the scene to one");
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) throw Error(file + ": its size cannot be read (" + error.message() + "); check its permissions");
    if (size > kLargestFile) {
        throw Error(file + ": has " + std::to_string(size) + " bytes; scene files hold at most " + std::to_string(kLargestFile));
    }
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw Error(file + ": cannot be opened; check its permissions");
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (static_cast<std::uintmax_t>(stream.gcount()) != size) throw Error(file + ": cannot be read to its end; check the disk");
    return bytes;
}

}  // namespace

Scene parseMscene(std::span<const std::byte> bytes, const std::string& sceneName, std::vector<std::string>* warnings) {
    const MsceneReading reading(sceneName, bytes.size(), warnings);
    if (bytes.empty()) reading.fail("is empty; a scene is a packed Cap'n Proto message");
    try {
        Scene scene = unpackScene(reading, kj::arrayPtr(reinterpret_cast<const kj::byte*>(bytes.data()), bytes.size()));
        scene.validate();
        warnOfOddities(reading, scene);
        return scene;
    } catch (const kj::Exception& exception) {
        reading.fail(describe(exception) + std::string(kDamaged));
    }
}

Scene readMscene(const std::filesystem::path& path, std::vector<std::string>* warnings) {
    try {
        return parseMscene(readBytes(path), path.string(), warnings);
    } catch (const std::bad_alloc&) {
        throw Error(path.string() + ": there is not enough memory to read it; split it into smaller files");
    }
}

}  // namespace tessera
