// Shading what is seen and filtering it into the picture: launches shade_tiles (shade.cl).
#pragma once

#include "device/session.h"
#include "film/film.h"
#include "film/picture_shared.h"
#include "split/queues.h"
#include "surface/patch_set.h"

namespace tessera {

struct ShadeInputs {
    const PatchSet& patches;
    const cl::Buffer& objects;  // placed_object
    const cl::Buffer& lights;   // eye_light, frame_params::lights of them
    const SplitQueues& queues;  // whose last batch is still in `ready`; counts the pixels covered
};

// Shades the film into `picture` (planes as `planes` says); the film is background again afterwards.
void enqueueShade(DeviceSession& session, const frame_params& frame, const picture_planes& planes, const ShadeInputs& inputs,
                  const Film& film, const cl::Buffer& picture);

}  // namespace tessera
