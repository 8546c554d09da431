#include "shade/shade.h"

namespace tessera {

void enqueueShade(DeviceSession& session, const frame_params& frame, const picture_planes& planes, const ShadeInputs& inputs,
                  const Film& film, const cl::Buffer& picture) {
    const PatchSet& patches = inputs.patches;
    session.launch(session.kernels.with("shade_tiles", frame, planes, patches.eyePoints.cl(), patches.placed.cl(), patches.objects.cl(),
                                        inputs.lights, film.referencePatch(), film.referenceU(), film.referenceV(), inputs.queues.ready(),
                                        film.samples(), film.touched(), picture, inputs.queues.state()),
                   "shade_tiles");
}

void enqueueMarkChunks(DeviceSession& session, const frame_params& frame, const Film& film, std::uint32_t patchesEach, std::uint32_t chunks,
                       const cl::Buffer& flags) {
    session.timeline.fill(flags, 0, chunks * sizeof(cl_uint));
    session.launch(session.kernels.with("mark_chunks", frame, patchesEach, film.referencePatch(), film.samples(), film.touched(), flags),
                   "mark_chunks");
}

void enqueueShadeChunk(DeviceSession& session, const frame_params& frame, const picture_planes& planes, const ShadeInputs& inputs,
                       const Film& film, const cl::Buffer& picture) {
    const PatchSet& patches = inputs.patches;
    session.launch(session.kernels.with("shade_chunk", frame, planes, patches.eyePoints.cl(), patches.placed.cl(), patches.objects.cl(),
                                        inputs.lights, film.referencePatch(), film.referenceU(), film.referenceV(), film.normals(),
                                        film.samples(), film.touched(), picture),
                   "shade_chunk");
}

void enqueueFilter(DeviceSession& session, const frame_params& frame, const picture_planes& planes, const SplitQueues& queues,
                   const Film& film, const cl::Buffer& picture) {
    session.launch(session.kernels.with("filter_tiles", frame, planes, film.referencePatch(), film.referenceU(), film.referenceV(),
                                        film.normals(), film.samples(), film.touched(), picture, queues.state()),
                   "filter_tiles");
}

}  // namespace tessera
