// A tessellation's course: measured once, then made at once in the buffers or piece by piece, chunk after chunk.
#include "mesh/mesh_job.h"

#include <algorithm>
#include <array>
#include <bit>
#include <initializer_list>
#include <limits>
#include <utility>

#include "mesh/mesh_pieces.h"
#include "mesh/orientation.h"
#include "scene/validate.h"
#include "tessera/error.h"

namespace tessera {
namespace {

// Vertices of a piece at most, where a unit has no more: some 64 MB of mesh, after which progress is told.
constexpr std::uint64_t pieceVertices = std::uint64_t{1} << 20;
// Of a stream's work, what measuring is shown as.
constexpr double measureShare = 0.1;

// A buffer as the host sees it, while this lives.
class Mapped {
public:
    Mapped(Timeline& timeline, const cl::Buffer& buffer, std::size_t bytes)
        : timeline_(timeline), buffer_(buffer), at_(bytes > 0 ? timeline.map(buffer, bytes) : nullptr) {}
    ~Mapped() {
        try {
            if (at_ != nullptr) timeline_.unmap(buffer_, at_);
        } catch (const cl::Error&) {
            // The device is gone; the next command tells.
        }
    }
    Mapped(const Mapped&) = delete;
    Mapped& operator=(const Mapped&) = delete;

    template <typename T>
    [[nodiscard]] std::span<const T> as(std::uint64_t count) const {
        return at_ == nullptr ? std::span<const T>() : std::span<const T>(static_cast<const T*>(at_), count);
    }

private:
    Timeline& timeline_;
    const cl::Buffer& buffer_;
    void* at_;
};

std::array<std::uint32_t, sizeof(mesh_view) / 4> bitsOf(const mesh_view& view) {
    return std::bit_cast<std::array<std::uint32_t, sizeof(mesh_view) / 4>>(view);
}

double sumOf(const std::map<std::string, double>& kernelMs, std::initializer_list<const char*> names) {
    double sum = 0;
    for (const char* name : names) {
        const auto found = kernelMs.find(name);
        if (found != kernelMs.end()) sum += found->second;
    }
    return sum;
}

}  // namespace

MeshJob::MeshJob(const RendererSettings& settings)
    : session_(settings.device, kernelSources(), cacheFolder(settings.cacheKernels, settings.cacheFolder), settings.lanes,
               meshKernelFiles()),
      stream_(session_),
      tables_(session_) {
    statistics_.device = session_.device.info.name;
    statistics_.buildMs = session_.kernels.buildMilliseconds();
}

void MeshJob::forget() {
    measured_ = Measured();
    tabled_ = 0;
}

void MeshJob::setScene(const Scene& scene, Orientation orientation) {
    forget();
    stream_.setSource(PatchSource(scene));
    scene_ = scene;
    reach_ = SceneReach(scene_);
    objects_ = worldObjects(scene_);
    turned_ = DeviceBuffer();
    if (orientation == Orientation::asGiven)
        turnedBits_.assign((std::size_t{stream_.source().patches()} + 31) / 32, 0);
    else
        turnedBits_ = turnedPatches(scene_);
}

void MeshJob::replacePoints(std::size_t mesh, std::span<const glm::vec3> points) {
    if (mesh >= scene_.meshes.size()) {
        throw Error(scene_.name + ": there is no mesh " + std::to_string(mesh) + " to replace points of; it has " +
                    std::to_string(scene_.meshes.size()));
    }
    Mesh& old = scene_.meshes[mesh];
    const std::string where = scene_.name + ": mesh '" + old.name + "'";
    if (!old.edges.empty()) throw Error(where + " has edge records, which its points can't leave; set the scene anew");
    if (points.size() != old.points.size()) {
        throw Error(where + " has " + std::to_string(old.points.size()) + " points, but " + std::to_string(points.size()) +
                    " are given; give as many");
    }
    Mesh changed = old;
    changed.points.assign(points.begin(), points.end());
    validatePoints(changed, where);
    forget();
    stream_.replaceMesh(mesh, changed);
    old = std::move(changed);
    reach_.update(scene_, mesh);
}

bool MeshJob::prepare(const TessellateOptions& options) {
    const mesh_view view = setUpView(options, scene_.name, reach_.greatest(scene_));
    const bool same = bitsOf(view) == bitsOf(measured_.view) && options.memoryBytes == measured_.memoryBytes &&
                      options.positionsOnly == measured_.positionsOnly;
    if (measured_.valid && same) return true;
    forget();
    const DeviceInfo& info = session_.device.info;
    const std::uint64_t budget = std::min(options.memoryBytes == 0 ? defaultBudget(info) : options.memoryBytes, info.globalBytes);
    measured_.view = view;
    measured_.memoryBytes = options.memoryBytes;
    measured_.positionsOnly = options.positionsOnly;
    measured_.plan = planMesh(stream_.source(), scene_.name, budget, info.maxAllocationBytes, options.positionsOnly);
    // Buffers of an earlier budget must not stand in the way.
    if (vertices_.bytes() + indices_.bytes() > measured_.plan.meshRoom()) {
        vertices_ = DeviceBuffer();
        indices_ = DeviceBuffer();
    }
    session_.memory.setBudget(budget);
    tables_.release();
    stream_.reserve(measured_.plan.patchesEach, false);
    tables_.reserve(measured_.plan.patchesEach);
    const std::size_t turnedBytes = turnedBits_.size() * sizeof(std::uint32_t);
    if (session_.memory.ensure(turned_, Purpose::scene, "which patches are turned", turnedBytes, CL_MEM_READ_ONLY) && turnedBytes > 0)
        session_.timeline.write(turned_.cl(), turnedBits_.data(), turnedBytes);
    session_.memory.restartPeak();
    return false;
}

void MeshJob::start() {
    session_.timeline.restart(false);
    stream_.beginFrame(objects_, {});
    statistics_.pieces = 0;
    statistics_.tessellateMs = 0;
    statistics_.chunks = stream_.chunks();
}

void MeshJob::finish(Clock::time_point began) {
    session_.timeline.finish();
    MeshStatistics& s = statistics_;
    s.kernelMs = session_.timeline.milliseconds();
    s.placeMs = sumOf(s.kernelMs, {"place_patches", "place_records"});
    s.factorsMs = sumOf(s.kernelMs, {"mesh_factors"});
    s.offsetsMs = sumOf(s.kernelMs, {"mesh_sums", "mesh_scan", "mesh_offsets"});
    s.vertexMs = sumOf(s.kernelMs, {"mesh_vertices"});
    s.indexMs = sumOf(s.kernelMs, {"mesh_indices"});
    s.tessellateMs += std::chrono::duration<double, std::milli>(Clock::now() - began).count();
    s.sizes = measured_.sizes;
    s.deviceBytesBudget = measured_.plan.budget;
    s.deviceBytesPeak = session_.memory.peakBytes();
}

const PatchSet& MeshJob::useChunk(std::uint32_t chunk) {
    const PatchSet& patches = stream_.use(chunk, frame_, Placing::toShade);
    if (tabled_ != chunk + 1) {
        mesh_view view = measured_.view;
        view.patches = patches.patches;
        view.first_patch = patches.first;
        tables_.enqueue(frame_, view, patches, turned_.cl());
        tabled_ = chunk + 1;
    }
    return patches;
}

void MeshJob::addTotals(const PatchSet& patches, const mesh_totals& totals) {
    if (totals.refused > 0) {
        std::string where;
        const auto first = patches.first + static_cast<std::uint32_t>(totals.first_refused);
        stream_.source().forPatches(first, first + 1, [&](std::uint32_t object, std::uint32_t patch) {
            where = "object '" + scene_.objects[object].name + "', patch " + std::to_string(patch);
        });
        throw Error(scene_.name + ": " + where + ": so small a tolerance takes more than " + std::to_string(MESH_RATE_MOST) +
                    " segments along a side; give a larger one");
    }
    MeshSizes& sizes = measured_.sizes;
    sizes.patches += patches.patches;
    if (measured_.view.cull != 0) sizes.patchesCulled += totals.nothing;
    sizes.units += totals.sum.units;
    sizes.vertices += totals.sum.vertices;
    sizes.distinctVertices += totals.distinct;
    sizes.triangles += totals.sum.triangles;
    sizes.vertexBytes = sizes.vertices * measured_.plan.vertexBytes;
    sizes.indexBytes = sizes.triangles * 3 * sizeof(std::uint32_t);
    measured_.chunks.push_back(totals);
}

void MeshJob::measureChunks(const std::function<void(std::uint32_t, const PatchSet&)>& each) {
    measured_.sizes = MeshSizes();
    measured_.chunks.clear();
    for (std::uint32_t chunk = 0; chunk < stream_.chunks(); ++chunk) {
        const PatchSet& patches = useChunk(chunk);
        stream_.prefetch(chunk + 1);
        addTotals(patches, tables_.totals());
        if (each) each(chunk, patches);
    }
    measured_.valid = true;
}

MeshSizes MeshJob::measure(const TessellateOptions& options, const Progress& progress) {
    const Clock::time_point began = Clock::now();
    if (prepare(options)) return measured_.sizes;
    start();
    measureChunks([&](std::uint32_t chunk, const PatchSet&) {
        if (progress) progress("measure", (chunk + 1.0) / stream_.chunks());
    });
    finish(began);
    return measured_.sizes;
}

void MeshJob::allocateMesh(std::uint64_t vertices, std::uint64_t triangles) {
    const std::uint64_t vertexBytes = vertices * measured_.plan.vertexBytes, indexBytes = triangles * 3 * sizeof(std::uint32_t);
    const std::uint64_t room = measured_.plan.meshRoom();
    // One buffer may be as large as an earlier mesh wanted it, and leave too little for the other.
    if (std::max(vertices_.bytes(), vertexBytes) + std::max(indices_.bytes(), indexBytes) > room) {
        vertices_ = DeviceBuffer();
        indices_ = DeviceBuffer();
    }
    const auto fit = [&](DeviceBuffer& buffer, const DeviceBuffer& other, const char* name, std::uint64_t bytes, std::uint64_t otherBytes) {
        if (buffer.bytes() >= DeviceMemory::bytesFor(bytes)) return;
        // What outgrows its buffer once will do so again, as animated surfaces do.
        const std::uint64_t more = bytes + bytes / 4;
        const bool fits = more + std::max(other.bytes(), otherBytes) <= room && more <= session_.device.info.maxAllocationBytes;
        session_.memory.ensure(buffer, Purpose::picture, name, buffer.bytes() > 0 && fits ? more : bytes);
    };
    fit(vertices_, indices_, "the mesh's vertices", vertexBytes, indexBytes);
    fit(indices_, vertices_, "the mesh's indices", indexBytes, vertexBytes);
}

// A larger budget makes for larger chunks, so that more than the difference may be wanted.
std::uint64_t MeshJob::budgetFor(std::uint64_t meshBytes) const {
    const std::uint64_t largestBuffer = session_.device.info.maxAllocationBytes;
    MeshPlan plan = measured_.plan;
    std::uint64_t budget = plan.budget;
    while (plan.meshRoom() < meshBytes) {
        budget = plan.patchBytes + meshBytes;
        plan = planMesh(stream_.source(), scene_.name, budget, largestBuffer, measured_.positionsOnly);
    }
    return budget;
}

void MeshJob::enqueuePiece(const PatchSet& patches, const mesh_piece& piece) {
    session_.launch(session_.kernels.with("mesh_vertices", frame_, piece, tables_.offsets(), tables_.patterns(), patches.eyePoints.cl(),
                                          patches.placed.cl(), patches.records.cl(), patches.objects.cl(), vertices_.cl()),
                    "mesh_vertices");
    session_.launch(session_.kernels.with("mesh_indices", piece, tables_.offsets(), tables_.patterns(), indices_.cl()), "mesh_indices");
    ++statistics_.pieces;
}

// All units of all chunks into one buffer: what a chunk's numbers begin with is taken off, modulo 2^64.
void MeshJob::makeOnDevice() {
    std::uint64_t vertices = 0, triangles = 0;
    for (std::uint32_t chunk = 0; chunk < stream_.chunks(); ++chunk) {
        const PatchSet& patches = useChunk(chunk);
        stream_.prefetch(chunk + 1);
        const mesh_offset& sum = measured_.chunks[chunk].sum;
        if (sum.units > 0)
            enqueuePiece(patches, {patches.patches, measured_.positionsOnly ? 1U : 0U, 0, sum.units, 0 - vertices, 0 - triangles});
        vertices += sum.vertices;
        triangles += sum.triangles;
    }
}

DeviceMesh MeshJob::tessellate(const TessellateOptions& options) {
    (void)measure(options, {});
    const Clock::time_point began = Clock::now();
    if (measured_.used) start();
    const MeshSizes& sizes = measured_.sizes;
    if (sizes.vertices > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(scene_.name + ": the mesh has " + std::to_string(sizes.vertices) +
                    " vertices, more than 32-bit indices can tell apart; give a larger tolerance, or stream it");
    }
    const std::uint64_t bytes = sizes.vertexBytes + sizes.indexBytes;
    if (bytes > measured_.plan.meshRoom()) {
        throw Error(scene_.name + ": the mesh takes " + bytesText(bytes) + " on the device, but the budget leaves " +
                    bytesText(measured_.plan.meshRoom()) + "; give a larger tolerance or " + bytesText(budgetFor(bytes)) +
                    " of memory, or stream it");
    }
    allocateMesh(sizes.vertices, sizes.triangles);
    makeOnDevice();
    measured_.used = true;
    finish(began);
    return {session_.device.context(), session_.device.queue(), vertices_.cl()(), indices_.cl()(), sizes};
}

void MeshJob::handPiece(std::span<const MeshUnit> units, std::uint64_t vertices, std::uint64_t triangles, MeshSink& sink) {
    const Mapped vertexData(session_.timeline, vertices_.cl(), vertices * measured_.plan.vertexBytes);
    const Mapped indexData(session_.timeline, indices_.cl(), triangles * 3 * sizeof(std::uint32_t));
    MeshPiece piece;
    piece.units = units;
    if (measured_.positionsOnly)
        piece.positions = vertexData.as<float>(3 * vertices);
    else
        piece.vertices = vertexData.as<MeshVertex>(vertices);
    piece.indices = indexData.as<std::uint32_t>(3 * triangles);
    sink.take(piece);
}

void MeshJob::streamChunk(std::uint32_t chunk, std::span<const mesh_pattern> patterns, MeshSink& sink,
                          const std::function<void(std::uint64_t)>& done) {
    const PatchSet& patches = useChunk(chunk);
    stream_.prefetch(chunk + 1);
    std::vector<mesh_offset> offsets(patterns.size() + 1);
    tables_.readOffsets(patches.patches, offsets.data());
    PieceCutter cutter(patterns, offsets);
    PieceUnits piece;
    const std::uint64_t room = std::min(measured_.plan.roomVertices, std::max(pieceVertices, mostUnitVertices()));
    while (cutter.next(room, piece)) {
        allocateMesh(piece.vertices, piece.triangles);
        enqueuePiece(patches, {patches.patches, measured_.positionsOnly ? 1U : 0U, piece.firstUnit, piece.units.size(), piece.firstVertex,
                               piece.firstTriangle});
        for (MeshUnit& unit : piece.units) unit.patch += patches.first;
        handPiece(piece.units, piece.vertices, piece.triangles, sink);
        done(piece.triangles);
    }
}

void MeshJob::stream(const TessellateOptions& options, MeshSink& sink, const Progress& progress) {
    const Clock::time_point began = Clock::now();
    (void)prepare(options);
    start();
    // Measured anew, so that the times are of all stages.
    tabled_ = 0;
    const PatchSource& source = stream_.source();
    std::vector<mesh_pattern> patterns(source.patches());
    std::vector<MeshPatch> patches;
    patches.reserve(source.patches());
    source.forPatches(0, source.patches(), [&](std::uint32_t object, std::uint32_t patch) { patches.push_back({object, patch}); });
    measureChunks([&](std::uint32_t chunk, const PatchSet& set) {
        tables_.readPatterns(set.patches, patterns.data() + set.first);
        if (progress) progress("measure", measureShare * (chunk + 1.0) / stream_.chunks());
    });
    sink.begin({scene_, measured_.positionsOnly, measured_.sizes, patches, patterns});
    std::uint64_t made = 0;
    for (std::uint32_t chunk = 0; chunk < stream_.chunks(); ++chunk) {
        const std::uint32_t first = chunk * measured_.plan.patchesEach;
        const std::size_t count = std::min<std::size_t>(measured_.plan.patchesEach, patterns.size() - first);
        streamChunk(chunk, std::span(patterns).subspan(first, count), sink, [&](std::uint64_t triangles) {
            made += triangles;
            const double share = static_cast<double>(made) / static_cast<double>(measured_.sizes.triangles);
            if (progress) progress("tessellate", measureShare + (1.0 - measureShare) * share);
        });
    }
    measured_.used = true;
    finish(began);
}

}  // namespace tessera
