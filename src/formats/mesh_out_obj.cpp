// OBJ: text, written in order. A face names only vertices that stand before it, for readers that go through the file once.
#include <charconv>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "formats/file_section.h"
#include "formats/mesh_out_base.h"
#include "formats/mesh_out_formats.h"
#include "formats/unit_vertices.h"
#include "mesh/pattern.h"

namespace tessera {
namespace {

// A line of text. The longest is a face of four corners, each three numbers of up to 20 digits.
class Line {
public:
    Line& text(std::string_view words) {
        std::memcpy(end_, words.data(), words.size());
        end_ += words.size();
        return *this;
    }
    template <typename Number>
    Line& number(Number x) {
        end_ = std::to_chars(end_, text_.data() + text_.size(), x).ptr;
        return *this;
    }
    template <typename... Floats>
    Line& floats(std::string_view word, Floats... x) {
        text(word);
        ((text(" "), number(x)), ...);
        return text("\n");
    }
    [[nodiscard]] std::string_view view() const { return {text_.data(), static_cast<std::size_t>(end_ - text_.data())}; }

private:
    std::array<char, 320> text_;
    char* end_ = text_.data();
};

// A name as one word.
std::string wordOf(const std::string& name, std::uint32_t object) {
    std::string word = name.empty() ? "object_" + std::to_string(object) : name;
    for (char& c : word)
        if (static_cast<unsigned char>(c) <= ' ' || c == '\x7F' || c == '#' || c == '\\') c = '_';
    return word;
}

class ObjWriter final : public FormatWriter {
public:
    ObjWriter(const std::filesystem::path& path, const MeshFileOptions& options) : FormatWriter(path, options.quads), options_(options) {}

    [[nodiscard]] bool positionsSuffice() const override { return options_.positionsOnly; }

protected:
    void layOut() override {
        positions_.emplace(outline(), options_.weld ? WeldScope::scene : WeldScope::patch);
        if (options_.weld && !options_.positionsOnly) attributes_.emplace(outline(), WeldScope::patch);
        vertices_ = positions_->weld().vertexCount();
        section_.emplace(makeFile(0), 0);
        put("# made by Tessera\n");
    }

    void writeUnit(const MeshPiece& piece, const MeshUnit& unit) override {
        if (unit.unit == 0) beginPatch(unit);
        positions_->read(piece, unit);
        if (attributes_) attributes_->read(piece, unit);
        writeVertices();
        writeFaces(piece, unit);
        if (unit.unit + 1 == patternUnits(patternOf(unit))) {
            put(heldFaces_);
            heldFaces_.clear();
        }
    }

    void complete() override {
        section_->flush();
        bytes_ = section_->end();
    }

private:
    void put(std::string_view text) { section_->put(std::as_bytes(std::span(text))); }

    [[nodiscard]] UnitVertices& ownAttributes() { return attributes_ ? *attributes_ : *positions_; }

    void beginPatch(const MeshUnit& unit) {
        const MeshPatch& patch = outline().patches[unit.patch];
        if (object_ != patch.object) put("o " + wordOf(outline().scene.objects[patch.object].name, patch.object) + "\n");
        object_ = patch.object;
        if (!options_.positionsOnly) put("g patch_" + std::to_string(patch.patch) + "\n");
    }

    void writeVertices() {
        for (const MeshVertex& v : positions_->fresh()) put(Line().floats("v", v.position[0], v.position[1], v.position[2]).view());
        if (options_.positionsOnly) return;
        for (const MeshVertex& v : ownAttributes().fresh()) {
            put(Line().floats("vt", v.u, v.v).view());
            put(Line().floats("vn", v.normal[0], v.normal[1], v.normal[2]).view());
        }
    }

    void writeFaces(const MeshPiece& piece, const MeshUnit& unit) {
        const std::span<const std::uint64_t> position = positions_->numbers(), attribute = ownAttributes().numbers();
        // A side of a patch in parts names inner vertices, which come with parts behind it.
        const bool hold = unit.unit + 1 < patternUnits(patternOf(unit)) && isSide(unit);
        eachFace(piece, unit, [&](std::span<const std::uint32_t> corners) {
            Line line;
            line.text("f");
            for (const std::uint32_t corner : corners) {
                line.text(" ").number(position[corner] + 1);
                if (options_.positionsOnly) continue;
                line.text("/").number(attribute[corner] + 1).text("/").number(attribute[corner] + 1);
            }
            line.text("\n");
            if (hold)
                heldFaces_ += line.view();
            else
                put(line.view());
        });
    }

    [[nodiscard]] bool isSide(const MeshUnit& unit) {
        unitVertexNumbers(patternOf(unit), unit.unit, inPattern_);
        return inPattern_.front() < patternLoop(patternOf(unit));
    }

    MeshFileOptions options_;
    std::optional<UnitVertices> positions_;
    std::optional<UnitVertices> attributes_;  // where they are numbered otherwise
    std::optional<FileSection> section_;
    std::optional<std::uint32_t> object_;
    std::string heldFaces_;  // of one patch's sides: 524,288 lines at most
    std::vector<std::uint64_t> inPattern_;
};

}  // namespace

std::unique_ptr<MeshWriter> makeObjWriter(const std::filesystem::path& path, const MeshFileOptions& options) {
    return std::make_unique<ObjWriter>(path, options);
}

}  // namespace tessera
