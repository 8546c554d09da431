// Which of a file's vertices those of a unit are, and which of them are to be written with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/weld_numbers.h"
#include "tessera/mesh_sink.h"

namespace tessera {

class UnitVertices {
public:
    // Spans of the outline must stay.
    UnitVertices(const MeshOutline& outline, WeldScope scope);

    [[nodiscard]] const WeldNumbers& weld() const { return weld_; }

    // To be called for each unit of the mesh, in order.
    void read(const MeshPiece& piece, const MeshUnit& unit);

    // The file's numbers of the unit's vertices, from 0.
    [[nodiscard]] std::span<const std::uint64_t> numbers() const { return numbers_; }
    // Vertices that are the file's next ones. Those around a patch in parts come when all its sides were read: a side may name vertices
    // that come later. Where the mesh has positions only, the rest is 0.
    [[nodiscard]] std::span<const MeshVertex> fresh() const { return fresh_; }

private:
    void beginPatch(std::size_t patch);
    void readWhole(const MeshPiece& piece, const MeshUnit& unit);
    void readPart(const MeshPiece& piece, const MeshUnit& unit);

    const MeshOutline outline_;
    WeldNumbers weld_;
    std::vector<std::uint64_t> loop_;   // numbers, of the patch
    std::vector<MeshVertex> heldLoop_;  // its vertices, until the first of the inner ones is read
    std::uint64_t firstInner_ = 0;
    std::uint64_t next_ = 0;
    std::vector<std::uint64_t> numbers_;
    std::vector<MeshVertex> fresh_;
};

}  // namespace tessera
