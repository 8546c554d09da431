// Binary PLY: vertices and faces in sections of known size, written side by side.
#include <cstring>
#include <limits>
#include <optional>

#include "formats/file_section.h"
#include "formats/mesh_out_base.h"
#include "formats/mesh_out_formats.h"
#include "formats/unit_vertices.h"

namespace tessera {
namespace {

class PlyWriter final : public FormatWriter {
public:
    PlyWriter(const std::filesystem::path& path, const MeshFileOptions& options) : FormatWriter(path, options.quads), options_(options) {}

    [[nodiscard]] bool positionsSuffice() const override { return options_.positionsOnly; }

protected:
    void layOut() override {
        vertexWork_.emplace(outline(), options_.weld ? WeldScope::scene : WeldScope::patch);
        vertices_ = vertexWork_->weld().vertexCount();
        checkCount(vertices_, std::numeric_limits<std::uint32_t>::max(), "vertices");
        const std::string header = headerText();
        const std::uint64_t facesAt = header.size() + vertices_ * vertexBytes();
        bytes_ = facesAt + triangles_ * faceBytes(3) + quads_ * faceBytes(4);
        OutputFile& out = makeFile(bytes_);
        out.write(0, std::as_bytes(std::span(header)));
        vertexSection_.emplace(out, header.size());
        faceSection_.emplace(out, facesAt);
    }

    void writeUnit(const MeshPiece& piece, const MeshUnit& unit) override {
        vertexWork_->read(piece, unit);
        writeVertices(vertexWork_->fresh());
        const std::span<const std::uint64_t> numbers = vertexWork_->numbers();
        const bool attributes = attributesOfFaces();
        eachFace(piece, unit, [&](std::span<const std::uint32_t> corners) {
            BytePutter out(faceSection_->room(faceBytes(corners.size())));
            const auto count = static_cast<std::uint8_t>(corners.size());
            out.put(count);
            for (const std::uint32_t corner : corners) out.put(static_cast<std::uint32_t>(numbers[corner]));
            if (attributes) putAttributes(out, vertexWork_->vertices(), corners);
        });
    }

    void complete() override {
        vertexSection_->flush();
        faceSection_->flush();
    }

private:
    [[nodiscard]] bool attributesOfFaces() const { return options_.weld && !options_.positionsOnly; }
    [[nodiscard]] bool attributesOfVertices() const { return !options_.weld && !options_.positionsOnly; }

    [[nodiscard]] std::size_t vertexBytes() const { return attributesOfVertices() ? sizeof(MeshVertex) : sizeof(MeshVertex::position); }

    // A count, and an index a corner; then two counts with two and three floats a corner, and two numbers.
    [[nodiscard]] std::size_t faceBytes(std::size_t corners) const {
        const std::size_t indices = 1 + 4 * corners;
        return attributesOfFaces() ? indices + (1 + 8 * corners) + (1 + 12 * corners) + 8 : indices;
    }

    [[nodiscard]] std::string headerText() const {
        std::string text = "ply\nformat binary_little_endian 1.0\ncomment made by Tessera\n";
        text += "element vertex " + std::to_string(vertices_) + "\nproperty float x\nproperty float y\nproperty float z\n";
        if (attributesOfVertices()) {
            text += "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\n";
            text += "property int object_id\nproperty int patch_id\n";
        }
        text += "element face " + std::to_string(triangles_ + quads_) + "\nproperty list uchar uint vertex_indices\n";
        if (attributesOfFaces()) {
            text += "property list uchar float texcoord\nproperty list uchar float normals\n";
            text += "property int object_id\nproperty int patch_id\n";
        }
        return text + "end_header\n";
    }

    void writeVertices(std::span<const MeshVertex> fresh) {
        if (attributesOfVertices()) {
            vertexSection_->put(std::as_bytes(fresh));
            return;
        }
        for (const MeshVertex& vertex : fresh)
            std::memcpy(vertexSection_->room(sizeof(vertex.position)), vertex.position, sizeof(vertex.position));
    }

    static void putAttributes(BytePutter& out, std::span<const MeshVertex> vertices, std::span<const std::uint32_t> corners) {
        out.put(static_cast<std::uint8_t>(2 * corners.size()));
        for (const std::uint32_t corner : corners) {
            out.put(vertices[corner].u);
            out.put(vertices[corner].v);
        }
        out.put(static_cast<std::uint8_t>(3 * corners.size()));
        for (const std::uint32_t corner : corners) out.put(vertices[corner].normal);
        out.put(vertices[corners[0]].object);
        out.put(vertices[corners[0]].patch);
    }

    MeshFileOptions options_;
    std::optional<UnitVertices> vertexWork_;
    std::optional<FileSection> vertexSection_;
    std::optional<FileSection> faceSection_;
};

}  // namespace

std::unique_ptr<MeshWriter> makePlyWriter(const std::filesystem::path& path, const MeshFileOptions& options) {
    return std::make_unique<PlyWriter>(path, options);
}

}  // namespace tessera
