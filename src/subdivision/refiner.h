// OpenSubdiv's view of a clean cage.
#pragma once

#include <opensubdiv/far/topologyRefiner.h>

#include <memory>

#include "tessera/cage.h"

namespace tessera::subdivision {

using Refiner = OpenSubdiv::Far::TopologyRefiner;

// Requires a cage from cleanCage(); face-varying coordinates become channel 0. Throws Error naming the cage on what OpenSubdiv refuses.
[[nodiscard]] std::unique_ptr<Refiner> makeRefiner(const Cage& cage);

}  // namespace tessera::subdivision
