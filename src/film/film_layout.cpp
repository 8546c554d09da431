#include "film/film_layout.h"

#include <algorithm>
#include <cmath>

#include "device/memory.h"
#include "tessera/error.h"

namespace tessera {
namespace {

// Pixels from ceil(size x0) up to, not including, ceil(size x1), so that windows that share an edge share no pixel.
int cropEdge(float fraction, int size) { return static_cast<int>(std::ceil(static_cast<double>(fraction) * size)); }

constexpr std::uint64_t over(std::uint64_t value, std::uint64_t step) { return (value + step - 1) / step; }

std::uint64_t tilesAlong(int pixels, int pixelSamples) {
    return over(static_cast<std::uint64_t>(pixels), static_cast<std::uint64_t>(tilePixels(pixelSamples)));
}

}  // namespace

PixelWindow cropWindow(const RenderOptions& options) {
    PixelWindow window;
    window.x0 = cropEdge(options.crop[0], options.width);
    window.y0 = cropEdge(options.crop[2], options.height);
    window.width = cropEdge(options.crop[1], options.width) - window.x0;
    window.height = cropEdge(options.crop[3], options.height) - window.y0;
    if (window.width < 1 || window.height < 1) throw Error("crop window holds no pixel of the picture; make it larger");
    return window;
}

std::uint64_t filmSamples(int width, int height, int pixelSamples) {
    const auto side = static_cast<std::uint64_t>(tileCells(pixelSamples));
    return tilesAlong(width, pixelSamples) * tilesAlong(height, pixelSamples) * side * side;
}

FilmLayout layOutFilm(const PixelWindow& window, int pixelSamples) {
    FilmLayout layout;
    layout.x0 = window.x0;
    layout.y0 = window.y0;
    layout.width = window.width;
    layout.height = window.height;
    layout.pixelSamples = pixelSamples;
    layout.tileCells = tileCells(pixelSamples);
    layout.samples = filmSamples(window.width, window.height, pixelSamples);
    if (layout.samples >= filmSamplesEnd) {
        const std::string side = std::to_string(pixelSamples);
        throw Error("a picture of " + std::to_string(layout.width) + "x" + std::to_string(layout.height) + " with " + side + "x" + side +
                    " samples a pixel would need " + bytesText(layout.samples * 20) +
                    " for its samples, more than can be held at once; use a smaller --size, --pixel-samples, --crop or --bucket");
    }
    layout.tilesX = static_cast<int>(tilesAlong(window.width, pixelSamples));
    layout.tiles = layout.tilesX * static_cast<int>(tilesAlong(window.height, pixelSamples));
    return layout;
}

FilmLayout layOutFilm(const RenderOptions& options) { return layOutFilm(cropWindow(options), options.pixelSamples); }

std::uint64_t coarseBytes(int width, int height, int pixelSamples) {
    const std::uint64_t tilesX = tilesAlong(width, pixelSamples);
    const std::uint64_t tilesY = tilesAlong(height, pixelSamples);
    return 4 * (tilesX * tilesY + over(tilesX, 8) * over(tilesY, 8));
}

FilmBytes filmBytes(int width, int height, int pixelSamples, FilmExtras extras) {
    const std::uint64_t tilesX = tilesAlong(width, pixelSamples);
    const std::uint64_t tilesY = tilesAlong(height, pixelSamples);
    const std::uint64_t samples = filmSamples(width, height, pixelSamples);
    FilmBytes bytes;
    const auto add = [&bytes](std::uint64_t buffer) {
        bytes.all += DeviceMemory::bytesFor(buffer);
        bytes.largestBuffer = std::max(bytes.largestBuffer, DeviceMemory::bytesFor(buffer));
    };
    add(samples * 8);
    for (int reference = 0; reference < 3; ++reference) add(samples * 4);
    add((tilesX * tilesY + 3) & ~std::uint64_t{3});
    if (extras.normals) add(samples * 12);
    if (extras.coarseDepth) add(coarseBytes(width, height, pixelSamples));
    return bytes;
}

}  // namespace tessera
