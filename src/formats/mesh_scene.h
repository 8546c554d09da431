// Assimp's scene made Tessera's.
#pragma once

#include "formats/mesh_notes.h"
#include "tessera/scene.h"

#include <assimp/scene.h>

#include <optional>

namespace tessera {

class GltfSubdivision;

// What is made of polygons.
struct MeshReading {
    bool flat = false;                        // of triangles: plain ones
    bool cages = false;                       // cages, of what is to be subdivided
    std::optional<SubdivisionScheme> scheme;  // of cages: all are, of this scheme; nothing: those that `subdivision` has
    const GltfSubdivision* subdivision = nullptr;
};

enum class MeshFaces {
    triangles,  // at most
    polygons,   // some have more corners
};

// Fails in `notes` on what Assimp's later steps and makeMeshScene() take for granted and some of its readers do not keep: indices of
// corners, meshes and materials; also on faces too large to cut into triangles in reasonable time.
[[nodiscard]] MeshFaces checkMeshScene(const aiScene& source, const MeshNotes& notes);

// Requires a checked scene; of polygons that become triangles, a scene of triangles (others are left out). A node whose transform is rigid
// becomes an object's transform; any other is worked into a copy of the mesh's points, so that nodes with the same one share the copy.
[[nodiscard]] Scene makeMeshScene(const aiScene& source, const MeshReading& reading, const MeshNotes& notes);

}  // namespace tessera
