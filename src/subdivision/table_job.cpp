// A mesh's course: points, levels, offsets, vertices, indices.
#include "subdivision/table_job.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "mesh/mesh_plan.h"
#include "mesh/mesh_view.h"
#include "mesh/offsets.h"
#include "scene/text.h"
#include "subdivision/table_rows.h"
#include "tessera/error.h"

namespace tessera::subdivision {
namespace {

constexpr std::uint32_t tableMost = TABLE_LEVELS - 1;
constexpr int mostLevel = 8;
// Of a tolerance, what a face's own grid may take: triangles along a coarser neighbour's side take the rest.
constexpr float gridShare = 0.5F;

double sumOf(const std::map<std::string, double>& kernelMs, std::initializer_list<const char*> names) {
    double sum = 0;
    for (const char* name : names) {
        const auto found = kernelMs.find(name);
        if (found != kernelMs.end()) sum += found->second;
    }
    return sum;
}

bool isPosition(const glm::vec3& p) {
    const auto good = [](float x) { return std::isfinite(x) && std::fabs(x) <= 1e9F; };
    return good(p.x) && good(p.y) && good(p.z);
}

// All levels of positions and tangents take less than this.
std::uint64_t tableBytes(const TableStore& store) {
    std::uint64_t rows = 0;
    for (const RingTable& table : store.tables()) rows += table.rows;
    return rows * paddedColumns(tableMost) * 3 * sizeof(float);
}

}  // namespace

TableJob::TableJob(const RendererSettings& settings)
    : session_(settings.device, kernelSources(), cacheFolder(settings.cacheKernels, settings.cacheFolder), settings.lanes,
               tableKernelFiles()),
      uploads_(session_) {
    statistics_.device = session_.device.info.name;
}

void TableJob::forget() {
    measured_ = false;
    indexed_ = false;
    placed_ = false;
    staged_ = false;
}

void TableJob::setScene(const Scene& scene, double creaseAngle, std::uint64_t memoryBytes) {
    const Clock::time_point began = Clock::now();
    forget();
    for (std::optional<TableStage>& stage : stages_) stage.reset();
    more_ = 0;
    scene_ = scene;
    cages_.clear();
    points_.clear();
    pointCounts_.clear();
    for (Cage& cage : scene_.cages) {
        CageReport report;
        TableCage& made = cages_.emplace_back();
        made.clean = cleanCage(cage, creaseAngle, report);
        made.ownSteps = !made.clean.cage.faceSizes.empty() && needsStep(*makeRefiner(made.clean.cage)) ? 1 : 0;
        made.firstPoint = static_cast<std::uint32_t>(points_.size());
        points_.insert(points_.end(), made.clean.cage.points.begin(), made.clean.cage.points.end());
        pointCounts_.push_back(cage.points.size());
    }
    const std::uint64_t budget = memoryBytes == 0 ? defaultBudget(session_.device.info) : memoryBytes;
    // Tables of scenes that were set before are kept as long as they are small beside what this one may take.
    if (tableBytes(store_) > budget / 16) {
        store_ = TableStore();
        tableBuffers_ = TableBuffers();
    }
    stages_[0] = makeStage(scene_, cages_, 0, store_);
    const std::uint64_t bytes = tableBytes(store_);
    if (bytes > budget) {
        throw Error(scene_.name + ": tables of " + std::to_string(store_.tables().size()) + " different neighbourhoods take " +
                    bytesText(bytes) + " on the device, but the memory budget is " + bytesText(budget) +
                    "; give more memory, or patches (subdivide())");
    }
    buildMs_ = std::chrono::duration<double, std::milli>(Clock::now() - began).count();
}

void TableJob::replacePoints(std::size_t cage, std::span<const glm::vec3> points) {
    if (cage >= cages_.size()) {
        throw Error(scene_.name + ": there is no cage " + std::to_string(cage) + " to replace points of; it has " +
                    std::to_string(cages_.size()));
    }
    const std::string where = scene_.name + ": cage " + quotedName(scene_.cages[cage].name);
    if (points.size() != pointCounts_[cage]) {
        throw Error(where + " has " + std::to_string(pointCounts_[cage]) + " points, but " + std::to_string(points.size()) +
                    " are given; give as many");
    }
    for (std::size_t k = 0; k < points.size(); ++k)
        if (!isPosition(points[k])) throw Error(where + ", point " + std::to_string(k) + " must be finite, within 1e9 of 0");
    const TableCage& own = cages_[cage];
    for (std::size_t k = 0; k < own.clean.vertexOf.size(); ++k) points_[own.firstPoint + k] = points[own.clean.vertexOf[k]];
    placed_ = false;
    if (measuredOptions_.level < 0) forget();
    if (cagePoints_.bytes() < points_.size() * sizeof(glm::vec3)) return;
    const Clock::time_point began = Clock::now();
    uploads_.putAt(cagePoints_, own.firstPoint * sizeof(glm::vec3), points_.data() + own.firstPoint,
                   own.clean.vertexOf.size() * sizeof(glm::vec3));
    statistics_.uploadMs = std::chrono::duration<double, std::milli>(Clock::now() - began).count();
}

TableSizes TableJob::tables() const {
    TableSizes sizes;
    const TableStage& stage = *stages_[static_cast<std::size_t>(more_)];
    for (const TableFaces& cage : stage.cages) {
        sizes.faces += cage.faces.size();
        sizes.coarseSteps = std::max(sizes.coarseSteps, cage.steps);
    }
    sizes.configurations = store_.tables().size();
    sizes.edgeClasses = store_.classes().edgeClasses();
    sizes.vertexClasses = store_.classes().vertexClasses();
    sizes.tableBytes = tableBuffers_.bytes();
    sizes.indexBytes = stageBuffers_.indexBytes();
    sizes.stencilBytes = stageBuffers_.stencilBytes();
    sizes.pointBytes = points_.size() * sizeof(glm::vec3);
    sizes.buildMs = buildMs_;
    return sizes;
}

void TableJob::setBudget(const TableOptions& options) {
    const DeviceInfo& info = session_.device.info;
    const std::uint64_t budget = std::min(options.memoryBytes == 0 ? defaultBudget(info) : options.memoryBytes, info.globalBytes);
    // Meshes of a larger budget must not stand in the way.
    if (session_.memory.bytes() > budget) {
        vertices_ = DeviceBuffer();
        indices_ = DeviceBuffer();
        indexed_ = false;
    }
    session_.memory.setBudget(budget);
    statistics_.deviceBytesBudget = budget;
    session_.memory.restartPeak();
}

void TableJob::useStage(int more) {
    std::optional<TableStage>& stage = stages_[static_cast<std::size_t>(more)];
    if (!stage) {
        const Clock::time_point began = Clock::now();
        stage = makeStage(scene_, cages_, more, store_);
        buildMs_ += std::chrono::duration<double, std::milli>(Clock::now() - began).count();
    }
    if (staged_ && more_ == more) return;
    staged_ = false;
    placed_ = false;
    more_ = more;
    if (cagePoints_.bytes() != DeviceMemory::bytesFor(points_.size() * sizeof(glm::vec3)))
        uploads_.put(cagePoints_, Purpose::scene, "the cages' control points", points_);
    else
        uploads_.putAt(cagePoints_, 0, points_.data(), points_.size() * sizeof(glm::vec3));
    stageBuffers_.set(uploads_, session_, *stage);
    reservePatches();
    staged_ = true;
}

void TableJob::reservePatches() {
    const std::uint64_t patches = stages_[static_cast<std::size_t>(more_)]->patches;
    const auto fit = [&](DeviceBuffer& buffer, const char* name, std::uint64_t bytes) {
        session_.memory.ensure(buffer, Purpose::queues, name, bytes);
    };
    fit(levels_, "the faces' levels", patches * sizeof(std::uint32_t));
    fit(graded_, "the faces' levels", patches * sizeof(std::uint32_t));
    fit(patterns_, "the faces' patterns", patches * sizeof(mesh_pattern));
    fit(sums_, "the patterns' sums", sumsBytes(patches));
    fit(offsets_, "the patterns' offsets", offsetsBytes(patches));
    fit(totals_, "the patterns' totals", totalsBytes());
}

void TableJob::usePoints() {
    if (placed_) return;
    stageBuffers_.enqueuePoints(session_, *stages_[static_cast<std::size_t>(more_)], cages_, cagePoints_.cl());
    placed_ = true;
}

void TableJob::useLevels(std::uint32_t least, std::uint32_t most, const TableOptions& options) {
    tableBuffers_.useLevels(uploads_, store_, least, most, !options.positionsOnly);
    const TableStage& stage = *stages_[static_cast<std::size_t>(more_)];
    if (options.order == TableOrder::global)
        stageBuffers_.useNumbers(uploads_, stage);
    else
        stageBuffers_.useRows(uploads_, stage);
}

table_run TableJob::runOf(const TableOptions& options) const {
    table_run run{};
    const TableStage& stage = *stages_[static_cast<std::size_t>(more_)];
    run.objects = static_cast<std::uint32_t>(stage.objects.size());
    run.patches = stage.patches;
    run.end_patch = stage.patches;
    run.by_number = options.order == TableOrder::global ? 1 : 0;
    run.positions_only = options.positionsOnly ? 1 : 0;
    return run;
}

double TableJob::greatestCoordinate() const {
    double most = 0;
    const TableStage& stage = *stages_[0];
    for (std::size_t o = 0; o < stage.objects.size(); ++o) {
        const TableCage& cage = cages_[stage.cageOf[o]];
        Bounds box;
        for (std::size_t k = 0; k < cage.clean.vertexOf.size(); ++k) box.include(points_[cage.firstPoint + k]);
        const glm::dmat4 place = matrix(scene_.objects[stage.objects[o].id].transform);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec4 at((corner & 1) != 0 ? box.upper.x : box.lower.x, (corner & 2) != 0 ? box.upper.y : box.lower.y,
                                (corner & 4) != 0 ? box.upper.z : box.lower.z, 1.0);
            const glm::dvec4 placed = glm::abs(place * at);
            most = std::max({most, placed.x, placed.y, placed.z});
        }
    }
    return most;
}

std::uint32_t TableJob::chooseLevels(const TableOptions& options) {
    TessellateOptions wanted;
    wanted.tolerance = options.tolerance;
    wanted.pixelError = options.pixelError;
    wanted.camera = options.camera;
    wanted.width = options.width;
    wanted.height = options.height;
    mesh_view view = setUpView(wanted, scene_.name, greatestCoordinate());
    view.tolerance *= gridShare;
    const TableStage& stage = *stages_[static_cast<std::size_t>(more_)];
    tableBuffers_.useDeviations(uploads_, store_);
    stageBuffers_.useRows(uploads_, stage);
    const table_run run = runOf(options);
    const auto most = static_cast<cl_uint>(mostLevel - more_);
    session_.launch(
        session_.kernels.with("table_levels", run, view, most, tableBuffers_.infos(), tableBuffers_.deviations(), stageBuffers_.objects(),
                              stageBuffers_.faces(), stageBuffers_.byRow(), stageBuffers_.placed(), levels_.cl()),
        "table_levels");
    std::vector<std::uint32_t> levels(stage.patches);
    if (!levels.empty()) session_.timeline.read(levels_.cl(), levels.data(), levels.size() * sizeof(std::uint32_t));
    const std::uint32_t greatest = levels.empty() ? 0 : *std::max_element(levels.begin(), levels.end());
    if (greatest > tableMost) return greatest;
    // An even number of passes ends where it began; from the greatest level down to 0 there are five.
    for (std::uint32_t pass = 0; pass <= tableMost; ++pass) {
        const cl::Buffer &from = (pass & 1) == 0 ? levels_.cl() : graded_.cl(), &to = (pass & 1) == 0 ? graded_.cl() : levels_.cl();
        session_.launch(session_.kernels.with("table_grade", run, stageBuffers_.objects(), stageBuffers_.faces(), from, to), "table_grade");
    }
    return greatest;
}

void TableJob::makePatterns() {
    const TableStage& stage = *stages_[static_cast<std::size_t>(more_)];
    session_.launch(session_.kernels.with("table_patterns", runOf(measuredOptions_), stageBuffers_.objects(), stageBuffers_.faces(),
                                          levels_.cl(), patterns_.cl()),
                    "table_patterns");
    enqueueOffsets(session_, stage.patches, patterns_.cl(), sums_.cl(), offsets_.cl(), totals_.cl());
    mesh_totals totals{};
    session_.timeline.read(totals_.cl(), &totals, sizeof totals);
    sizes_ = MeshSizes();
    sizes_.patches = stage.patches;
    sizes_.units = totals.sum.units;
    sizes_.vertices = totals.sum.vertices;
    sizes_.distinctVertices = totals.distinct;
    sizes_.triangles = totals.sum.triangles;
    sizes_.vertexBytes = sizes_.vertices * (measuredOptions_.positionsOnly ? 3 * sizeof(float) : sizeof(MeshVertex));
    sizes_.indexBytes = sizes_.triangles * 3 * sizeof(std::uint32_t);
}

MeshSizes TableJob::measure(const TableOptions& options) {
    options.validate();
    const TableOptions& m = measuredOptions_;
    const bool same = options.level == m.level &&
                      std::bit_cast<std::uint64_t>(options.tolerance) == std::bit_cast<std::uint64_t>(m.tolerance) && !options.camera &&
                      !m.camera && options.positionsOnly == m.positionsOnly && options.memoryBytes == m.memoryBytes;
    setBudget(options);
    if (measured_ && same) {
        measuredOptions_.order = options.order;
        const auto level = static_cast<std::uint32_t>(std::clamp(options.level - more_, 0, static_cast<int>(tableMost)));
        usePoints();
        useLevels(options.level < 0 ? 0 : level, options.level < 0 ? tableMost : level, options);
        return sizes_;
    }
    const bool staged = staged_;
    forget();
    staged_ = staged;
    measuredOptions_ = options;
    if (options.level >= 0) {
        useStage(std::max(0, options.level - static_cast<int>(tableMost)));
        const auto level = static_cast<std::uint32_t>(options.level - more_);
        useLevels(level, level, options);
        usePoints();
        session_.timeline.fill(levels_.cl(), level, levels_.bytes());
    } else {
        std::uint32_t most = 0;
        useStage(0);
        usePoints();
        while ((most = chooseLevels(options)) > tableMost) {
            useStage(more_ + static_cast<int>(most - tableMost));
            usePoints();
        }
        useLevels(0, tableMost, options);
    }
    makePatterns();
    measured_ = true;
    return sizes_;
}

void TableJob::enqueueVertices(table_run run, std::uint64_t firstVertex, const TableOptions& options) {
    run.first_vertex_low = static_cast<std::uint32_t>(firstVertex);
    run.first_vertex_high = static_cast<std::uint32_t>(firstVertex >> 32U);
    const TableBuffers& t = tableBuffers_;
    const bool ordered = options.order == TableOrder::global;
    const cl::Buffer& entries = ordered ? stageBuffers_.byNumber() : stageBuffers_.byRow();
    session_.launch(session_.kernels.with("table_vertices", run, t.positions(0), t.positions(1), t.positions(2), t.positions(3),
                                          t.positions(4), t.positions(5), t.tangents(0), t.tangents(1), t.tangents(2), t.tangents(3),
                                          t.tangents(4), t.tangents(5), t.places(), t.infos(), stageBuffers_.objects(),
                                          stageBuffers_.faces(), entries, ordered ? stageBuffers_.rowOf() : entries, stageBuffers_.placed(),
                                          patterns_.cl(), offsets_.cl(), vertices_.cl()),
                    "table_vertices");
}

void TableJob::enqueueIndices(const mesh_piece& piece) {
    session_.launch(session_.kernels.with("mesh_indices", piece, offsets_.cl(), patterns_.cl(), indices_.cl()), "mesh_indices");
}

void TableJob::makeMesh(std::uint64_t vertices, std::uint64_t triangles, const TableOptions& options) {
    const std::uint64_t vertexBytes = vertices * (options.positionsOnly ? 3 * sizeof(float) : sizeof(MeshVertex));
    const std::uint64_t indexBytes = triangles * 3 * sizeof(std::uint32_t);
    if (vertices_.bytes() < vertexBytes || indices_.bytes() < indexBytes) {
        indexed_ = false;
        // Both anew, so that neither's old size takes the other's room.
        vertices_ = DeviceBuffer();
        indices_ = DeviceBuffer();
    }
    session_.memory.ensure(vertices_, Purpose::picture, "the mesh's vertices", vertexBytes);
    session_.memory.ensure(indices_, Purpose::picture, "the mesh's indices", indexBytes);
}

DeviceMesh TableJob::tessellate(const TableOptions& options) {
    const Clock::time_point began = Clock::now();
    session_.timeline.restart(false);
    (void)measure(options);
    if (sizes_.vertices > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(scene_.name + ": the mesh has " + std::to_string(sizes_.vertices) +
                    " vertices, more than 32-bit indices can tell apart; give a lower level, or stream it");
    }
    makeMesh(sizes_.vertices, sizes_.triangles, options);
    enqueueVertices(runOf(options), 0, options);
    if (!indexed_)
        enqueueIndices({stages_[static_cast<std::size_t>(more_)]->patches, options.positionsOnly ? 1U : 0U, 0, sizes_.units, 0, 0});
    indexed_ = true;
    finish(began);
    return {session_.device.context(), session_.device.queue(), vertices_.cl()(), indices_.cl()(), sizes_};
}

void TableJob::finish(Clock::time_point began) {
    session_.timeline.finish();
    TableStatistics& s = statistics_;
    const std::map<std::string, double> kernelMs = session_.timeline.milliseconds();
    s.tables = tables();
    s.sizes = sizes_;
    s.coarseMs = sumOf(kernelMs, {"table_stencils", "table_place"});
    s.levelsMs = sumOf(kernelMs, {"table_levels", "table_grade", "table_patterns", "mesh_sums", "mesh_scan", "mesh_offsets"});
    s.vertexMs = sumOf(kernelMs, {"table_vertices"});
    s.indexMs = sumOf(kernelMs, {"mesh_indices"});
    s.tessellateMs = std::chrono::duration<double, std::milli>(Clock::now() - began).count();
    s.uploadedBytes = uploads_.take();
    s.deviceBytesPeak = session_.memory.peakBytes();
}

}  // namespace tessera::subdivision
