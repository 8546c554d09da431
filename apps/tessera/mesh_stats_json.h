// A tessellation's statistics as JSON.
#pragma once

#include "mesh_output.h"
#include "tessera/tessellator.h"

#include <string>

namespace tessera::program {

// What a mesh was made from, and what it became.
struct MeshReport {
    std::string scene;
    TessellateOptions options;
    MeshStatistics statistics;
    WrittenMesh written;
    double totalMs = 0;  // wall clock, from the first command to the file's name, writing included
};

// One object: counts, times in milliseconds ("..._ms"), memory in bytes. What the options do not have is null: of "tolerance" and
// "pixel_error" one, and with the latter "camera", "width" and "height".
[[nodiscard]] std::string meshStatsJson(const MeshReport& report);

}  // namespace tessera::program
