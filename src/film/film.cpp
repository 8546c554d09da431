#include "film/film.h"

#include <cmath>
#include <utility>

#include "tessera/error.h"

namespace tessera {
namespace {

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
    const bool wasClean = std::exchange(clean_, false);
    DeviceMemory& memory = session_.memory;
    memory.ensure(referencePatch_, "the samples' patches", layout.samples * 4);
    memory.ensure(referenceU_, "the samples' u", layout.samples * 4);
    memory.ensure(referenceV_, "the samples' v", layout.samples * 4);
    // shade_tiles leaves samples and tiles empty, so they are filled only when new, larger, or after a frame that broke off.
    const bool fresh = memory.ensure(samples_, "the film's samples", layout.samples * 8);
    const bool freshTiles = memory.ensure(touched_, "the film's tiles", (static_cast<std::uint64_t>(layout.tiles) + 3) & ~std::uint64_t{3});
    if (fresh || freshTiles || !wasClean) {
        session_.timeline.fill(samples_.cl(), 0xffffffffU, samples_.bytes());
        session_.timeline.fill(touched_.cl(), 0, touched_.bytes());
        session_.timeline.finish();
    }
    clean_ = true;
}

void Film::release() {
    for (DeviceBuffer* const buffer : {&samples_, &touched_, &referencePatch_, &referenceU_, &referenceV_}) *buffer = DeviceBuffer();
    clean_ = false;
}

void Film::enqueueResolve(const frame_params& frame, const split_limits& limits, const SplitQueues& queues) {
    Kernels& kernels = session_.kernels;
    session_.launch(kernels.with("resolve_samples", frame, limits, queues.state(), queues.ready(), samples_.cl(), touched_.cl(),
                                 referencePatch_.cl(), referenceU_.cl(), referenceV_.cl()),
                    "resolve_samples");
    session_.timeline.launch(kernels.with("batch_done", frame, limits, queues.state()), "batch_done", 1, 1);
}

}  // namespace tessera
