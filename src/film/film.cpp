#include "film/film.h"

#include <cmath>

#include "tessera/error.h"

namespace tessera {
namespace {

constexpr cl_uint hideAll = 0;  // HIDE_ALL, HIDE_DEPTH, HIDE_ID of film/hide.clh
constexpr cl_uint hideDepth = 1;
constexpr cl_uint hideId = 2;

// The kernels' tile arithmetic is exact below this (film/hide.clh).
constexpr std::uint64_t mostSamples = std::uint64_t{1} << 30;

// RenderMan's rule for CropWindow: pixels from ceil(size x0) up to, not including, ceil(size x1), so that windows that share an
// edge share no pixel.
int cropEdge(float fraction, int size) { return static_cast<int>(std::ceil(static_cast<double>(fraction) * size)); }

constexpr std::int64_t roundedUp(std::int64_t value, std::int64_t step) { return (value + step - 1) / step; }

}  // namespace

FilmLayout layOutFilm(const RenderOptions& options) {
    FilmLayout layout;
    layout.x0 = cropEdge(options.crop[0], options.width);
    layout.y0 = cropEdge(options.crop[2], options.height);
    layout.width = cropEdge(options.crop[1], options.width) - layout.x0;
    layout.height = cropEdge(options.crop[3], options.height) - layout.y0;
    if (layout.width < 1 || layout.height < 1) throw Error("crop window holds no pixel of the picture; make it larger");
    const int n = options.pixelSamples;
    layout.pixelSamples = n;
    layout.tileCells = n * ((8 + n - 1) / n);
    const std::int64_t tilesX = roundedUp(std::int64_t{layout.width} * n, layout.tileCells);
    const std::int64_t tilesY = roundedUp(std::int64_t{layout.height} * n, layout.tileCells);
    layout.samples = static_cast<std::uint64_t>(tilesX * tilesY * layout.tileCells * layout.tileCells);
    if (layout.samples >= mostSamples) {
        throw Error("a picture of " + std::to_string(layout.width) + "x" + std::to_string(layout.height) + " with " + std::to_string(n) +
                    "x" + std::to_string(n) + " samples a pixel would need " + bytesText(layout.samples * 20) +
                    " for its samples, more than one frame can hold; use a smaller --size, --pixel-samples or --crop");
    }
    layout.tilesX = static_cast<int>(tilesX);
    layout.tiles = static_cast<int>(tilesX * tilesY);
    return layout;
}

void Film::prepare(const FilmLayout& layout) {
    DeviceMemory& memory = session_.memory;
    memory.ensure(referencePatch_, "the samples' patches", layout.samples * 4);
    memory.ensure(referenceU_, "the samples' u", layout.samples * 4);
    memory.ensure(referenceV_, "the samples' v", layout.samples * 4);
    // shade_tiles leaves samples and tiles empty, so they are filled only when new, larger, or after a frame that broke off.
    const bool fresh = memory.ensure(samples_, "the film's samples", layout.samples * 8);
    const bool freshTiles = memory.ensure(touched_, "the film's tiles", (static_cast<std::uint64_t>(layout.tiles) + 3) & ~std::uint64_t{3});
    if (fresh || freshTiles || !clean_) {
        session_.timeline.fill(samples_.cl(), 0xffffffffU, samples_.bytes());
        session_.timeline.fill(touched_.cl(), 0, touched_.bytes());
        session_.timeline.finish();
    }
    clean_ = true;
}

void Film::enqueueBatch(const frame_params& frame, const split_limits& limits, const SplitQueues& queues, const PatchSet& patches,
                        bool emulateAtomics) {
    Kernels& kernels = session_.kernels;
    const auto hide = [&](cl_uint pass) {
        session_.launch(kernels.with("dice_hide", frame, limits, queues.state(), queues.ready(), patches.eyePoints.cl(), samples_.cl(),
                                     touched_.cl(), pass),
                        "dice_hide");
    };
    if (emulateAtomics || !session_.device.info.atomics64) {
        hide(hideDepth);
        hide(hideId);
    } else {
        hide(hideAll);
    }
    session_.launch(kernels.with("resolve_samples", frame, limits, queues.state(), queues.ready(), samples_.cl(), touched_.cl(),
                                 referencePatch_.cl(), referenceU_.cl(), referenceV_.cl()),
                    "resolve_samples");
    session_.timeline.launch(kernels.with("batch_done", frame, limits, queues.state()), "batch_done", 1, 1);
}

void Film::enqueueShade(const frame_params& frame, const picture_planes& planes, const ShadeInputs& inputs) {
    session_.launch(session_.kernels.with("shade_tiles", frame, planes, inputs.patches.eyePoints.cl(), inputs.patches.placed.cl(),
                                          inputs.objects, inputs.lights, referencePatch_.cl(), referenceU_.cl(), referenceV_.cl(),
                                          inputs.queues.ready(), samples_.cl(), touched_.cl(), inputs.picture, inputs.queues.state()),
                    "shade_tiles");
}

}  // namespace tessera
