// A tessellation's statistics as JSON.
#pragma once

#include "mesh_output.h"
#include "tessera/subdivision.h"
#include "tessera/subdivision_tables.h"
#include "tessera/tessellator.h"

#include <string>
#include <vector>

namespace tessera::program {

// What a mesh was made from, and what it became.
struct MeshReport {
    std::string scene;
    TessellateOptions options;
    MeshStatistics statistics;
    WrittenMesh written;
    double totalMs = 0;             // wall clock, from the first command to the file's name, writing included
    std::vector<CageReport> cages;  // what the scene's became ("subdivision")
};

// The same of cages by tables.
struct TableReport {
    std::string scene;
    TableOptions options;
    TableStatistics statistics;
    WrittenMesh written;
    double totalMs = 0;
};

// One object: counts, times in milliseconds ("..._ms"), memory in bytes. What the options do not have is null: of "tolerance" and
// "pixel_error" one, and with the latter "camera", "width" and "height".
[[nodiscard]] std::string meshStatsJson(const MeshReport& report);

// The same names where they mean the same; "level" is null where a tolerance or a pixel error is given.
[[nodiscard]] std::string tableStatsJson(const TableReport& report);

}  // namespace tessera::program
