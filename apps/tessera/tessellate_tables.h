// `tessera tessellate --method tables`: Catmull-Clark surfaces by tables of coefficients.
#pragma once

#include "mesh_output.h"
#include "tessellate_arguments.h"

namespace tessera::program {

// Writes the mesh to `output`, and statistics. Requires checked arguments; throws Error, and UsageError on a scene without cages.
void tessellateTables(const TessellateArguments& arguments, Interrupt& interrupt, MeshOutput& output);

}  // namespace tessera::program
