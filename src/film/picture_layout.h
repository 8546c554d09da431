// The planes of a picture and where each lies in its buffer.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "film/picture_shared.h"
#include "tessera/options.h"

namespace tessera {

// A plane beside the colours.
struct PlaneSpec {
    Aov aov = Aov::none;
    std::string_view name;  // as in Frame::planes
    int channels = 0;       // floats a pixel
    uint picture_planes::*place = nullptr;
};

// In the order in which they lie in the buffer.
[[nodiscard]] std::span<const PlaneSpec> planeSpecs();

// Where each plane lies, in floats; four floats a pixel of colour come first. `planes`, for kernels, is right where `floats` < NO_PLANE;
// a picture that is put together on the host may be larger.
struct PictureLayout {
    picture_planes planes{NO_PLANE, NO_PLANE, NO_PLANE, NO_PLANE, NO_PLANE};
    std::array<std::optional<std::uint64_t>, 5> places;  // in the order of planeSpecs(), of planes that are wanted
    std::uint64_t floats = 0;
};

[[nodiscard]] PictureLayout layOutPicture(int width, int height, Aov aovs);

}  // namespace tessera
