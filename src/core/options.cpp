// Names and ranges of what a user can say about a frame.
#include "tessera/options.h"

#include <bit>
#include <sstream>
#include <string>

#include "tessera/error.h"

namespace tessera {
namespace {

// Written so that NaN is out of range.
template <typename T>
void requireRange(const char* option, T value, T least, T most) {
    if (value >= least && value <= most) return;
    const auto text = [](T number) {
        std::ostringstream digits;
        digits << number;
        return digits.str();
    };
    throw Error(std::string(option) + " is " + text(value) + ", but must be " + text(least) + " to " + text(most));
}

}  // namespace

std::string_view name(SplitMethod method) {
    switch (method) {
        case SplitMethod::cpu:
            return "cpu";
        case SplitMethod::breadth:
            return "breadth";
        case SplitMethod::bounded:
            return "bounded";
        case SplitMethod::local:
            return "local";
    }
    return "?";
}

std::string_view name(DiceMode mode) { return mode == DiceMode::watertight ? "watertight" : "classical"; }

void RenderOptions::validate() const {
    requireRange("width", width, 1, 65536);
    requireRange("height", height, 1, 65536);
    requireRange("pixel samples", pixelSamples, 1, 16);
    for (const float edge : crop) requireRange("crop window", edge, 0.0F, 1.0F);
    if (crop[0] >= crop[1] || crop[2] >= crop[3]) throw Error("crop window is empty: X0 must be below X1, and Y0 below Y1");
    requireRange("batch", batch, 0U, 1U << 20);
    if (bucketWidth != 0 || bucketHeight != 0) {
        requireRange("bucket width", bucketWidth, 8, 65536);
        requireRange("bucket height", bucketHeight, 8, 65536);
    }
    requireRange("shading rate", shadingRate, 0.0625F, 65536.0F);
    requireRange("grid size", gridSize, 1, 32);
    if (!std::has_single_bit(static_cast<unsigned>(gridSize))) {
        throw Error("grid size is " + std::to_string(gridSize) + ", but must be a power of two: 1, 2, 4, 8, 16 or 32");
    }
    if (mode != DiceMode::watertight && mode != DiceMode::classical) throw Error("mode is none that exists; use watertight or classical");
    requireRange("split bound", splitBound, 0.25F, 65536.0F);
    requireRange("dice rate", diceRate, 1, 32);
    requireRange("maximum depth", maxDepth, 0, 24);
    for (const float channel : background) requireRange("background", channel, 0.0F, 65504.0F);
    requireRange("background alpha", background[3], 0.0F, 1.0F);
    requireRange("threads", threads, 0U, 1024U);
}

}  // namespace tessera
