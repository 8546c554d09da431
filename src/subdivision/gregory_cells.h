// Cages as few patches: Gregory patches where the limit surface is no polynomial (Loop, Schaefer, Ni, Castano: "Approximating
// Subdivision Surfaces with Gregory Patches for Hardware Tessellation", 2009), made by OpenSubdiv in double precision.
#pragma once

#include <glm/glm.hpp>

#include <span>
#include <vector>

#include "subdivision/cells.h"
#include "subdivision/quad_domains.h"
#include "subdivision/refiner.h"

namespace tessera::subdivision {

// Edges and vertices sharper than this, and not for ever so, are isolated no deeper: cells of this level are taken for smooth.
inline constexpr int kDeepestGregoryLevel = 6;

// Which faces are halved, and how often. Nothing asks for it but: faces of other than four corners (once); edges and vertices sharp for
// some levels (as many, up to kDeepestGregoryLevel); darts and tips, that is vertices of a single edge that is sharp for ever, or sharp
// for ever themselves without any such edge, which OpenSubdiv's Gregory patches miss by a tenth of a face (three times).
struct GregoryIsolation {
    int level = 0;           // how many times at most
    int irregularLevel = 0;  // and down to which level what is merely irregular, in these faces
    std::vector<int> faces;  // of the cage, those at a vertex that asks for it
};

[[nodiscard]] GregoryIsolation gregoryIsolation(const Refiner& refiner);

// Cells that cover all domains, domain after domain: one each but in faces that are halved. Those with a regular neighbourhood are bicubic
// and exact. The others' corners lie on the limit surface (of a dart, nearly), but their normals there are OpenSubdiv's approximation:
// they may be off by some degrees at an irregular vertex, by the same on all sides. `refiner` is unrefined, of scheme Catmark or bilinear,
// and only read.
[[nodiscard]] std::vector<Cell> gregoryCells(const Refiner& refiner, std::span<const glm::vec3> points, const QuadDomains& domains);

}  // namespace tessera::subdivision
