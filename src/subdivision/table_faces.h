// A cage's quadrilaterals with their tables, after some steps of subdivision.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "subdivision/refiner.h"
#include "subdivision/table_build.h"
#include "tables/tables_shared.h"

namespace tessera::subdivision {

// One side of a face, from corner k to k + 1 of its table.
struct FaceSide {
    std::uint32_t edge = 0;
    bool reversed = false;  // whether the side runs against the edge
};

// Faces that are drawn, those of the same table one after the other.
struct TableFaces {
    int steps = 0;             // of Catmull-Clark from the cage
    std::uint32_t points = 0;  // control points at this step
    std::uint32_t edges = 0;
    std::vector<table_face> faces;                      // `first_entry` counts in the lists below
    std::vector<std::array<FaceSide, 4>> sides;         // of each face
    std::vector<std::array<std::uint32_t, 4>> corners;  // vertices at the table's corners
    // Of each face as many entries as its table has rows.
    std::vector<std::uint32_t> byRow;     // control points in the order of the table's rows
    std::vector<std::uint32_t> byNumber;  // the same, rising
    std::vector<std::uint16_t> rowOf;     // of each of byNumber
    // How the points come from the cage's: empty at step 0. Point i: the entries from starts[i] to starts[i + 1].
    std::vector<std::uint32_t> starts;
    std::vector<std::uint32_t> sources;
    std::vector<float> weights;
};

// Whether the cage has faces of other than four corners, so that tables need a step first.
[[nodiscard]] bool needsStep(const Refiner& refiner);

// Refines `refiner`, which must not be refined yet, and fills `store` with the tables that are not there. Throws Error where a ring has
// more than 65536 control points.
[[nodiscard]] TableFaces makeTableFaces(Refiner& refiner, int steps, TableStore& store);

}  // namespace tessera::subdivision
