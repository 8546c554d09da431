// PN triangles with what pnMesh() does not carry along: texture coordinates, and which triangle a patch is of.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "tessera/triangles.h"

namespace tessera::subdivision {

struct CageTriangles {
    TriangleMesh mesh;
    std::vector<std::array<glm::vec2, 3>> textures;  // one triple a triangle, or none at all
};

struct PnCage {
    Mesh mesh;
    std::vector<std::uint32_t> sources;  // of each patch, the triangle
    std::vector<bool> turned;            // of each patch: corners 1 and 2 have changed places
};

// Nothing where no triangle has an area.
[[nodiscard]] std::optional<PnCage> pnCage(const CageTriangles& triangles);

}  // namespace tessera::subdivision
