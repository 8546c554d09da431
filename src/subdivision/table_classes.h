// Coefficients that neighbouring faces share: those of points on an edge depend on the rings of its two ends alone, those of a corner on
// its own ring. Rings that are the same but for symmetry are one class, whose values are the same under all its symmetries, so that every
// face at an edge has the same bits there (Bolz, Schroeder 2003, section 2.1.1). A class is made from a cage of its own, in which no two
// of its vertices are one, so that its values depend on nothing but its key.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "subdivision/table_ring.h"

namespace tessera::subdivision {

// Points of a table's side, corners included.
inline constexpr std::uint32_t sidePoints = 33;

// The rings of an edge's ends, or of a corner alone.
struct EdgeRings {
    std::uint32_t start = 0;
    std::uint32_t end = 0;
    CornerRing around;      // of the start; `own` is its edge to the end
    CornerRing aroundEnd;   // `own` is its edge to the start; of no faces where there is a corner alone
    bool reversed = false;  // against the edge as it was given
};

// Positions of one, each once, in an order that depends on valences and boundaries alone: slots of the class.
[[nodiscard]] std::vector<std::uint32_t> slotsOf(const EdgeRings& rings);
[[nodiscard]] Key keyOf(const EdgeRings& rings);

// Of all ways of reading them, from either end, or edge by edge around a corner, and from either side, those whose key comes first.
[[nodiscard]] std::vector<EdgeRings> leastReadings(const EdgeRings& rings);

// Classes, kept for ever.
class SymmetryClasses {
public:
    // Side `side` of a ring, from corner `side` to the next: sidePoints values for each of `rows` rows, the sums over the positions of a
    // row, which do not depend on their order. `rowOf`: the row of each position.
    void fillSide(const FaceRing& ring, std::uint32_t side, std::span<const std::uint32_t> rowOf, std::span<float> rows);

    [[nodiscard]] std::size_t edgeClasses() const { return edges_.size(); }
    [[nodiscard]] std::size_t vertexClasses() const { return vertices_.size(); }

private:
    const std::vector<float>& values(const EdgeRings& rings);

    std::map<Key, std::vector<float>> edges_;     // sidePoints values a slot
    std::map<Key, std::vector<float>> vertices_;  // one value a slot
};

}  // namespace tessera::subdivision
