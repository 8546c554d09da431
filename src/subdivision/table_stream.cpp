// A mesh piece by piece: runs of whole faces that the budget has room for.
#include <algorithm>

#include "mesh/mesh_plan.h"
#include "subdivision/table_job.h"
#include "tessera/error.h"

namespace tessera::subdivision {
namespace {

// Vertices of a piece at most, as a Tessellator's.
constexpr std::uint64_t pieceVertices = std::uint64_t{1} << 20;

// A buffer as the host sees it, while this lives.
class Mapped {
public:
    Mapped(Timeline& timeline, const cl::Buffer& buffer, std::size_t bytes)
        : timeline_(timeline), buffer_(buffer), at_(timeline.map(buffer, bytes)) {}
    ~Mapped() {
        try {
            timeline_.unmap(buffer_, at_);
        } catch (const cl::Error&) {
            // The device is gone; the next command tells.
        }
    }
    Mapped(const Mapped&) = delete;
    Mapped& operator=(const Mapped&) = delete;
    template <typename T>
    [[nodiscard]] std::span<const T> as(std::uint64_t count) const {
        return {static_cast<const T*>(at_), count};
    }

private:
    Timeline& timeline_;
    const cl::Buffer& buffer_;
    void* at_;
};

}  // namespace

void TableJob::stream(const TableOptions& options, MeshSink& sink, const Progress& progress) {
    const Clock::time_point began = Clock::now();
    session_.timeline.restart(false);
    (void)measure(options);
    const TableStage& stage = *stages_[static_cast<std::size_t>(more_)];
    std::vector<mesh_pattern> patterns(stage.patches);
    std::vector<mesh_offset> offsets(std::size_t{stage.patches} + 1);
    if (!patterns.empty()) session_.timeline.read(patterns_.cl(), patterns.data(), patterns.size() * sizeof(mesh_pattern));
    session_.timeline.read(offsets_.cl(), offsets.data(), offsets.size() * sizeof(mesh_offset));
    const Scene numbered = standIn(scene_, stage);
    const std::vector<MeshPatch> patches = placedPatches(stage);
    sink.begin({numbered, options.positionsOnly, sizes_, patches, patterns});
    // What is left beside tables and points is the piece's.
    vertices_ = DeviceBuffer();
    indices_ = DeviceBuffer();
    indexed_ = false;
    const std::uint64_t room = (session_.memory.budget() - session_.memory.bytes()) / bytesAVertex(options.positionsOnly);
    constexpr std::uint64_t most = std::uint64_t{sidePoints} * sidePoints;
    if (room < most) {
        throw Error(scene_.name + ": the memory budget of " + bytesText(session_.memory.budget()) +
                    " leaves no room for a face's vertices; " +
                    bytesText(session_.memory.bytes() + most * bytesAVertex(options.positionsOnly)) + " would do");
    }
    PieceCutter cutter(patterns, offsets);
    PieceUnits piece;
    std::uint64_t made = 0;
    while (cutter.next(std::min(room, pieceVertices), piece)) {
        makeMesh(piece.vertices, piece.triangles, options);
        table_run run = runOf(options);
        run.first_patch = piece.units.front().patch;
        run.end_patch = piece.units.back().patch + 1;
        enqueueVertices(run, piece.firstVertex, options);
        enqueueIndices({stage.patches, run.positions_only, piece.firstUnit, piece.units.size(), piece.firstVertex, piece.firstTriangle});
        const Mapped vertexData(session_.timeline, vertices_.cl(), sizes_.vertexBytes / sizes_.vertices * piece.vertices);
        const Mapped indexData(session_.timeline, indices_.cl(), piece.triangles * 3 * sizeof(std::uint32_t));
        MeshPiece out;
        out.units = piece.units;
        if (options.positionsOnly)
            out.positions = vertexData.as<float>(3 * piece.vertices);
        else
            out.vertices = vertexData.as<MeshVertex>(piece.vertices);
        out.indices = indexData.as<std::uint32_t>(3 * piece.triangles);
        sink.take(out);
        made += piece.triangles;
        if (progress) progress("tessellate", static_cast<double>(made) / static_cast<double>(sizes_.triangles));
    }
    finish(began);
}

}  // namespace tessera::subdivision
