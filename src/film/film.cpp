#include "film/film.h"

#include <utility>

namespace tessera {
namespace {

// As fillBuffer takes it: whole words.
constexpr std::uint64_t wholeWords(std::uint64_t bytes) { return (bytes + 3) & ~std::uint64_t{3}; }

}  // namespace

void Film::prepare(const FilmLayout& layout, FilmExtras extras) {
    const bool wasClean = std::exchange(clean_, false);
    DeviceMemory& memory = session_.memory;
    memory.ensure(referencePatch_, Purpose::film, "the samples' patches", layout.samples * 4);
    memory.ensure(referenceU_, Purpose::film, "the samples' u", layout.samples * 4);
    memory.ensure(referenceV_, Purpose::film, "the samples' v", layout.samples * 4);
    if (!extras.coarseDepth) coarse_ = DeviceBuffer();
    if (!extras.normals) normals_ = DeviceBuffer();
    if (extras.normals) memory.ensure(normals_, Purpose::film, "the samples' normals", layout.samples * 12);
    if (extras.coarseDepth) memory.ensure(coarse_, Purpose::film, "the film's coarse depth", coarseBytes(layout));
    // Shading leaves samples and tiles empty, so they are filled only when new, larger, or after a frame that broke off.
    const bool fresh = memory.ensure(samples_, Purpose::film, "the film's samples", layout.samples * 8);
    const bool freshTiles =
        memory.ensure(touched_, Purpose::film, "the film's tiles", wholeWords(static_cast<std::uint64_t>(layout.tiles)));
    if (fresh || freshTiles || !wasClean) {
        session_.timeline.fill(samples_.cl(), 0xffffffffU, samples_.bytes());
        session_.timeline.fill(touched_.cl(), 0, touched_.bytes());
        session_.timeline.finish();
    }
    clean_ = true;
}

void Film::release() {
    for (DeviceBuffer* const buffer : {&samples_, &touched_, &referencePatch_, &referenceU_, &referenceV_, &coarse_, &normals_}) {
        *buffer = DeviceBuffer();
    }
    clean_ = false;
}

void Film::enqueueForgetDepth(const FilmLayout& layout) { session_.timeline.fill(coarse_.cl(), 0xffffffffU, coarseBytes(layout)); }

void Film::enqueueAfterHiding(const frame_params& frame, const split_limits& limits, SplitQueues& queues) {
    Kernels& kernels = session_.kernels;
    if (frame.occlusion != 0) {
        session_.launch(kernels.with("coarse_depth", frame, limits, queues.state(), samples_.cl(), touched_.cl(), coarse_.cl()),
                        "coarse_depth");
    }
    session_.launch(kernels.with("resolve_samples", frame, limits, queues.state(), queues.stateAfter(), queues.ready(), samples_.cl(),
                                 touched_.cl(), referencePatch_.cl(), referenceU_.cl(), referenceV_.cl()),
                    "resolve_samples");
    queues.passState();
}

}  // namespace tessera
