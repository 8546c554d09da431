// Control cages of subdivision surfaces, as modellers and files have them.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

enum class SubdivisionScheme : std::uint32_t {
    catmullClark,
    loop,      // triangles only
    bilinear,  // faces stay as flat as they are; no smoothing
    none,      // polygons: triangles with smooth normals (tessera/triangles.h), no subdivision
};

[[nodiscard]] std::string_view name(SubdivisionScheme scheme);  // "catmull-clark", "loop", "bilinear", "none"

// What happens along edges of a single face (RenderMan's interpolateboundary, with its numbers).
enum class BoundaryRule : std::uint32_t {
    none = 0,           // faces with a boundary edge or vertex are not drawn
    edgeAndCorner = 1,  // boundary edges are creases, vertices of a single face are corners
    edgeOnly = 2,       // boundary edges are creases
};

// An edge sharp for some levels of subdivision (DeRose, Kass, Truong: "Subdivision Surfaces in Character Animation", 1998).
struct Crease {
    std::uint32_t a = 0, b = 0;  // the edge's vertices, in either order
    float sharpness = 10.0F;     // 0 and above; 10 and above: for ever
};

struct Corner {
    std::uint32_t vertex = 0;
    float sharpness = 10.0F;  // as a crease's
};

// Objects name cages as they name meshes; names of both are of one space. subdivide() (tessera/subdivision.h) makes meshes of them.
struct Cage {
    std::string name;
    SubdivisionScheme scheme = SubdivisionScheme::catmullClark;
    BoundaryRule boundary = BoundaryRule::edgeAndCorner;
    std::vector<glm::vec3> points;
    std::vector<std::uint32_t> faceSizes;     // corners of each face
    std::vector<std::uint32_t> faceVertices;  // face after face, counter-clockwise seen from outside
    std::vector<Crease> creases;
    std::vector<Corner> corners;
    std::vector<std::uint32_t> holes;  // faces that shape the surface but are not drawn
    // Face-varying coordinates: values, and which of them each corner of each face has. Both empty: there are none.
    std::vector<glm::vec2> texturePoints;
    std::vector<std::uint32_t> faceTexturePoints;  // as many as faceVertices

    [[nodiscard]] std::size_t faceCount() const { return faceSizes.size(); }
};

}  // namespace tessera
