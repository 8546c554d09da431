#include "surface/patch_source.h"

#include <algorithm>
#include <limits>
#include <string_view>
#include <unordered_map>

#include "device/memory.h"
#include "surface/source_mesh.h"
#include "surface/view_planes.h"
#include "tessera/error.h"

namespace tessera {
namespace {

constexpr std::size_t mostPatches = std::numeric_limits<std::int32_t>::max();
constexpr std::uint64_t mostFloats = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

// An object's patches among all placed ones.
struct PlacedRun {
    const SourceMesh* mesh = nullptr;
    std::uint32_t object = 0;     // index into Scene::objects
    std::uint32_t first = 0;      // its first patch
    std::size_t previous = none;  // the last run before it of the same mesh
};

// What a chunk has of a run: patches [begin, end) of its mesh, of which no run before it in the chunk has [freshBegin, freshEnd).
struct Part {
    const PlacedRun* run = nullptr;
    std::size_t index = 0;    // among the chunk's runs
    std::size_t same = none;  // the first run of the same mesh before it in the chunk, or its last one where that has all of the mesh
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint32_t freshBegin = 0;
    std::uint32_t freshEnd = 0;

    [[nodiscard]] const SourceMesh& mesh() const { return *run->mesh; }
    [[nodiscard]] std::uint32_t records() const { return mesh().recordsBefore(end) - mesh().recordsBefore(begin); }
    [[nodiscard]] std::uint32_t freshRecords() const { return mesh().recordsBefore(freshEnd) - mesh().recordsBefore(freshBegin); }
};

// Where in a chunk's floats a mesh lies: patches from `split` on in one piece, those before it in another.
struct Stored {
    std::uint32_t split = 0;
    std::uint64_t tail = 0;
    std::uint64_t head = 0;
    std::uint64_t tailRecords = 0;
    std::uint64_t headRecords = 0;

    [[nodiscard]] std::uint32_t floatOf(const SourceMesh& mesh, std::uint32_t patch) const {
        const std::uint64_t step = mesh.floatsEach;
        return static_cast<std::uint32_t>(patch < split ? head + patch * step : tail + (patch - split) * step);
    }
    [[nodiscard]] std::uint32_t floatOfRecord(const SourceMesh& mesh, std::uint32_t record) const {
        const std::uint32_t before = mesh.recordsBefore(split);
        const std::uint64_t step = RECORD_FLOATS;
        return static_cast<std::uint32_t>(record < before ? headRecords + record * step : tailRecords + (record - before) * step);
    }
};

template <typename T>
void appendSome(std::vector<T>& to, const std::vector<T>& from, std::uint64_t begin, std::uint64_t end) {
    to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(begin), from.begin() + static_cast<std::ptrdiff_t>(end));
}

// Puts what is fresh of a part into the chunk. Only the first of a chunk's parts can have the end of a mesh alone, and what is missing
// to it then is the mesh's beginning: two pieces always do.
Stored store(const Part& part, const std::vector<Stored>& before, PatchChunk& chunk) {
    const SourceMesh& mesh = part.mesh();
    Stored stored = part.same == none ? Stored{} : before[part.same];
    if (part.freshBegin == part.freshEnd) return stored;
    const std::uint64_t floats = chunk.floats.size();
    const std::uint64_t step = mesh.floatsEach, recordStep = RECORD_FLOATS;
    const std::uint64_t recordFloats = floats + (part.freshEnd - part.freshBegin) * step;
    if (part.same == none) {
        stored = {part.freshBegin, floats, 0, recordFloats, 0};
    } else {
        stored.head = floats;
        stored.headRecords = recordFloats;
    }
    appendSome(chunk.floats, mesh.floats, part.freshBegin * step, part.freshEnd * step);
    appendSome(chunk.floats, mesh.recordFloats, mesh.recordsBefore(part.freshBegin) * recordStep,
               mesh.recordsBefore(part.freshEnd) * recordStep);
    return stored;
}

void place(const Part& part, const Stored& stored, PatchChunk& chunk) {
    const SourceMesh& mesh = part.mesh();
    const auto object = static_cast<std::uint32_t>(part.index);
    for (std::uint32_t patch = part.begin; patch < part.end; ++patch) {
        chunk.placed.push_back(
            {stored.floatOf(mesh, patch), object, patch, mesh.flags[patch], static_cast<std::uint32_t>(chunk.records.size())});
        for (std::uint32_t record = mesh.recordsBefore(patch); record < mesh.recordsBefore(patch + 1); ++record) {
            edge_info& info = chunk.records.emplace_back(mesh.records[record]);
            info.first_float = stored.floatOfRecord(mesh, record);
            info.object = object;
        }
    }
    chunk.objects.push_back(part.run->object);
}

std::uint64_t deviceBytes(std::uint64_t count, std::uint64_t each) { return DeviceMemory::bytesFor(count * each); }

}  // namespace

struct PatchSource::Data {
    std::string sceneName;
    std::vector<std::shared_ptr<const SourceMesh>> meshes;
    std::vector<PlacedRun> runs;  // of at least one patch each, in the order of placed patches
    std::uint32_t bezierPatches = 0;
    std::uint32_t gregoryEnd = 0;
    std::uint32_t rationalEnd = 0;
    std::uint32_t patches = 0;

    // Appends the runs of all objects whose mesh is of `kind`; returns how many patches there are now.
    std::uint32_t appendRuns(const std::vector<const SourceMesh*>& meshOf, PatchKind kind);
    // Calls take(Part) for each run that has patches of [first, end), in order, until it returns false.
    template <typename Take>
    void forParts(std::uint32_t first, std::uint32_t end, const Take& take) const;
};

std::uint32_t PatchSource::Data::appendRuns(const std::vector<const SourceMesh*>& meshOf, PatchKind kind) {
    std::unordered_map<const SourceMesh*, std::size_t> last;
    for (std::size_t object = 0; object < meshOf.size(); ++object) {
        const SourceMesh* const mesh = meshOf[object];
        if (mesh->kind != kind || mesh->patches == 0) continue;
        const auto [same, isNew] = last.try_emplace(mesh, none);
        runs.push_back({mesh, static_cast<std::uint32_t>(object), patches, same->second});
        same->second = runs.size() - 1;
        patches += mesh->patches;
    }
    return patches;
}

template <typename Take>
void PatchSource::Data::forParts(std::uint32_t first, std::uint32_t end, const Take& take) const {
    if (first >= end) return;
    const auto behind =
        std::upper_bound(runs.begin(), runs.end(), first, [](std::uint32_t patch, const PlacedRun& run) { return patch < run.first; });
    const auto firstRun = static_cast<std::size_t>(behind - runs.begin()) - 1;
    for (std::size_t r = firstRun; r < runs.size() && runs[r].first < end; ++r) {
        const PlacedRun& run = runs[r];
        Part part{&run, r - firstRun, none, std::max(first, run.first) - run.first, std::min(end - run.first, run.mesh->patches), 0, 0};
        part.freshBegin = part.begin;
        part.freshEnd = part.end;
        if (run.previous != none && run.previous >= firstRun) {
            part.same = run.previous - firstRun;
            // The chunk's first run has its mesh from some patch on; any other before this one has all of it.
            const std::uint32_t missing = part.same == 0 ? first - runs[firstRun].first : 0;
            part.freshEnd = std::min(part.end, missing);
        }
        if (!take(part)) return;
    }
}

std::uint64_t ChunkSize::inputBytes(bool dicingApart) const {
    return deviceBytes(floats, sizeof(float)) + deviceBytes(patches, sizeof(placed_patch)) + deviceBytes(records, sizeof(edge_info)) +
           (dicingApart ? 2 : 1) * deviceBytes(objects, sizeof(placed_object));
}

std::uint64_t ChunkSize::placedBytes(bool dicingApart) const {
    return (dicingApart ? 2 : 1) * deviceBytes(eyeFloats, sizeof(float)) + deviceBytes(patches, sizeof(patch_box)) +
           deviceBytes(patches, sizeof(std::uint32_t));
}

std::uint64_t ChunkSize::largestBuffer() const {
    return std::max({deviceBytes(floats, sizeof(float)), deviceBytes(patches, sizeof(placed_patch)),
                     deviceBytes(records, sizeof(edge_info)), deviceBytes(objects, sizeof(placed_object)),
                     deviceBytes(eyeFloats, sizeof(float))});
}

PatchSource::PatchSource() : data_(std::make_shared<const Data>()) {}

PatchSource::PatchSource(const Scene& scene) {
    if (scene.placedPatchCount() > mostPatches)
        throw Error(scene.name + ": more than 2147483647 patches over all objects; leave some objects out");
    auto data = std::make_shared<Data>();
    data->sceneName = scene.name;
    std::unordered_map<std::string_view, std::size_t> byName;
    for (const Mesh& mesh : scene.meshes) {
        byName.emplace(mesh.name, data->meshes.size());
        data->meshes.push_back(std::make_shared<const SourceMesh>(mesh));
    }
    std::vector<const SourceMesh*> meshOf;
    meshOf.reserve(scene.objects.size());
    for (const Object& object : scene.objects) meshOf.push_back(data->meshes[byName.at(object.mesh)].get());
    data->bezierPatches = data->appendRuns(meshOf, PatchKind::bezier);
    data->gregoryEnd = data->appendRuns(meshOf, PatchKind::gregory);
    data->rationalEnd = data->appendRuns(meshOf, PatchKind::rational);
    data->appendRuns(meshOf, PatchKind::pn);
    data_ = std::move(data);
}

std::uint32_t PatchSource::patches() const { return data_->patches; }

std::uint32_t PatchSource::gregoryEnd() const { return data_->gregoryEnd; }

ChunkSize PatchSource::sizeOf(std::uint32_t first, std::uint32_t end) const {
    ChunkSize size;
    data_->forParts(first, end, [&](const Part& part) {
        const std::uint64_t patches = part.end - part.begin, fresh = part.freshEnd - part.freshBegin;
        size.patches += patches;
        size.floats += fresh * part.mesh().floatsEach + std::uint64_t{RECORD_FLOATS} * part.freshRecords();
        size.eyeFloats += patches * part.mesh().eyeFloatsEach() + std::uint64_t{RECORD_FLOATS} * part.records();
        size.records += part.records();
        ++size.objects;
        return true;
    });
    return size;
}

ChunkSize PatchSource::largest(std::uint32_t patchesEach) const {
    ChunkSize most;
    for (std::uint64_t first = 0; first < patches(); first += patchesEach) {
        const auto end = static_cast<std::uint32_t>(std::min<std::uint64_t>(first + patchesEach, patches()));
        const ChunkSize size = sizeOf(static_cast<std::uint32_t>(first), end);
        most = {std::max(most.patches, size.patches), std::max(most.floats, size.floats), std::max(most.eyeFloats, size.eyeFloats),
                std::max(most.records, size.records), std::max(most.objects, size.objects)};
    }
    return most;
}

void PatchSource::gather(std::uint32_t first, std::uint32_t end, PatchChunk& chunk) const {
    const ChunkSize size = sizeOf(first, end);
    if (size.floats > mostFloats) {
        throw Error(data_->sceneName + ": " + std::to_string(size.patches) +
                    " patches have more control points than a device can index at once; use a smaller --memory or split the scene");
    }
    const auto within = [&](std::uint32_t kindEnd) { return std::clamp(kindEnd, first, end) - first; };
    chunk.first = first;
    chunk.patches = end - first;
    chunk.bezierPatches = within(data_->bezierPatches);
    chunk.gregoryEnd = within(data_->gregoryEnd);
    chunk.rationalEnd = within(data_->rationalEnd);
    chunk.floats.clear();
    chunk.placed.clear();
    chunk.records.clear();
    chunk.objects.clear();
    chunk.floats.reserve(size.floats);
    chunk.placed.reserve(size.patches);
    chunk.records.reserve(size.records);
    chunk.objects.reserve(size.objects);
    std::vector<Stored> stored;
    stored.reserve(size.objects);
    data_->forParts(first, end, [&](const Part& part) {
        stored.push_back(store(part, stored, chunk));
        place(part, stored.back(), chunk);
        return true;
    });
}

PatchSource PatchSource::withMesh(std::size_t index, const Mesh& mesh) const {
    auto data = std::make_shared<Data>(*data_);
    const SourceMesh* const old = data_->meshes[index].get();
    data->meshes[index] = std::make_shared<const SourceMesh>(mesh);
    for (PlacedRun& run : data->runs)
        if (run.mesh == old) run.mesh = data->meshes[index].get();
    PatchSource source;
    source.data_ = std::move(data);
    return source;
}

PatchSource::MeshFloats PatchSource::meshFloats(std::size_t index) const {
    const SourceMesh* const wanted = data_->meshes[index].get();
    MeshFloats found;
    data_->forParts(0, patches(), [&](const Part& part) {
        if (part.run->mesh == wanted) {
            found.floats = wanted->floats;
            return false;
        }
        found.first +=
            std::uint64_t{part.freshEnd - part.freshBegin} * part.mesh().floatsEach + std::uint64_t{RECORD_FLOATS} * part.freshRecords();
        return true;
    });
    return found;
}

std::span<const std::uint8_t> PatchSource::meshFlags(std::size_t index) const { return data_->meshes[index]->flags; }

void PatchSource::forPatches(std::uint32_t first, std::uint32_t end, const std::function<void(std::uint32_t, std::uint32_t)>& take) const {
    data_->forParts(first, end, [&](const Part& part) {
        for (std::uint32_t patch = part.begin; patch < part.end; ++patch) take(part.run->object, patch);
        return true;
    });
}

bool PatchSource::mayShow(std::uint32_t first, std::uint32_t end, const frame_params& frame, std::span<const placed_object> placed) const {
    bool may = false;
    data_->forParts(first, end, [&](const Part& part) {
        const ViewPlanes planes(frame, placed[part.run->object]);
        const std::uint32_t behind = (part.end + SourceMesh::boxPatches - 1) / SourceMesh::boxPatches;
        for (std::uint32_t box = part.begin / SourceMesh::boxPatches; box < behind && !may; ++box)
            may = planes.mayShow(part.mesh().boxes[box]);
        return !may;
    });
    return may;
}

}  // namespace tessera
