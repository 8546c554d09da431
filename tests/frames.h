// Frames that tests keep, and how two of them differ.
#pragma once

#include "tessera/renderer.h"

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::test {

inline constexpr Aov allPlanes = Aov::z | Aov::normal | Aov::object | Aov::patch | Aov::uv;

// The default device, kernels kept in $TESSERA_CACHE or, without it, in the build folder.
[[nodiscard]] RendererSettings testSettings();

// Options for a small picture with all its planes.
[[nodiscard]] RenderOptions pictureOptions(int width, int height, int pixelSamples);

// A copy of a frame: a Frame's own planes end with the renderer's next one.
class Kept {
public:
    explicit Kept(const Frame& frame);

    struct Plane {
        std::size_t channels = 0;
        std::vector<float> values;
    };
    using Planes = std::map<std::string, Plane, std::less<>>;

    [[nodiscard]] int x0() const { return x0_; }
    [[nodiscard]] int y0() const { return y0_; }
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] const Statistics& statistics() const { return statistics_; }
    [[nodiscard]] const Planes& planes() const { return planes_; }

    // A pixel's channels, (x, y) from the window's top left. Requires that the plane was asked for.
    [[nodiscard]] std::span<const float> at(std::string_view plane, int x, int y) const;
    [[nodiscard]] float alpha(int x, int y) const { return at("rgba", x, y)[3]; }
    [[nodiscard]] bool covered(int x, int y) const { return alpha(x, y) > 0.0F; }
    [[nodiscard]] float z(int x, int y) const { return at("Z", x, y)[0]; }
    [[nodiscard]] int object(int x, int y) const { return static_cast<int>(at("object.id", x, y)[0]); }
    [[nodiscard]] int patch(int x, int y) const { return static_cast<int>(at("patch.id", x, y)[0]); }

    [[nodiscard]] std::size_t coveredPixels() const;

private:
    int x0_ = 0;
    int y0_ = 0;
    int width_ = 0;
    int height_ = 0;
    Statistics statistics_;
    Planes planes_;
};

[[nodiscard]] Kept draw(Renderer& renderer, const Camera& camera, const RenderOptions& options);

struct Difference {
    std::size_t pixels = 0;     // that differ in any plane, to the bit
    std::size_t inDepth = 0;    // of these, those that differ in Z, or are covered in one picture alone
    std::size_t inSurface = 0;  // of these, those whose nearest samples show another patch or other parameters
    std::string first;          // the first of them, for messages
};

// Compares the bits of all planes over the window of `part`, which must lie within that of `whole`. Both must have the same planes.
[[nodiscard]] Difference difference(const Kept& whole, const Kept& part);

// Expects the same bits everywhere.
void expectSameBits(const Kept& whole, const Kept& part);

}  // namespace tessera::test
