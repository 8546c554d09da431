// Assimp's lights and cameras made Tessera's.
#pragma once

#include "formats/mesh_notes.h"
#include "tessera/scene.h"

#include <assimp/scene.h>
#include <glm/glm.hpp>

#include <functional>

namespace tessera {

// The world matrix of the node of that name; identity where there is none.
using NodePlace = std::function<glm::dmat4(const aiString&)>;

// Both leave out, and tell, what has no counterpart or no sense.
void addMeshLights(const aiScene& source, const NodePlace& place, const MeshNotes& notes, Scene& scene);
void addMeshCameras(const aiScene& source, const NodePlace& place, const MeshNotes& notes, Scene& scene);

}  // namespace tessera
