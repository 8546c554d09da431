#include "surface/patch_set.h"

#include <limits>
#include <unordered_map>

#include "tessera/error.h"

namespace tessera {
namespace {

constexpr std::size_t mostPatches = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t mostPoints = std::numeric_limits<std::uint32_t>::max() / 3;

struct MeshPoints {
    std::vector<glm::vec3> points;
    std::unordered_map<const Mesh*, std::uint32_t> first;  // of each mesh in `points`
};

MeshPoints gatherPoints(const Scene& scene) {
    MeshPoints gathered;
    for (const Object& object : scene.objects) {
        const Mesh* const mesh = scene.findMesh(object.mesh);
        if (gathered.first.contains(mesh)) continue;
        if (gathered.points.size() + mesh->points.size() > mostPoints)
            throw Error(scene.name + ": more control points than a device can index");
        gathered.first[mesh] = static_cast<std::uint32_t>(gathered.points.size());
        gathered.points.insert(gathered.points.end(), mesh->points.begin(), mesh->points.end());
    }
    return gathered;
}

// Appends the patches of all objects whose mesh is of `kind`.
void placeKind(const Scene& scene, const MeshPoints& gathered, PatchKind kind, std::vector<std::uint32_t>& firstPatch,
               std::vector<placed_patch>& placed) {
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
        const Mesh* const mesh = scene.findMesh(scene.objects[k].mesh);
        if (mesh->kind != kind) continue;
        firstPatch[k] = static_cast<std::uint32_t>(placed.size());
        const std::uint32_t first = gathered.first.at(mesh);
        const auto step = static_cast<std::uint32_t>(pointsPerPatch(kind));
        for (std::uint32_t i = 0; i < mesh->patchCount(); ++i) placed.push_back({first + i * step, static_cast<std::uint32_t>(k), i});
    }
}

}  // namespace

PatchSet uploadPatches(const Scene& scene, DeviceMemory& memory, Timeline& timeline) {
    if (scene.placedPatchCount() > mostPatches) throw Error(scene.name + ": more than 2147483647 patches");
    const MeshPoints gathered = gatherPoints(scene);
    std::vector<placed_patch> placed;
    placed.reserve(scene.placedPatchCount());
    PatchSet set;
    set.firstPatch.resize(scene.objects.size());
    placeKind(scene, gathered, PatchKind::bezier, set.firstPatch, placed);
    set.bezierPatches = static_cast<std::uint32_t>(placed.size());
    placeKind(scene, gathered, PatchKind::gregory, set.firstPatch, placed);
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
