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

    // Whether the object's mesh has texture coordinates.
    [[nodiscard]] bool textured(std::uint32_t object) const { return !textured_.empty() && textured_[object] != nullptr; }

    // To be called for each unit of the mesh, in order.
    void read(const MeshPiece& piece, const MeshUnit& unit);

    // The unit's vertices, with texture coordinates for (u, v) where their mesh has them (tessera/texture.h). Where the mesh was made with
    // positions only, all else is 0.
    [[nodiscard]] std::span<const MeshVertex> vertices() const { return vertices_; }
    // The file's numbers of the unit's vertices, from 0.
    [[nodiscard]] std::span<const std::uint64_t> numbers() const { return numbers_; }
    // Vertices that are the file's next ones. Those around a patch in parts come when all its sides were read: a side may name vertices
    // that come later.
    [[nodiscard]] std::span<const MeshVertex> fresh() const { return fresh_; }

private:
    void takeVertices(const MeshPiece& piece, const MeshUnit& unit);
    void beginPatch(std::size_t patch);
    void readWhole();
    void readPart(const MeshUnit& unit);

    const MeshOutline outline_;
    WeldNumbers weld_;
    std::vector<const Mesh*> textured_;  // of each object: its mesh where that has texture nets; empty where none has
    std::vector<MeshVertex> made_;       // where they are not the piece's own
    std::span<const MeshVertex> vertices_;
    std::vector<std::uint64_t> loop_;   // numbers, of the patch
    std::vector<MeshVertex> heldLoop_;  // its vertices, until the first of the inner ones is read
    std::uint64_t firstInner_ = 0;
    std::uint64_t next_ = 0;
    std::vector<std::uint64_t> numbers_;
    std::vector<MeshVertex> fresh_;
};

}  // namespace tessera
