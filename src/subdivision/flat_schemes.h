// The schemes that smooth nothing: bilinear, and polygons drawn as triangles.
#pragma once

#include <glm/glm.hpp>

#include <span>
#include <vector>

#include "subdivision/cells.h"
#include "subdivision/pn_cage.h"
#include "subdivision/refiner.h"
#include "tessera/subdivision.h"

namespace tessera::subdivision {

// A bilinear cell for each domain, with texture coordinates where `textures` (channel 0's values) has any.
[[nodiscard]] std::vector<Cell> bilinearCells(const Refiner& refiner, std::span<const glm::vec3> points,
                                              std::span<const glm::vec2> textures, const QuadDomains& domains);

// A clean cage's polygons without its holes, cut into triangles. Normals are those of the faces around a vertex, weighted by their angles;
// creases of any sharpness part them, and at corners of any sharpness each face has its own.
[[nodiscard]] CageTriangles polygonTriangles(const Cage& cage, CageReport& report);

}  // namespace tessera::subdivision
