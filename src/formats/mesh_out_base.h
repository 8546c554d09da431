// What the writers of all formats share: the course of a file from its layout to its name, and the walk over units and their faces.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "formats/mesh_writer.h"
#include "formats/output_file.h"
#include "mesh/mesh_shared.h"

namespace tessera {

class FormatWriter : public MeshWriter {
public:
    void begin(const MeshOutline& outline) final;
    void take(const MeshPiece& piece) final;
    void finish() final;

protected:
    FormatWriter(std::filesystem::path path, bool quads) : path_(std::move(path)), asQuads_(quads) {}

    // Lays the file out, refusing what the format cannot hold, and calls makeFile() when all is known. triangles() and quads() are set;
    // vertices() is to be set here.
    virtual void layOut() = 0;
    virtual void writeUnit(const MeshPiece& piece, const MeshUnit& unit) = 0;
    // All units are written: sections are flushed, and bytes() is set.
    virtual void complete() = 0;

    // `bytes`: 0 where they are not known.
    OutputFile& makeFile(std::uint64_t bytes);
    [[nodiscard]] OutputFile& file() { return *file_; }
    [[nodiscard]] const MeshOutline& outline() const { return *outline_; }
    [[nodiscard]] const mesh_pattern& patternOf(const MeshUnit& unit) const { return outline_->patterns[unit.patch]; }

    // Throws Error: the file cannot be written, for this reason.
    [[noreturn]] void refuse(const std::string& reason) const;
    // Refuses a count beyond `most`, or a file of so many bytes.
    void checkCount(std::uint64_t count, std::uint64_t most, const std::string& things) const;

    // Calls face(corners) for each of a unit's faces: three or four numbers of the unit's vertices.
    template <typename Face>
    void eachFace(const MeshPiece& piece, const MeshUnit& unit, Face face) const {
        const std::uint32_t* at = piece.indices.data() + 3 * unit.firstTriangle;
        const auto base = static_cast<std::uint32_t>(unit.firstVertex);
        const std::uint64_t alone = trianglesAlone(unit);
        std::array<std::uint32_t, 4> corners{};
        for (std::uint64_t t = 0; t < alone; ++t, at += 3) {
            corners = {at[0] - base, at[1] - base, at[2] - base, 0};
            face(std::span<const std::uint32_t>(corners).first(3));
        }
        for (std::uint64_t t = alone; t < unit.triangles; t += 2, at += 6) {
            corners = {at[0] - base, at[1] - base, at[2] - base, at[5] - base};
            face(std::span<const std::uint32_t>(corners));
        }
    }

private:
    // The first of a unit's triangles from which on two make a face.
    [[nodiscard]] std::uint64_t trianglesAlone(const MeshUnit& unit) const;
    void countFaces();

    std::filesystem::path path_;
    bool asQuads_ = false;
    std::optional<MeshOutline> outline_;
    std::unique_ptr<OutputFile> file_;
    std::uint64_t unitsTaken_ = 0;
};

}  // namespace tessera
