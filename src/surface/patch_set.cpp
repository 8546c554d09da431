#include "surface/patch_set.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <unordered_map>

#include "tessera/error.h"

namespace tessera {
namespace {

constexpr std::size_t mostPatches = std::numeric_limits<std::int32_t>::max();
constexpr std::size_t mostFloats = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t rationalFloats = 4 * 16 + 4 * 3;  // homogeneous points, then the corners

std::size_t uploadedFloats(PatchKind kind) { return kind == PatchKind::rational ? rationalFloats : 3 * pointsPerPatch(kind); }

// Where each object's mesh begins among the floats; meshes shared by objects stand once.
struct GatheredMeshes {
    struct Place {
        const Mesh* mesh = nullptr;
        std::uint32_t firstFloat = 0;
        std::uint32_t firstRecord = 0;  // of the mesh's edge records: 16 floats each
    };
    std::vector<float> floats;
    std::vector<Place> ofObject;
};

void append(std::vector<float>& floats, const glm::vec3& p) { floats.insert(floats.end(), {p.x, p.y, p.z}); }

void appendHomogeneous(std::vector<float>& floats, const glm::vec3& p, float w) {
    append(floats, w * p);
    floats.push_back(w);
}

void appendMesh(std::vector<float>& floats, const Mesh& mesh) {
    if (mesh.kind != PatchKind::rational) {
        for (const glm::vec3& point : mesh.points) append(floats, point);
        return;
    }
    for (std::size_t patch = 0; patch < mesh.patchCount(); ++patch) {
        for (std::size_t k = 16 * patch; k < 16 * patch + 16; ++k) appendHomogeneous(floats, mesh.points[k], mesh.weights[k]);
        for (const std::size_t corner : {0U, 3U, 12U, 15U}) append(floats, mesh.points[16 * patch + corner]);
    }
}

GatheredMeshes gatherMeshes(const Scene& scene) {
    std::unordered_map<std::string_view, const Mesh*> byName;
    for (const Mesh& mesh : scene.meshes) byName.emplace(mesh.name, &mesh);
    std::unordered_map<const Mesh*, GatheredMeshes::Place> first;
    GatheredMeshes gathered;
    for (const Object& object : scene.objects) {
        const Mesh* const mesh = byName.at(object.mesh);
        const auto [place, isNew] = first.emplace(mesh, GatheredMeshes::Place{mesh, static_cast<std::uint32_t>(gathered.floats.size()), 0});
        if (isNew) {
            const std::size_t more = mesh->patchCount() * uploadedFloats(mesh->kind) + RECORD_FLOATS * mesh->edges.size();
            if (gathered.floats.size() + more > mostFloats)
                throw Error(scene.name + ": more control points than a device can index; split the scene");
            appendMesh(gathered.floats, *mesh);
            place->second.firstRecord = static_cast<std::uint32_t>(gathered.floats.size());
            for (const EdgeRecord& edge : mesh->edges)
                for (std::size_t k = 0; k < 4; ++k) appendHomogeneous(gathered.floats, edge.points[k], edge.weights[k]);
        }
        gathered.ofObject.push_back(place->second);
    }
    return gathered;
}

using Border = std::array<std::size_t, 4>;

// The control points of a patch's sides, in the order of EdgeRecord::side.
std::array<Border, 4> bordersOf(PatchKind kind) {
    if (kind == PatchKind::gregory) return {{{0, 4, 9, 1}, {1, 5, 10, 2}, {3, 11, 6, 2}, {0, 8, 7, 3}}};
    if (kind == PatchKind::pn) return {{{0, 1, 2, 3}, {3, 6, 8, 9}, {9, 9, 9, 9}, {0, 4, 7, 9}}};
    return {{{0, 1, 2, 3}, {3, 7, 11, 15}, {12, 13, 14, 15}, {0, 4, 8, 12}}};
}

std::uint32_t degenerateSides(const Mesh& mesh, std::size_t patch) {
    const std::array<Border, 4> borders = bordersOf(mesh.kind);
    const glm::vec3* const points = mesh.points.data() + patch * pointsPerPatch(mesh.kind);
    std::uint32_t flags = 0;
    for (std::size_t side = 0; side < 4; ++side) {
        if (mesh.kind == PatchKind::pn && side == 2) continue;
        const Border& b = borders[side];
        const bool onePoint = std::all_of(b.begin(), b.end(), [&](std::size_t k) { return points[k] == points[b[0]]; });
        if (onePoint) flags |= SIDE_DEGENERATE << side;
    }
    return flags;
}

// Patches and records of all objects, as the device takes them.
struct Placed {
    std::vector<placed_patch> patches;
    std::vector<edge_info> records;
};

void placeRecord(const EdgeRecord& edge, std::uint32_t firstFloat, std::uint32_t object, Placed& placed) {
    const bool rational = std::any_of(edge.weights.begin(), edge.weights.end(), [](float w) { return w != 1.0F; });
    placed.records.push_back({firstFloat, object, edge.level, edge.index, edge.reversed ? 1U : 0U, rational ? 1U : 0U, edge.cuts});
}

void placeObject(const GatheredMeshes::Place& place, std::uint32_t object, Placed& placed) {
    const Mesh& mesh = *place.mesh;
    const auto step = static_cast<std::uint32_t>(uploadedFloats(mesh.kind));
    std::size_t edge = 0;
    for (std::uint32_t i = 0; i < mesh.patchCount(); ++i) {
        placed_patch patch{place.firstFloat + i * step, object, i, degenerateSides(mesh, i),
                           static_cast<std::uint32_t>(placed.records.size())};
        for (; edge < mesh.edges.size() && mesh.edges[edge].patch == i; ++edge) {
            patch.flags |= SIDE_RECORDED << mesh.edges[edge].side;
            placeRecord(mesh.edges[edge], place.firstRecord + static_cast<std::uint32_t>(RECORD_FLOATS * edge), object, placed);
        }
        placed.patches.push_back(patch);
    }
}

// Appends the patches of all objects whose mesh is of `kind`; returns how many patches there are now.
std::uint32_t placeKind(const GatheredMeshes& gathered, PatchKind kind, Placed& placed) {
    for (std::size_t k = 0; k < gathered.ofObject.size(); ++k) {
        if (gathered.ofObject[k].mesh->kind == kind) placeObject(gathered.ofObject[k], static_cast<std::uint32_t>(k), placed);
    }
    return static_cast<std::uint32_t>(placed.patches.size());
}

}  // namespace

std::uint64_t PatchSet::eyeBytes() const {
    const std::uint64_t floats = std::uint64_t{bezierPatches} * BEZIER_FLOATS + std::uint64_t{gregoryEnd - bezierPatches} * GREGORY_FLOATS +
                                 std::uint64_t{rationalEnd - gregoryEnd} * RATIONAL_FLOATS +
                                 std::uint64_t{patches - rationalEnd} * PN_FLOATS + std::uint64_t{recordCount} * RECORD_FLOATS;
    return floats * sizeof(float);
}

PatchSet uploadPatches(const Scene& scene, DeviceMemory& memory, Timeline& timeline) {
    if (scene.placedPatchCount() > mostPatches) throw Error(scene.name + ": more than 2147483647 patches");
    const GatheredMeshes gathered = gatherMeshes(scene);
    Placed placed;
    placed.patches.reserve(scene.placedPatchCount());
    PatchSet set;
    set.bezierPatches = placeKind(gathered, PatchKind::bezier, placed);
    set.gregoryEnd = placeKind(gathered, PatchKind::gregory, placed);
    set.rationalEnd = placeKind(gathered, PatchKind::rational, placed);
    set.patches = placeKind(gathered, PatchKind::pn, placed);
    set.recordCount = static_cast<std::uint32_t>(placed.records.size());
    const std::size_t pointBytes = gathered.floats.size() * sizeof(float);
    const std::size_t placedBytes = placed.patches.size() * sizeof(placed_patch);
    const std::size_t recordBytes = placed.records.size() * sizeof(edge_info);
    set.points = memory.allocate("the scene's control points", pointBytes, CL_MEM_READ_ONLY);
    set.placed = memory.allocate("the scene's patches", placedBytes, CL_MEM_READ_ONLY);
    set.records = memory.allocate("the scene's edge records", recordBytes, CL_MEM_READ_ONLY);
    set.eyePoints = memory.allocate("the patches in eye space", set.eyeBytes());
    if (pointBytes > 0) timeline.write(set.points.cl(), gathered.floats.data(), pointBytes);
    if (placedBytes > 0) timeline.write(set.placed.cl(), placed.patches.data(), placedBytes);
    if (recordBytes > 0) timeline.write(set.records.cl(), placed.records.data(), recordBytes);
    return set;
}

void enqueuePlace(DeviceSession& session, const frame_params& frame, const PatchSet& patches, const cl::Buffer& objects,
                  const cl::Buffer& eyePoints) {
    // A work-item a patch in turn; 64 a group on every device.
    const auto groups = [&](std::uint32_t items) { return std::min<std::size_t>((items + 63) / 64, session.device.shape.groups); };
    Kernels& kernels = session.kernels;
    if (patches.patches > 0) {
        session.timeline.launch(kernels.with("place_patches", frame, patches.points.cl(), patches.placed.cl(), objects, eyePoints),
                                "place_patches", groups(patches.patches), 64);
    }
    if (patches.recordCount > 0) {
        session.timeline.launch(
            kernels.with("place_records", frame, patches.recordCount, patches.points.cl(), patches.records.cl(), objects, eyePoints),
            "place_records", groups(patches.recordCount), 64);
    }
}

}  // namespace tessera
