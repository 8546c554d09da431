// Cages in .mscene files.
#pragma once

#include <cstddef>

#include "formats/mscene_reading.h"
#include "tessera/cage.h"

#include "mscene.capnp.h"

namespace tessera {

// Fails, naming the cage, on lists of coordinates that are not whole points, and on schemes and rules that do not exist. Whether its lists
// fit each other is a matter of those who use the cage.
[[nodiscard]] Cage readCage(const MsceneReading& reading, schema::Cage::Reader source, std::size_t index);

// Throws Error on lists that are too long for the format.
void writeCage(schema::Cage::Builder target, const Cage& cage);

}  // namespace tessera
