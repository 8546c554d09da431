// The rows of the paper's tables.
#include "mesh/mesh_scenes.h"

#include "bench_scenes.h"

#include <algorithm>
#include <utility>

namespace tessera::bench {

namespace {

const char* const kKilleroo = "killeroo";

}  // namespace

std::vector<MeshTrial> meshTrials(const std::string& folder) {
    std::vector<MeshTrial> trials;
    trials.push_back({"tea_table", 1, 332, "camera", teaTable});
    const std::vector<SceneSource> files = fileScenes(folder);
    const auto file = std::find_if(files.begin(), files.end(), [](const SceneSource& source) { return source.name == kKilleroo; });
    if (file != files.end()) {
        trials.push_back({kKilleroo, 1, 0, "", file->make});
        trials.push_back({"killeroo_herd", 1, 0, "", [make = file->make] { return herd(make()); }});
    }
    trials.push_back({"spheres_far", 1, 32000, "far", sphereCloud});
    trials.push_back({"spheres_near", 1, 32000, "near", sphereCloud});
    trials.push_back({"double_torus", 2, 1536, "camera", doubleTorus});
    trials.push_back({"star_field_far", 2, 41496, "far", starField});
    trials.push_back({"star_field_close", 2, 41496, "close", starField});
    trials.push_back({"zoo", 2, 80578, "camera", zoo});
    return trials;
}

}  // namespace tessera::bench
