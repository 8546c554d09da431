#include "surface/patch_set.h"

#include <limits>
#include <string_view>
#include <unordered_map>

#include "tessera/error.h"

namespace tessera {
namespace {

constexpr std::size_t mostPatches = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t mostPoints = std::numeric_limits<std::uint32_t>::max() / 3;

// Where each object's mesh begins among the points; meshes shared by objects stand once.
struct GatheredMeshes {
    struct Place {
        const Mesh* mesh = nullptr;
        std::uint32_t firstPoint = 0;
    };
    std::vector<glm::vec3> points;
    std::vector<Place> ofObject;
};

GatheredMeshes gatherMeshes(const Scene& scene) {
    std::unordered_map<std::string_view, const Mesh*> byName;
    for (const Mesh& mesh : scene.meshes) byName.emplace(mesh.name, &mesh);
    std::unordered_map<const Mesh*, std::uint32_t> first;
    GatheredMeshes gathered;
    for (const Object& object : scene.objects) {
        const Mesh* const mesh = byName.at(object.mesh);
        const auto [place, isNew] = first.emplace(mesh, static_cast<std::uint32_t>(gathered.points.size()));
        gathered.ofObject.push_back({mesh, place->second});
        if (!isNew) continue;
        if (gathered.points.size() + mesh->points.size() > mostPoints)
            throw Error(scene.name + ": more control points than a device can index; split the scene");
        gathered.points.insert(gathered.points.end(), mesh->points.begin(), mesh->points.end());
    }
    return gathered;
}

// Appends the patches of all objects whose mesh is of `kind`.
void placeKind(const GatheredMeshes& gathered, PatchKind kind, std::vector<placed_patch>& placed) {
    const auto step = static_cast<std::uint32_t>(pointsPerPatch(kind));
    for (std::size_t k = 0; k < gathered.ofObject.size(); ++k) {
        const auto [mesh, firstPoint] = gathered.ofObject[k];
        if (mesh->kind != kind) continue;
        for (std::uint32_t i = 0; i < mesh->patchCount(); ++i) placed.push_back({firstPoint + i * step, static_cast<std::uint32_t>(k), i});
    }
}

}  // namespace

PatchSet uploadPatches(const Scene& scene, DeviceMemory& memory, Timeline& timeline) {
    if (scene.placedPatchCount() > mostPatches) throw Error(scene.name + ": more than 2147483647 patches");
    const GatheredMeshes gathered = gatherMeshes(scene);
    std::vector<placed_patch> placed;
    placed.reserve(scene.placedPatchCount());
    PatchSet set;
    placeKind(gathered, PatchKind::bezier, placed);
    set.bezierPatches = static_cast<std::uint32_t>(placed.size());
    placeKind(gathered, PatchKind::gregory, placed);
    set.patches = static_cast<std::uint32_t>(placed.size());
    set.points = memory.allocate("the scene's control points", gathered.points.size() * sizeof(glm::vec3), CL_MEM_READ_ONLY);
    set.placed = memory.allocate("the scene's patches", placed.size() * sizeof(placed_patch), CL_MEM_READ_ONLY);
    set.eyePoints = memory.allocate("the patches in eye space", PatchSet::eyeBytes(set.bezierPatches, set.patches - set.bezierPatches));
    if (!placed.empty()) {
        timeline.write(set.points.cl(), gathered.points.data(), gathered.points.size() * sizeof(glm::vec3));
        timeline.write(set.placed.cl(), placed.data(), placed.size() * sizeof(placed_patch));
    }
    return set;
}

}  // namespace tessera
