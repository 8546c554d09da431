// What tessera_mesh_bench tells: a table for people, JSON for bench/evaluate_mesh.py.
#pragma once

#include "mesh/mesh_measure.h"

#include <ostream>
#include <string>
#include <vector>

namespace tessera::bench {

// Of values that are at least one, in any order.
[[nodiscard]] double median(std::vector<double> values);

void printHeading(std::ostream& out);
void printRow(std::ostream& out, const MeshMeasured& measured);

// {"device": ..., "version": ..., "runs": ..., "measurements": [{"name": ..., "triangles": ..., "ms": {"vertex": [...]}}, ...]}; of one
// that failed the name and the error alone. Throws Error where the file cannot be written.
void writeJson(const std::string& path, const std::string& device, int runs, const std::vector<MeshMeasured>& all);

}  // namespace tessera::bench
