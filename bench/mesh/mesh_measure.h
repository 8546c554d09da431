// Tessellations that are measured: of the paper's scenes by a pixel error, and of the sheet by a tolerance that gives a rate.
#pragma once

#include "tessera/scene.h"
#include "tessera/tessellator.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tessera::bench {

// Something to measure. Names are "table1/tea_table", "sheet/8/full", "equal/8/positions".
struct MeshMeasurement {
    std::string name;
    std::function<Scene()> make;
    std::string camera;          // a scene's: it is seen in 1024x768 pixels with an error of half a pixel; "" its first, or a framing one
    int rate = 0;                // above 0: without a camera, at the tolerance that gives so many segments a side in the mean
    int along = 0;               // the sheet's patches a side, for the record; 0 of other scenes
    bool positionsOnly = false;  // vertices are positions alone
};

// The paper's rows, then the sheet at rates 4 to 64 in about a million cells, then a smaller one at rates that slower programs reach.
[[nodiscard]] std::vector<MeshMeasurement> meshMeasurements(const std::string& folder);

struct MeshMeasured {
    std::string name;
    MeshSizes sizes;
    double tolerance = 0;  // world units; 0 where it was a pixel error
    double distance = 0;   // of sheets in full: the greatest seen (mesh_distance.h); else 0
    int along = 0;
    std::map<std::string, std::vector<double>> ms;  // a value a run: place, factors, offsets, vertex, index, all (wall clock)
    std::string error;                              // where it failed; then nothing else is known
};

// Runs each frame anew, its factors too, as an animation would have to; one frame before is not measured.
[[nodiscard]] MeshMeasured measureMesh(Tessellator& tessellator, const MeshMeasurement& what, int runs);

}  // namespace tessera::bench
