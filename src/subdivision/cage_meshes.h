// One cage made meshes.
#pragma once

#include <vector>

#include "tessera/subdivision.h"

namespace tessera::subdivision {

// Fills in what `report` tells of a clean cage of this scheme: faces that are no holes, vertices, tags, boundaries.
void countCage(const Cage& cage, CageReport& report);

// None where nothing of the cage can be drawn; two where there are patches of two kinds. The first has the cage's name, but Gregory patches
// are "NAME gregory". `cage`'s scheme is the one to use.
[[nodiscard]] std::vector<Mesh> cageMeshes(const Cage& cage, const SubdivisionOptions& options, CageReport& report);

}  // namespace tessera::subdivision
