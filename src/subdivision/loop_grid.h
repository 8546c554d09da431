// Points of a triangle cage's faces, cut regularly, numbered so that faces share those on their edges.
#pragma once

#include <array>
#include <cstdint>

#include "subdivision/corner_sets.h"
#include "subdivision/refiner.h"

namespace tessera::subdivision {

// Point (i, j) of a face lies at (u, v) = (i, j) / size; corners 0, 1, 2 at (0, 0), (size, 0), (0, size).
class LoopGrid {
public:
    LoopGrid(const Refiner& refiner, std::uint32_t level);

    [[nodiscard]] std::uint32_t size() const { return size_; }
    [[nodiscard]] std::uint32_t points() const;

    [[nodiscard]] std::uint32_t point(int face, std::uint32_t i, std::uint32_t j) const;

    // Whether the face has a normal of its own there, for it lies on a crease; else normalSlot() tells whose normals are the same.
    [[nodiscard]] bool ownsNormal(int face, std::uint32_t i, std::uint32_t j) const;
    [[nodiscard]] std::uint32_t normalSlot(int face, std::uint32_t i, std::uint32_t j);
    [[nodiscard]] std::uint32_t normalSlots() const { return points() + static_cast<std::uint32_t>(3 * level_->GetNumFaces()); }

private:
    // A point's place on its face's border.
    struct Border {
        int corner = -1;         // or
        int side = -1;           // from this corner to the next
        std::uint32_t step = 0;  // then how far along
    };
    [[nodiscard]] Border border(std::uint32_t i, std::uint32_t j) const;
    [[nodiscard]] bool isSharp(int edge) const;

    const OpenSubdiv::Far::TopologyLevel* level_;
    std::uint32_t size_;
    CornerSets fans_;
    std::vector<bool> torn_;  // vertices where each face has its own normal
};

}  // namespace tessera::subdivision
