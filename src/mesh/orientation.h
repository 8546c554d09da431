// Which patches of a scene run the other way round than their neighbours: a mesh for printing or for culling wants all of its triangles to
// turn one way, and files do not care how their patches' (u, v) run.
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/scene.h"

namespace tessera {

// A bit a placed patch, in the order of PatchSource, 32 a word: set where the patch must be turned so that it agrees with its neighbours
// along common borders, equal to the bit or by records (weld()). In each connected piece the fewer patches turn, or of equally many those
// that its first patch is not among. Borders that three patches or more share decide nothing, nor do one-sided surfaces agree.
// Time and memory in proportion to the placed patches.
[[nodiscard]] std::vector<std::uint32_t> turnedPatches(const Scene& scene);

}  // namespace tessera
