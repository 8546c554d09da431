// Dicing and hiding a batch: launches dice_hide (dice_hide.cl).
#pragma once

#include "device/session.h"
#include "film/film.h"
#include "split/queues.h"
#include "surface/patch_set.h"

namespace tessera {

// Hides the ranges that are ready, when the device finds that it is time (film/batch.clh). In two passes of 32-bit atomics where the
// device lacks 64-bit ones, or `emulateAtomics` says so.
void enqueueDiceHide(DeviceSession& session, const frame_params& frame, const split_limits& limits, const SplitQueues& queues,
                     const PatchSet& patches, const Film& film, bool emulateAtomics);

}  // namespace tessera
