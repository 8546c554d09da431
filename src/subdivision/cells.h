// Pieces of quadrilaterals that are one patch each, and how they are put together.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

#include "subdivision/quad_domains.h"
#include "tessera/scene.h"

namespace tessera::subdivision {

// A patch over [u, u + 1] / 2^levelU times [v, v + 1] / 2^levelV of a domain.
struct Cell {
    std::uint32_t domain = 0;
    std::uint32_t levelU = 0, levelV = 0;  // at most 15
    std::uint32_t u = 0, v = 0;
    PatchKind kind = PatchKind::bezier;    // or gregory
    std::array<glm::dvec3, 20> points{};   // pointsPerPatch(kind) of them, in its order
    std::array<glm::dvec2, 16> texture{};  // Mesh::textureNets, where the cage has texture coordinates
};

struct StitchedMeshes {
    Mesh bezier;                                               // without a name
    Mesh gregory;                                              // may be empty
    std::vector<std::uint32_t> bezierDomains, gregoryDomains;  // of each patch
};

// The cells of a cage as meshes whose neighbours meet to the bit: corners are shared by place, borders by edge records. Cells must cover
// the domains without overlap. Where borders on both sides of a line do not end at the same places those of the coarser bicubic cells are
// cut, so that no border has neighbours more than three times halved.
[[nodiscard]] StitchedMeshes stitch(const QuadDomains& domains, std::vector<Cell> cells, bool textured);

}  // namespace tessera::subdivision
