// glTF's extension TESSERA_subdivision_surface (docs/formats.md): primitives that are cages.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "formats/mesh_notes.h"
#include "tessera/cage.h"

namespace tessera {

// What one primitive says, all numbers of vertices being of its POSITION accessor.
struct GltfCage {
    Cage tags;                      // without points
    std::uint64_t vertices = 0;     // of the accessor: all numbers are below
    std::uint32_t highestHole = 0;  // of holes; 0 where there are none
    bool tagged = false;            // whether the extension is there
    bool ngons = false;             // whether its triangles are fans of polygons (FB_ngon_encoding), which some Assimps do not tell
};

class GltfSubdivision {
public:
    // Reads the JSON of a .gltf file or of a .glb file's first chunk; `bytes` are the whole file. A file without the extension has no cages
    // here, whatever else may be wrong with it. Fails in `notes`, naming mesh and primitive, on members of other types than the extension's
    // and on numbers out of range.
    GltfSubdivision(std::string_view bytes, const MeshNotes& notes);

    [[nodiscard]] bool empty() const { return cages_.empty(); }

    // The file with names of meshes that tell their numbers: what Assimp reads says which primitive it was by its name alone.
    [[nodiscard]] const std::string& numbered() const { return numbered_; }

    // For a mesh that Assimp made of the numbered file, by its name there: how it is called in the file, and its cage where it is one.
    struct Primitive {
        std::string name;
        const GltfCage* cage = nullptr;
    };
    [[nodiscard]] Primitive find(std::string_view numberedName) const;

private:
    std::map<std::pair<std::size_t, std::size_t>, GltfCage> cages_;  // by mesh and primitive
    std::map<std::size_t, std::string> names_;                       // of meshes that have one
    std::string numbered_;
};

}  // namespace tessera
