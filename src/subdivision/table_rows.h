// Tables as the device has them: rows by level, in the order of a pattern's vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "subdivision/table_build.h"
#include "tables/tables_shared.h"

namespace tessera::subdivision {

// Points of a row of a level, padding included.
[[nodiscard]] std::uint32_t paddedColumns(std::uint32_t level);

// Rows of all tables, one after the other: positions, or tangents along u and v in turn.
[[nodiscard]] std::vector<float> positionRows(const std::vector<RingTable>& tables, std::uint32_t level);
[[nodiscard]] std::vector<float> tangentRows(const std::vector<RingTable>& tables, std::uint32_t level);
// What levels.cl measures, three rows a control point: new points of each level less the middles of the lines they lie on; these lines;
// lines across them.
[[nodiscard]] std::vector<float> deviationRows(const std::vector<RingTable>& tables);
// u, then v, of all levels' points.
[[nodiscard]] std::vector<float> placeRows();
[[nodiscard]] std::vector<table_info> tableInfos(const std::vector<RingTable>& tables);

}  // namespace tessera::subdivision
