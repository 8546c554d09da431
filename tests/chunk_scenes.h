// What tests of chunks, of their upload and of their patches' boxes share: scenes of every kind of patch with edge records and shared
// meshes, and a device with the kernels that place them.
#pragma once

#include "sample_meshes.h"

#include "device/session.h"
#include "film/film.h"
#include "render/frame_setup.h"
#include "surface/patch_set.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace tessera::chunks {

using reference::Random;

// A record on one border of three, close to the patch; every other one is rational.
inline Mesh recorded(Mesh mesh, std::uint64_t seed) {
    Random random(seed);
    const std::size_t each = pointsPerPatch(mesh.kind);
    for (std::uint32_t patch = 0; patch < mesh.patchCount(); ++patch) {
        for (std::uint32_t side = 0; side < 4; ++side) {
            if (random.unit() > 0.33 || (mesh.kind == PatchKind::pn && side == 2)) continue;
            EdgeRecord record;
            record.patch = patch;
            record.side = side;
            for (glm::vec3& point : record.points) point = mesh.points[patch * each] + glm::vec3(random.inCube(1.0));
            if (random.unit() < 0.5)
                for (float& weight : record.weights) weight = static_cast<float>(random.between(0.3, 3.0));
            record.level = static_cast<std::uint32_t>(random.between(0.0, 2.99));
            record.index = record.level == 0 ? 0 : 1;
            record.reversed = random.unit() < 0.5;
            record.cuts = record.level + 1;
            mesh.edges.push_back(record);
        }
    }
    return mesh;
}

// The same surfaces: every other patch's weights are 50 times what they were, the others' a 50th.
inline Mesh unevenlyWeighted(Mesh mesh) {
    for (std::size_t k = 0; k < mesh.weights.size(); ++k) mesh.weights[k] *= k / 16 % 2 == 0 ? 50.0F : 0.02F;
    return mesh;
}

// Five meshes, 329 patches, the second one of a few boxes' patches; the first patch's side v = 0 is one point.
inline std::vector<Mesh> meshesOfEveryKind(std::uint64_t seed) {
    Mesh pole = reference::bumpyBezierMesh(seed, 7);
    for (std::size_t k = 1; k < 4; ++k) pole.points[k] = pole.points[0];
    return {recorded(pole, seed + 1), reference::bumpyBezierMesh(seed + 2, 300),
            recorded(reference::parted(reference::asGregory(reference::bumpyBezierMesh(seed + 3, 5)), 0.3, seed + 4), seed + 5),
            recorded(unevenlyWeighted(reference::weighted(reference::bumpyBezierMesh(seed + 6, 8), 3.0, seed + 7)), seed + 8),
            recorded(reference::bumpyPnMesh(seed + 9, 9), seed + 10)};
}

// Turned anyhow, within a cube 2 `reach` wide.
inline Object placedAnywhere(const Mesh& mesh, Random& random, double reach) {
    Object object;
    object.mesh = mesh.name;
    object.transform.translation = glm::vec3(random.inCube(reach));
    const glm::dvec3 axis = random.inCube(1.0);
    object.transform.rotation = glm::quat(1.0F, static_cast<float>(axis.x), static_cast<float>(axis.y), static_cast<float>(axis.z));
    return object;
}

// The meshes placed by 16 objects, kinds mixed, turned and within a cube 2 `reach` wide: 994 placed patches.
inline Scene sceneOfEveryKind(std::uint64_t seed, double reach = 6.0) {
    Scene scene = reference::sceneOf(meshesOfEveryKind(seed));
    scene.objects.clear();
    Random random(seed + 20);
    for (const std::size_t mesh : {4U, 0U, 2U, 1U, 0U, 3U, 0U, 2U, 1U, 4U, 0U, 3U, 2U, 1U, 4U, 3U})
        scene.objects.push_back(placedAnywhere(scene.meshes[mesh], random, reach));
    return scene;
}

// 16 meshes of one patch each, placed by 400 objects: 400 placed patches, each with a box of its own on the host.
inline Scene sceneOfLoosePatches(std::uint64_t seed) {
    std::vector<Mesh> meshes;
    for (std::uint64_t k = 0; k < 4; ++k) {
        const Mesh bezier = reference::bumpyBezierMesh(seed + 10 * k, 1);
        meshes.push_back(bezier);
        meshes.push_back(recorded(reference::parted(reference::asGregory(bezier), 0.3, seed + 10 * k + 1), seed + 10 * k + 2));
        meshes.push_back(unevenlyWeighted(reference::weighted(bezier, 3.0, seed + 10 * k + 3)));
        meshes.push_back(recorded(reference::bumpyPnMesh(seed + 10 * k + 4, 1), seed + 10 * k + 5));
    }
    Scene scene = reference::sceneOf(meshes);
    scene.objects.clear();
    Random random(seed + 50);
    for (std::size_t k = 0; k < 400; ++k) scene.objects.push_back(placedAnywhere(scene.meshes[k % scene.meshes.size()], random, 6.0));
    return scene;
}

// A placed patch as the scene has it.
struct PlacedPatch {
    const Mesh* mesh = nullptr;
    std::uint32_t object = 0;
    std::uint32_t index = 0;
};

// All placed patches in their order: by kind, then as the objects stand.
inline std::vector<PlacedPatch> placedPatches(const Scene& scene) {
    std::vector<PlacedPatch> placed;
    for (const PatchKind kind : {PatchKind::bezier, PatchKind::gregory, PatchKind::rational, PatchKind::pn}) {
        for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
            const Mesh* const mesh = scene.findMesh(scene.objects[object].mesh);
            if (mesh->kind != kind) continue;
            for (std::uint32_t patch = 0; patch < mesh->patchCount(); ++patch) placed.push_back({mesh, object, patch});
        }
    }
    return placed;
}

// Options of a picture whose sides are no multiples of a tile.
inline RenderOptions smallPicture() {
    RenderOptions options;
    options.mode = DiceMode::watertight;
    options.width = 330;
    options.height = 203;
    return options;
}

inline frame_params frameFor(const Camera& camera, const RenderOptions& options, const PatchSet& patches = {}) {
    frame_params frame = setUpFrame(camera, options, layOutFilm(options), true);
    setPatches(frame, patches);
    return frame;
}

// A device with the kernels that place patches, and no others: those take long to build.
struct PlaceRig {
    PlaceRig() : session(-1, placeAlone(kernelSources()), TESSERA_TEST_CACHE) {}

    static KernelSources placeAlone(KernelSources sources) {
        for (auto& [file, text] : sources)
            if (file.ends_with(".cl") && file != "surface/place.cl") text.clear();
        return sources;
    }

    template <typename T>
    [[nodiscard]] std::vector<T> read(const DeviceBuffer& buffer, std::size_t count) {
        std::vector<T> values(count);
        if (count > 0) session.timeline.read(buffer.cl(), values.data(), count * sizeof(T));
        return values;
    }

    // The scene placed as a whole. `frame` gets its counts.
    [[nodiscard]] PatchSet place(const Scene& scene, const std::vector<placed_object>& objects, frame_params& frame) {
        PatchSet set = uploadPatches(scene, session.memory, session.timeline);
        setPatches(frame, set);
        const std::size_t bytes = objects.size() * sizeof(placed_object);
        set.objects = session.memory.allocate(Purpose::scene, "the objects", bytes);
        session.timeline.write(set.objects.cl(), objects.data(), bytes);
        enqueuePlace(session, frame, set, set.objects.cl(), set.eyePoints.cl());
        return set;
    }

    DeviceSession session;
};

}  // namespace tessera::chunks
