#include "shade/shade.h"

namespace tessera {

void enqueueShade(DeviceSession& session, const frame_params& frame, const picture_planes& planes, const ShadeInputs& inputs,
                  const Film& film, const cl::Buffer& picture) {
    session.launch(session.kernels.with("shade_tiles", frame, planes, inputs.patches.eyePoints.cl(), inputs.patches.placed.cl(),
                                        inputs.objects, inputs.lights, film.referencePatch(), film.referenceU(), film.referenceV(),
                                        inputs.queues.ready(), film.samples(), film.touched(), picture, inputs.queues.state()),
                   "shade_tiles");
}

}  // namespace tessera
