// Shading what is seen and filtering it into the picture: at once where all patches are on the device (shade.cl), else chunk by chunk of
// patches (shade_chunk.cl). Both give the same bits.
#pragma once

#include <cstdint>

#include "device/session.h"
#include "film/film.h"
#include "film/picture_shared.h"
#include "split/queues.h"
#include "surface/patch_set.h"

namespace tessera {

struct ShadeInputs {
    const PatchSet& patches;
    const cl::Buffer& lights;   // eye_light, frame_params::lights of them
    const SplitQueues& queues;  // whose last batch is still in `ready`; counts the pixels covered
};

// Shades the film into `picture` (planes as `planes` says); the film is background again afterwards. Where the device finds that the
// bucket is not drawn to its end (film/batch.clh) it changes nothing.
void enqueueShade(DeviceSession& session, const frame_params& frame, const picture_planes& planes, const ShadeInputs& inputs,
                  const Film& film, const cl::Buffer& picture);

// Of a film all of whose samples are resolved: makes flags[k] (uint, `chunks` of them) 1 where patches [k n, (k + 1) n) of the scene
// are seen, n = patchesEach, else 0.
void enqueueMarkChunks(DeviceSession& session, const frame_params& frame, const Film& film, std::uint32_t patchesEach, std::uint32_t chunks,
                       const cl::Buffer& flags);

// Shades the samples that show `inputs.patches`, a chunk of the scene whose counts and first patch `frame` holds. To be called once for
// every chunk that is seen, in any order, then enqueueFilter(). Requires a film prepared with normals where planes.normal is wanted.
void enqueueShadeChunk(DeviceSession& session, const frame_params& frame, const picture_planes& planes, const ShadeInputs& inputs,
                       const Film& film, const cl::Buffer& picture);

// Filters what the chunks left in the film into `picture`; the film is background again afterwards. Counts the pixels covered.
void enqueueFilter(DeviceSession& session, const frame_params& frame, const picture_planes& planes, const SplitQueues& queues,
                   const Film& film, const cl::Buffer& picture);

}  // namespace tessera
