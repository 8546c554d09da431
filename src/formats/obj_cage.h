// Reads OBJ files as cages: Assimp loses the vertices' numbers and OpenSubdiv's tags.
#pragma once

#include <string_view>

#include "formats/mesh_access.h"
#include "formats/mesh_notes.h"
#include "tessera/scene.h"

namespace tessera {

// The polygons of `text` as cages of `scheme`, one and an object each for every o line's faces; groups and materials cut nothing, so that
// surfaces stay whole: an object has the colour of the material that most of its faces have. Where there is a single object, its points are
// all of the file's vertices, in order; else those that its faces use. Tags are as in OpenSubdiv's shapes, with vertices and faces counted
// from 0 over the whole file. Texture points are taken where all corners of an object have one. `folder` opens material files.
// Fails in `notes`, naming the line, on what parseObj() refuses, and where there is no face.
[[nodiscard]] Scene readObjCages(std::string_view text, SubdivisionScheme scheme, MeshFolder& folder, const MeshNotes& notes);

}  // namespace tessera
