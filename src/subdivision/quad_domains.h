// The quadrilaterals that a cage's patches lie in: its faces of four corners, and a quadrilateral for each corner of all others.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "subdivision/refiner.h"

namespace tessera::subdivision {

// A line is an edge of the cage, from its first to its second vertex as OpenSubdiv numbers them, or the way from an edge's middle to the
// middle of a face of other than four corners.
struct DomainSide {
    std::uint32_t line = 0;
    bool half = false;       // whether the side is half of the line
    std::uint32_t part = 0;  // then which: 0 from its start to the middle, 1
    bool reversed = false;   // whether the side's parameter falls along the line
};

struct QuadDomain {
    std::uint32_t face = 0;     // of the refiner's cage
    std::int32_t subFace = -1;  // -1: all of a face of four corners; else the corner that (0, 0) is; (1, 1) is then the face's middle
    std::array<std::uint32_t, 4> corners{};  // (0, 0), (1, 0), (1, 1), (0, 1): numbers of points: vertices first, then edges' middles, then
                                             // faces' middles
    std::array<DomainSide, 4> sides{};       // as in EdgeRecord (tessera/scene.h): v = 0, u = 1, v = 1, u = 0
};

struct QuadDomains {
    std::vector<QuadDomain> domains;        // face after face; none of holes
    std::uint32_t vertices = 0, edges = 0;  // the cage's; the lowest lines are its edges
    std::uint32_t lines = 0;
    std::uint32_t points = 0;
};

[[nodiscard]] QuadDomains makeDomains(const Refiner& refiner);

}  // namespace tessera::subdivision
