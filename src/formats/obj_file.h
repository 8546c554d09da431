// An OBJ file's polygons and OpenSubdiv's tags, as they stand in the file.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/mesh_notes.h"
#include "tessera/cage.h"

namespace tessera {

struct ObjFile {
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    struct Face {
        std::uint32_t size = 0;          // corners; at least 1
        std::uint32_t object = 0;        // index into objects
        std::uint32_t material = kNone;  // index into materials
    };

    std::vector<glm::vec3> points;
    std::vector<glm::vec2> texturePoints;
    std::vector<Face> faces;
    std::vector<std::uint32_t> faceVertices;       // below points.size()
    std::vector<std::uint32_t> faceTexturePoints;  // below texturePoints.size(), or kNone; as many as faceVertices
    std::vector<std::string> objects{""};          // names; the first is empty: faces before any o line. Each once, also without faces
    std::vector<std::string> materials;            // names
    std::vector<std::string> materialFiles;        // mtllib lines, each once
    std::vector<Crease> creases;                   // of vertices below points.size()
    std::vector<Corner> corners;
    std::vector<std::uint32_t> holes;  // below faces.size()
    std::optional<BoundaryRule> boundary;
    bool tagged = false;  // whether there was a t line
};

// Whether a line of `text` begins with "t": OpenSubdiv's tags make it a subdivision surface.
[[nodiscard]] bool hasObjTags(std::string_view text);

// Fails in `notes`, naming the line, on numbers that are none, corners and tags of vertices or faces that do not exist, tags whose lists
// are not as long as announced. Memory is bounded by a small multiple of the text. Points may be not finite.
[[nodiscard]] ObjFile parseObj(std::string_view text, const MeshNotes& notes);

}  // namespace tessera
