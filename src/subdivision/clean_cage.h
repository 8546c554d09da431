// Cages as OpenSubdiv can take them, and as far as sense goes the surface that was meant.
#pragma once

#include <cstdint>
#include <vector>

#include "tessera/subdivision.h"

namespace tessera::subdivision {

struct CleanCage {
    // Manifold, neighbours turned the same way, every vertex used, tags on edges and vertices that exist, each once; a crease's sharpness
    // within 0 to 10.
    Cage cage;
    std::vector<std::uint32_t> faceOf;    // of the given cage
    std::vector<std::uint32_t> vertexOf;  // of the given cage: several may come from one that was taken apart
};

// Repairs `cage` and tells of it in `report`; edges whose faces' normals differ by more than `creaseAngle` degrees become creases.
// Throws Error naming the cage where lists do not fit each other (face sizes that do not add up, texture numbers that do not exist) or
// numbers pass 32 bits. May return a cage without faces.
[[nodiscard]] CleanCage cleanCage(const Cage& cage, double creaseAngle, CageReport& report);

}  // namespace tessera::subdivision
