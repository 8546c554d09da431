// The course of a mesh file from its layout to its name.
#include "formats/mesh_out_base.h"

#include "mesh/pattern.h"
#include "tessera/error.h"

namespace tessera {

void FormatWriter::begin(const MeshOutline& outline) {
    outline_.emplace(outline);
    if (outline.positionsOnly && !positionsSuffice()) refuse("the mesh was made with positions only; leave out other vertex data as well");
    countFaces();
    layOut();
}

void FormatWriter::take(const MeshPiece& piece) {
    for (const MeshUnit& unit : piece.units) writeUnit(piece, unit);
    unitsTaken_ += piece.units.size();
}

void FormatWriter::finish() {
    if (!file_ || unitsTaken_ != outline_->sizes.units) refuse("the mesh ended before all of it was there; tessellate it again");
    complete();
    file_->giveName();
    file_.reset();
}

OutputFile& FormatWriter::makeFile(std::uint64_t bytes) {
    file_ = std::make_unique<OutputFile>(path_);
    file_->reserve(bytes);
    return *file_;
}

void FormatWriter::refuse(const std::string& reason) const { throw Error("cannot write '" + path_.string() + "': " + reason); }

void FormatWriter::checkCount(std::uint64_t count, std::uint64_t most, const std::string& things) const {
    if (count <= most) return;
    refuse("it would have " + std::to_string(count) + " " + things + ", and its format holds at most " + std::to_string(most) +
           "; choose .obj, which has no such limit, or a greater tolerance");
}

std::uint64_t FormatWriter::trianglesAlone(const MeshUnit& unit) const {
    return asQuads_ ? firstCellTriangle(patternOf(unit), unit.unit) : unit.triangles;
}

void FormatWriter::countFaces() {
    triangles_ = outline_->sizes.triangles;
    quads_ = 0;
    if (!asQuads_) return;
    for (const mesh_pattern& pattern : outline_->patterns) {
        const std::uint32_t units = patternUnits(pattern);
        for (std::uint32_t k = 0; k < units; ++k) {
            const std::uint64_t all = unitsBefore(pattern, k + 1).triangles - unitsBefore(pattern, k).triangles;
            quads_ += (all - firstCellTriangle(pattern, k)) / 2;
        }
    }
    triangles_ -= 2 * quads_;
}

}  // namespace tessera
