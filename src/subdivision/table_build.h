// Tables of coefficients: what each control point of a quadrilateral's ring adds to the limit surface at 33 x 33 points.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "subdivision/table_classes.h"
#include "subdivision/table_ring.h"

namespace tessera::subdivision {

inline constexpr std::uint32_t tablePoints = sidePoints * sidePoints;

// Point (i, j), at (u, v) = (i, j) / 32 with corner 0 of the ring at (0, 0), is number 33 j + i of a row.
struct RingTable {
    std::uint32_t rows = 0;                    // control points: the ring's positions, or its distinct vertices
    std::array<std::vector<float>, 3> values;  // position, tangents along u and v; rows of tablePoints
    // How much less far each level from 5 on moves the mesh than the one before: the square of the greatest sum of magnitudes of second
    // differences of level 5 by that of level 4, a quarter at least.
    float decay = 0.25F;
};

// The limit surface at each of the points exactly, rounded once; on the sides the values of `classes`. Tangents have their exact
// directions; at corners, where they may have no length, one that suits their neighbours'. Positions with the same vertex share a row:
// `repeats` as repeatsOf() gives them.
[[nodiscard]] RingTable makeRingTable(const FaceRing& ring, const Key& repeats, SymmetryClasses& classes);

// All tables there are. Those that cages share are made once.
class TableStore {
public:
    // The table of a ring: a number that stays.
    [[nodiscard]] std::uint32_t tableOf(const FaceRing& ring);
    [[nodiscard]] const std::vector<RingTable>& tables() const { return tables_; }
    [[nodiscard]] const SymmetryClasses& classes() const { return classes_; }

private:
    std::map<std::pair<Key, Key>, std::uint32_t> numbers_;  // by ringKey() and repeatsOf()
    std::vector<RingTable> tables_;
    SymmetryClasses classes_;
};

}  // namespace tessera::subdivision
