// GLB 2.0: a chunk of JSON, then one of all objects' vertices and behind them their triangles. The JSON is written last, for it holds the
// positions' bounds.
#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "formats/file_section.h"
#include "formats/glb_json.h"
#include "formats/mesh_out_base.h"
#include "formats/mesh_out_formats.h"
#include "formats/unit_vertices.h"
#include "mesh/pattern.h"

namespace tessera {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr std::uint64_t kHeadBytes = 20, kChunkHeadBytes = 8;
// Greater numbers a float does not hold.
constexpr std::uint32_t kPatchMost = 1U << 24U;

class GlbWriter final : public FormatWriter {
public:
    GlbWriter(const std::filesystem::path& path, const MeshFileOptions& options) : FormatWriter(path, false), options_(options) {}

    [[nodiscard]] bool positionsSuffice() const override { return options_.positionsOnly; }

protected:
    void layOut() override {
        vertexWork_.emplace(outline(), options_.weld && options_.positionsOnly ? WeldScope::object : WeldScope::patch);
        vertices_ = vertexWork_->weld().vertexCount();
        checkPatches();
        makeNodes();
        const std::uint64_t json = glbJson(nodes_, binaryBytes(), options_.positionsOnly).size();
        bytes_ = kHeadBytes + json + (binaryBytes() > 0 ? kChunkHeadBytes + binaryBytes() : 0);
        checkCount(bytes_, std::numeric_limits<std::uint32_t>::max(), "bytes");
        const std::uint64_t binaryAt = kHeadBytes + json + kChunkHeadBytes;
        OutputFile& out = makeFile(bytes_);
        vertexSection_.emplace(out, binaryAt);
        indexSection_.emplace(out, binaryAt + vertices_ * vertexBytes());
    }

    void writeUnit(const MeshPiece& piece, const MeshUnit& unit) override {
        vertexWork_->read(piece, unit);
        const std::uint32_t object = outline().patches[unit.patch].object;
        const bool textured = vertexWork_->textured(object);
        for (const MeshVertex& vertex : vertexWork_->fresh()) writeVertex(vertex, textured, nodes_[object].mesh);
        const std::span<const std::uint64_t> numbers = vertexWork_->numbers();
        eachFace(piece, unit, [&](std::span<const std::uint32_t> corners) {
            BytePutter out(indexSection_->room(12));
            for (const std::uint32_t corner : corners) out.put(static_cast<std::uint32_t>(numbers[corner] - firstVertex_[object]));
        });
    }

    void complete() override {
        vertexSection_->flush();
        indexSection_->flush();
        const std::string json = glbJson(nodes_, binaryBytes(), options_.positionsOnly);
        FileSection head(file(), 0);
        BytePutter start(head.room(kHeadBytes));
        start.put(std::array<std::uint32_t, 5>{kMagic, kVersion, static_cast<std::uint32_t>(bytes_),
                                               static_cast<std::uint32_t>(json.size()), kJsonChunk});
        head.put(std::as_bytes(std::span(json)));
        if (binaryBytes() > 0) {
            BytePutter chunk(head.room(kChunkHeadBytes));
            chunk.put(std::array<std::uint32_t, 2>{static_cast<std::uint32_t>(binaryBytes()), kBinaryChunk});
        }
        head.flush();
    }

private:
    [[nodiscard]] std::uint64_t vertexBytes() const { return glbVertexBytes(options_.positionsOnly); }
    [[nodiscard]] std::uint64_t binaryBytes() const { return vertices_ * vertexBytes() + triangles_ * 12; }

    void checkPatches() const {
        if (options_.positionsOnly) return;
        for (const MeshPatch& patch : outline().patches)
            if (patch.patch > kPatchMost) {
                refuse("a mesh has more than " + std::to_string(kPatchMost) +
                       " patches, whose numbers GLB's floats do not hold; choose .ply or .obj, or positions only");
            }
    }

    void makeNodes() {
        const WeldNumbers& weld = vertexWork_->weld();
        constexpr float infinity = std::numeric_limits<float>::infinity();
        GlbMesh nothing;
        nothing.lower.fill(infinity);
        nothing.upper.fill(-infinity);
        for (const Object& object : outline().scene.objects) nodes_.push_back({object.name, nothing});
        firstVertex_.resize(nodes_.size());
        std::uint64_t triangles = 0;
        for (std::size_t patch = 0; patch < outline().patches.size(); ++patch) {
            const std::uint32_t object = outline().patches[patch].object;
            GlbMesh& mesh = nodes_[object].mesh;
            if (patch == 0 || object != outline().patches[patch - 1].object) {
                firstVertex_[object] = weld.firstNew(patch);
                mesh.verticesAt = weld.firstNew(patch) * vertexBytes();
                mesh.indicesAt = vertices_ * vertexBytes() + triangles * 12;
            }
            const std::uint64_t own = patternTriangles(outline().patterns[patch]);
            mesh.vertices += weld.firstNew(patch + 1) - weld.firstNew(patch);
            mesh.triangles += own;
            triangles += own;
        }
    }

    void writeVertex(const MeshVertex& vertex, bool textured, GlbMesh& mesh) {
        for (std::size_t c = 0; c < 3; ++c) {
            mesh.lower[c] = std::min(mesh.lower[c], vertex.position[c]);
            mesh.upper[c] = std::max(mesh.upper[c], vertex.position[c]);
        }
        BytePutter out(vertexSection_->room(vertexBytes()));
        out.put(vertex.position);
        if (options_.positionsOnly) return;
        const bool none = vertex.normal[0] == 0.0F && vertex.normal[1] == 0.0F && vertex.normal[2] == 0.0F;
        out.put(none ? std::array<float, 3>{0.0F, 0.0F, 1.0F} : std::array<float, 3>{vertex.normal[0], vertex.normal[1], vertex.normal[2]});
        out.put(vertex.u);
        // The format's pictures begin at their upper left corner.
        out.put(textured ? 1.0F - vertex.v : vertex.v);
        out.put(static_cast<float>(vertex.patch));
    }

    MeshFileOptions options_;
    std::optional<UnitVertices> vertexWork_;
    std::vector<GlbNode> nodes_;              // of each object
    std::vector<std::uint64_t> firstVertex_;  // of each
    std::optional<FileSection> vertexSection_;
    std::optional<FileSection> indexSection_;
};

}  // namespace

std::unique_ptr<MeshWriter> makeGlbWriter(const std::filesystem::path& path, const MeshFileOptions& options) {
    return std::make_unique<GlbWriter>(path, options);
}

}  // namespace tessera
