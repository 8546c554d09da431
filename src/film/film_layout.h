// How a window of the picture is cut into samples and tiles, and what the film takes for it. Knows no device.
#pragma once

#include <cstdint>

#include "tessera/options.h"

namespace tessera {

// A part of the full picture, in pixels from its top left.
struct PixelWindow {
    int x0 = 0;
    int y0 = 0;
    int width = 0;
    int height = 0;
};

// RenderMan's CropWindow: the pixels whose corner lies in it. Throws Error when there are none.
[[nodiscard]] PixelWindow cropWindow(const RenderOptions& options);

// How a window is cut into cells (a sample each) and tiles.
struct FilmLayout {
    int x0 = 0;  // the window in pixels of the full picture
    int y0 = 0;
    int width = 0;
    int height = 0;
    int pixelSamples = 1;
    int tileCells = 8;  // along a side; a multiple of pixelSamples
    int tilesX = 0;
    int tiles = 0;
    std::uint64_t samples = 0;  // tiles x tileCells^2
};

// Of `pixelSamples` N: cells, and pixels, along a side of a tile.
[[nodiscard]] constexpr int tileCells(int pixelSamples) { return pixelSamples * ((8 + pixelSamples - 1) / pixelSamples); }
[[nodiscard]] constexpr int tilePixels(int pixelSamples) { return tileCells(pixelSamples) / pixelSamples; }

// Samples of a window with whole tiles, for windows of any size.
[[nodiscard]] std::uint64_t filmSamples(int width, int height, int pixelSamples);

// The kernels' tile arithmetic is exact for fewer samples than this (film/hide.clh).
inline constexpr std::uint64_t filmSamplesEnd = std::uint64_t{1} << 30;

// Throws Error when there are filmSamplesEnd samples or more, with the bytes that they would need.
[[nodiscard]] FilmLayout layOutFilm(const PixelWindow& window, int pixelSamples);
// Of the whole crop window.
[[nodiscard]] FilmLayout layOutFilm(const RenderOptions& options);

// What the film keeps beside samples, references and tiles.
struct FilmExtras {
    bool normals = false;      // of samples: where chunks of patches are shaded one after the other and N is wanted
    bool coarseDepth = false;  // of tiles, and of blocks of 8 x 8 tiles: for occlusion
};

// Of the coarse depth: a word a tile and a block of 8 x 8 tiles.
[[nodiscard]] std::uint64_t coarseBytes(int width, int height, int pixelSamples);
[[nodiscard]] inline std::uint64_t coarseBytes(const FilmLayout& layout) {
    return coarseBytes(layout.width, layout.height, layout.pixelSamples);
}

struct FilmBytes {
    std::uint64_t all = 0;
    std::uint64_t largestBuffer = 0;
};

// Of a window of this size.
[[nodiscard]] FilmBytes filmBytes(int width, int height, int pixelSamples, FilmExtras extras);

}  // namespace tessera
