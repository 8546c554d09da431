// What a user can say about a frame, with RenderMan's names where they exist.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "tessera/scene.h"

namespace tessera {

enum class SplitMethod {
    cpu,      // on the host, several threads; the reference
    breadth,  // all ranges at once, memory grows with them (Patney & Owens 2008)
    bounded,  // at most `batch` ranges at a time, memory fixed beforehand (Weber & Owens 2014)
    local,    // a stack a work-group in local memory, work shared from launch to launch (Weber 2015, Tzeng et al. 2010)
};

[[nodiscard]] std::string_view name(SplitMethod method);

// What splitting and dicing decide by.
enum class DiceMode {
    watertight,  // rates of edges, which neighbours share: no cracks (after DiagSplit, Fisher et al. 2009)
    classical,   // halves of ranges at one fixed rate, as Micropolis did: leaves pinholes between ranges of different size
};

[[nodiscard]] std::string_view name(DiceMode mode);

// Arbitrary output variables: what is written besides colour and coverage. A bit set.
enum class Aov : std::uint32_t {
    none = 0,
    z = 1,       // "Z": distance along the view axis, nearest sample; infinity on the background
    normal = 2,  // "N.X", "N.Y", "N.Z": unit, world space, towards the viewer; mean over covered samples
    object = 4,  // "object.id": index into Scene::objects, nearest sample; -1 on the background
    patch = 8,   // "patch.id": index into the object's mesh, nearest sample; -1 on the background
    uv = 16,     // "u", "v": patch parameters, nearest sample; 0 on the background
};

[[nodiscard]] constexpr Aov operator|(Aov a, Aov b) {
    return static_cast<Aov>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
[[nodiscard]] constexpr bool contains(Aov set, Aov wanted) {
    return (static_cast<std::uint32_t>(set) & static_cast<std::uint32_t>(wanted)) != 0;
}

struct RenderOptions {
    int width = 1280;  // pixels, of the full picture; 1 to 65536
    int height = 720;
    int pixelSamples = 4;                               // N of N x N stratified samples a pixel, 1 to 16
    std::array<float, 4> crop{0.0F, 1.0F, 0.0F, 1.0F};  // CropWindow: x0, x1, y0, y1 as fractions of the picture, y down
    SplitMethod method = SplitMethod::bounded;
    DiceMode mode = DiceMode::watertight;
    // What the frame's buffers take at most, in bytes; 0: 512 MiB or a quarter of the device's memory, whichever is less.
    std::uint64_t memoryBytes = 0;
    std::uint32_t batch = 0;  // p: ranges bounded at a time, 1 to 1 << 20, or 0: what the memory plan finds best
    int bucketWidth = 0;      // pixels that are rendered at a time, 8 to 65536 each way, or 0 and 0: what the memory plan finds best
    int bucketHeight = 0;
    bool occlusion = true;  // watertight mode: drop ranges that lie behind what is drawn already; the picture is the same
    // Watertight mode. Edges get 2^k micropolygons, none longer than sqrt(shadingRate) pixels, and no more than it takes for that and for
    // what a bend asks for.
    float shadingRate = 1.0F;            // greatest area of a micropolygon in pixels, 0.0625 to 65536
    int gridSize = 16;                   // most micropolygons along an edge of a range: 1, 2, 4, 8, 16 or 32
    std::optional<Camera> dicingCamera;  // where rates are measured, in a picture of this size; the frame's own camera without it
    // Classical mode.
    float splitBound = 8.0F;      // pixels, 0.25 to 65536; a range is diced when it is no longer than this either way
    int diceRate = 8;             // micropolygons along each side of a range, 1 to 32
    int maxDepth = 23;            // splits after which a range is diced whatever its size, 0 to 24
    bool cullBackfaces = false;   // drop micropolygons whose normal du x dv points away
    bool headlight = false;       // light from the eye, of radiance 1 at any distance, instead of the scene's lights
    bool emulateAtomics = false;  // use the two-pass 32-bit fallback though the device has 64-bit atomics
    std::array<float, 4> background{0.0F, 0.0F, 0.0F, 0.0F};  // linear RGB, 0 to 65504, and alpha, 0 to 1, not premultiplied
    unsigned threads = 0;                                     // host threads of the cpu method, at most 1024; 0 = one a core
    Aov aovs = Aov::none;
    bool trace = false;  // keep every kernel and transfer in Statistics::trace

    // Throws Error naming the option and its range.
    void validate() const;
};

}  // namespace tessera
