// What readers of cages have in common: equal items numbered alike, lists without what is not used, faces that cannot be drawn.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/mesh_notes.h"
#include "tessera/cage.h"

namespace tessera {

// For each key a number, the same for equal ones, counting up by first appearance. At most 2^32 - 1 keys.
[[nodiscard]] std::vector<std::uint32_t> numberEqual(std::span<const std::array<std::uint32_t, 3>> keys);

// The numbers of `used`, sorted, each once; `used` become places in that list.
[[nodiscard]] std::vector<std::uint32_t> renumber(std::vector<std::uint32_t>& used);

// Turns every face of the cage round; each keeps its first corner.
void turnFaces(Cage& cage);

// Removes faces with a corner that is not finite or beyond 1e9, which Scene::validate() refuses, and tells of it; such points move to the
// origin, such texture points to 0. Requires lists that fit each other, and corners that exist; holes that are no faces stay such.
void dropUnplacedFaces(Cage& cage, const MeshNotes& notes);

}  // namespace tessera
