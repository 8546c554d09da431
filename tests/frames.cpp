// Frames that tests keep, and how two of them differ.
#include "frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <sstream>

namespace tessera::test {

namespace {

bool sameBits(std::span<const float> a, std::span<const float> b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

std::string textOf(std::span<const float> values) {
    std::ostringstream text;
    text.precision(9);
    for (const float value : values) text << ' ' << value;
    return text.str();
}

// What differs at a pixel: the names of the planes and their values.
struct PixelDifference {
    bool any = false;
    bool depth = false;
    bool surface = false;
    std::string text;
};

PixelDifference pixelDifference(const Kept& whole, const Kept& part, int x, int y) {
    PixelDifference result;
    const int wholeX = x + part.x0() - whole.x0();
    const int wholeY = y + part.y0() - whole.y0();
    for (const auto& [name, plane] : part.planes()) {
        const std::span<const float> a = whole.at(name, wholeX, wholeY);
        const std::span<const float> b = part.at(name, x, y);
        if (sameBits(a, b)) continue;
        result.any = true;
        result.depth = result.depth || name == "Z";
        result.surface = result.surface || name == "patch.id" || name == "uv";
        result.text += name + ":" + textOf(a) + " against" + textOf(b) + "; ";
    }
    result.depth = result.depth || whole.covered(wholeX, wholeY) != part.covered(x, y);
    return result;
}

}  // namespace

RendererSettings testSettings() {
    RendererSettings settings;
    // Compiled kernels don't say under which of PoCL's work-group methods they were made: whoever sets the method sets the folder.
    if (std::getenv("TESSERA_CACHE") == nullptr) settings.cacheFolder = TESSERA_TEST_CACHE;
    return settings;
}

RenderOptions pictureOptions(int width, int height, int pixelSamples) {
    RenderOptions options;
    options.width = width;
    options.height = height;
    options.pixelSamples = pixelSamples;
    options.aovs = allPlanes;
    return options;
}

Kept::Kept(const Frame& frame) : x0_(frame.x0), y0_(frame.y0), width_(frame.width), height_(frame.height), statistics_(frame.statistics) {
    for (const tessera::Plane& plane : frame.planes) {
        planes_[std::string(plane.name)] = {static_cast<std::size_t>(plane.channels), {plane.values.begin(), plane.values.end()}};
    }
}

std::span<const float> Kept::at(std::string_view plane, int x, int y) const {
    const Plane& found = planes_.find(plane)->second;
    const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    return std::span(found.values).subspan(pixel * found.channels, found.channels);
}

std::size_t Kept::coveredPixels() const {
    std::size_t count = 0;
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) count += covered(x, y) ? 1U : 0U;
    return count;
}

Kept draw(Renderer& renderer, const Camera& camera, const RenderOptions& options) { return Kept(renderer.render(camera, options)); }

Difference difference(const Kept& whole, const Kept& part) {
    Difference result;
    for (int y = 0; y < part.height(); ++y) {
        for (int x = 0; x < part.width(); ++x) {
            const PixelDifference pixel = pixelDifference(whole, part, x, y);
            if (!pixel.any) continue;
            if (result.pixels == 0) {
                result.first = "first at (" + std::to_string(x) + ", " + std::to_string(y) + "): " + pixel.text;
            }
            ++result.pixels;
            result.inDepth += pixel.depth ? 1U : 0U;
            result.inSurface += pixel.surface ? 1U : 0U;
        }
    }
    return result;
}

void expectSameBits(const Kept& whole, const Kept& part) {
    const Difference found = difference(whole, part);
    EXPECT_EQ(found.pixels, 0U) << found.first;
}

}  // namespace tessera::test
