// How a frame's pixels become those of a file: what the encoders hand to image_file.cpp.
#pragma once

#include "formats/image_file.h"

#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <functional>
#include <span>

namespace tessera {

struct ImageEncoding {
    OIIO::ImageSpec spec;
    // Fills `pixels` with row `row` of the crop window, channels side by side in their own formats, as `spec` lists them.
    // Keeps a reference to the frame that the encoding was made of.
    std::function<void(int row, std::span<std::byte> pixels)> packRow;
};

// Half colour, and every other plane of the frame as float or uint32 channels. Scene-linear, premultiplied.
[[nodiscard]] ImageEncoding exrEncoding(const Frame& frame, const ImageMetadata& metadata);

enum class DisplayAlpha {
    unassociated,  // RGBA, colour divided by alpha
    overBlack,     // RGB
};

// 8-bit sRGB of plane "rgba".
[[nodiscard]] ImageEncoding displayEncoding(const Frame& frame, DisplayAlpha alpha);

// The plane's values of one row of the crop window.
[[nodiscard]] std::span<const float> rowOf(const Frame& frame, const Plane& plane, int row);

}  // namespace tessera
