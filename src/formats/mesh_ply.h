// What a PLY file announces, checked before Assimp makes room for it.
#pragma once

#include "formats/mesh_notes.h"

#include <cstdint>
#include <string_view>

namespace tessera {

// `head` is how the file of `fileBytes` begins. Fails in `notes` on a header that is no PLY's or has no end, which some of Assimp's
// readers do not survive, and where it announces more of an element than there are bytes, for all of which they would take memory.
void checkPlyHeader(std::string_view head, std::uintmax_t fileBytes, const MeshNotes& notes);

}  // namespace tessera
