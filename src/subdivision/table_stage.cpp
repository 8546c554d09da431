// Numbers of what a scene's objects place.
#include "subdivision/table_stage.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <string_view>
#include <unordered_map>

#include "mesh/mesh_view.h"
#include "scene/text.h"
#include "surface/source_mesh.h"
#include "tessera/error.h"

namespace tessera::subdivision {
namespace {

// Counts that are held in 32 bits on the device.
std::uint32_t sumOf(std::uint32_t a, std::size_t b, const Scene& scene) {
    if (a + b > std::numeric_limits<std::uint32_t>::max())
        throw Error(scene.name + ": its subdivision surfaces have more than 4294967295 faces or control points; use fewer objects");
    return static_cast<std::uint32_t>(a + b);
}

}  // namespace

TableStage makeStage(const Scene& scene, const std::vector<TableCage>& cages, int more, TableStore& store) {
    TableStage stage;
    std::uint32_t faces = 0;
    std::unordered_map<std::string_view, std::size_t> byName;
    for (std::size_t c = 0; c < cages.size(); ++c) {
        byName.emplace(scene.cages[c].name, c);
        stage.firstFace.push_back(faces);
        stage.firstPoint.push_back(stage.points);
        TableFaces made;
        if (!cages[c].clean.cage.faceSizes.empty()) {
            try {
                made = makeTableFaces(*makeRefiner(cages[c].clean.cage), cages[c].ownSteps + more, store);
            } catch (const Error& error) {
                throw Error(scene.name + ": cage " + quotedName(scene.cages[c].name) + ": " + error.what());
            }
        }
        faces = sumOf(faces, made.faces.size(), scene);
        stage.points = sumOf(stage.points, made.points, scene);
        stage.cages.push_back(std::move(made));
    }
    const std::vector<placed_object> places = worldObjects(scene);
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        const std::size_t c = byName.at(scene.objects[o].mesh);
        const TableFaces& cage = stage.cages[c];
        if (cage.faces.empty()) continue;
        table_object object{};
        object.first_patch = stage.patches;
        object.first_face = stage.firstFace[c];
        object.first_point = stage.placedPoints;
        object.first_source = stage.firstPoint[c];
        object.points = cage.points;
        object.id = static_cast<std::uint32_t>(o);
        std::copy(std::begin(places[o].eye_from_object), std::end(places[o].eye_from_object), std::begin(object.world_from_object));
        stage.objects.push_back(object);
        stage.cageOf.push_back(static_cast<std::uint32_t>(c));
        stage.patches = sumOf(stage.patches, cage.faces.size(), scene);
        stage.placedPoints = sumOf(stage.placedPoints, cage.points, scene);
    }
    return stage;
}

Scene standIn(const Scene& scene, const TableStage& stage) {
    Scene out = scene;
    out.cages.clear();
    const auto borders = bordersOf(PatchKind::bezier);
    // Numbers above 2^24 are not whole in a float: 16 bits each.
    const auto numberPoint = [](std::uint32_t number, std::uint32_t which, std::uint32_t object) {
        return glm::vec3(static_cast<float>(2 * (number & 0xFFFFU) + which), static_cast<float>(number >> 16U), static_cast<float>(object));
    };
    std::vector<bool> placed(scene.objects.size(), false);
    for (std::size_t k = 0; k < stage.objects.size(); ++k) {
        const std::uint32_t object = stage.objects[k].id;
        const TableFaces& cage = stage.cages[stage.cageOf[k]];
        Mesh mesh;
        mesh.name = "object " + std::to_string(object);
        mesh.welded = true;
        mesh.points.resize(16 * cage.faces.size());
        for (std::size_t f = 0; f < cage.faces.size(); ++f) {
            for (std::uint32_t s = 0; s < 4; ++s) {
                // Sides 2 and 3 of a patch run against its loop.
                const bool against = (s >= 2) != cage.sides[f][s].reversed;
                glm::vec3* const points = mesh.points.data() + std::size_t{16} * cage.faces[f].number;
                points[borders[s][s >= 2 ? 3 : 0]] = numberPoint(cage.corners[f][s], 0, object);
                for (std::uint32_t i = 1; i < 3; ++i)
                    points[borders[s][i]] = numberPoint(cage.sides[f][s].edge, (i == 1) != against ? 0 : 1, object);
            }
        }
        out.objects[object].mesh = mesh.name;
        out.objects[object].transform = Transform();
        out.meshes.push_back(std::move(mesh));
        placed[object] = true;
    }
    Mesh none;
    none.name = "no faces";
    out.meshes.push_back(none);
    for (std::size_t o = 0; o < placed.size(); ++o)
        if (!placed[o]) out.objects[o].mesh = none.name;
    return out;
}

std::vector<MeshPatch> placedPatches(const TableStage& stage) {
    std::vector<MeshPatch> patches;
    patches.reserve(stage.patches);
    for (std::size_t k = 0; k < stage.objects.size(); ++k)
        for (const table_face& face : stage.cages[stage.cageOf[k]].faces) patches.push_back({stage.objects[k].id, face.number});
    return patches;
}

}  // namespace tessera::subdivision
