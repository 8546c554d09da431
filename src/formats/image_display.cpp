// The pixels of PNG, TIFF and JPEG files: 8-bit sRGB.
#include "formats/image_encoding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace tessera {
namespace {

constexpr std::size_t rgbaChannels = 4;

// 0 to 1 to the nearest of 256 steps; what lies outside is clamped, NaN is 0.
std::byte quantize(float value) {
    const float clamped = value > 0.0F ? std::min(value, 1.0F) : 0.0F;
    return static_cast<std::byte>(static_cast<std::uint8_t>(std::lround(clamped * 255.0F)));
}

// The sRGB transfer curve (IEC 61966-2-1).
float encodeSrgb(float linear) { return linear <= 0.0031308F ? linear * 12.92F : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F; }

void packUnassociated(std::span<const float> rgba, std::span<std::byte> pixels) {
    for (std::size_t i = 0; i < rgba.size(); i += rgbaChannels) {
        const float alpha = rgba[i + 3];
        for (std::size_t c = 0; c < 3; ++c) {
            // Colour where nothing covers has no unassociated form: such pixels are transparent black.
            pixels[i + c] = alpha > 0.0F ? quantize(encodeSrgb(rgba[i + c] / alpha)) : std::byte{0};
        }
        pixels[i + 3] = quantize(alpha);
    }
}

void packOverBlack(std::span<const float> rgba, std::span<std::byte> pixels) {
    // Premultiplied colour is colour over black already.
    for (std::size_t i = 0, out = 0; i < rgba.size(); i += rgbaChannels, out += 3) {
        for (std::size_t c = 0; c < 3; ++c) pixels[out + c] = quantize(encodeSrgb(rgba[i + c]));
    }
}

}  // namespace

ImageEncoding displayEncoding(const Frame& frame, DisplayAlpha alpha) {
    const bool hasAlpha = alpha == DisplayAlpha::unassociated;
    ImageEncoding encoding;
    encoding.spec = OIIO::ImageSpec(frame.width, frame.height, hasAlpha ? 4 : 3, OIIO::TypeUInt8);
    // Otherwise OpenImageIO would divide the encoded values by alpha once more.
    if (hasAlpha) encoding.spec.attribute("oiio:UnassociatedAlpha", 1);
    encoding.spec.attribute("jpeg:subsampling", "4:4:4");
    encoding.spec.attribute("CompressionQuality", 95);
    encoding.packRow = [&frame, &plane = *frame.plane("rgba"), hasAlpha](int row, std::span<std::byte> pixels) {
        const std::span<const float> rgba = rowOf(frame, plane, row);
        hasAlpha ? packUnassociated(rgba, pixels) : packOverBlack(rgba, pixels);
    };
    return encoding;
}

}  // namespace tessera
