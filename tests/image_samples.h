// Frames to write and pictures read back, for the tests of image files.
#pragma once

#include "formats/image_file.h"
#include "output_folder.h"
#include "tessera/error.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

namespace fs = std::filesystem;

class ImageFile : public test::OutputFolder {};

// A frame with planes of its own: what a renderer would hold.
struct TestFrame {
    std::vector<float> rgba, z, n, object, patch, uv;
    Frame frame;

    TestFrame(int width, int height) {
        frame.width = frame.fullWidth = width;
        frame.height = frame.fullHeight = height;
        rgba.resize(pixels() * 4);
        frame.planes.push_back({"rgba", 4, rgba});
    }
    [[nodiscard]] std::size_t pixels() const { return static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height); }

    void add(std::string_view name, int channels, std::vector<float>& values, float scale) {
        values.resize(pixels() * static_cast<std::size_t>(channels));
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = scale * static_cast<float>(i);
        frame.planes.push_back({name, channels, values});
    }
};

// A picture with colours over the whole range and every alpha.
inline TestFrame gradient(int width, int height) {
    TestFrame result(width, height);
    const auto last = static_cast<float>(result.pixels() - 1);
    for (std::size_t i = 0; i < result.pixels(); ++i) {
        const float t = static_cast<float>(i) / last;
        const float alpha = static_cast<float>(i % 11) / 10.0F;
        const std::array<float, 4> pixel{alpha * t, alpha * t * t, alpha * (1.0F - t), alpha};
        std::copy(pixel.begin(), pixel.end(), result.rgba.begin() + static_cast<std::ptrdiff_t>(i * 4));
    }
    return result;
}

inline std::size_t number(int value) { return static_cast<std::size_t>(value); }

struct Picture {
    OIIO::ImageSpec spec;
    std::vector<float> values;  // all channels, as float; 8-bit values over 255

    [[nodiscard]] float at(int x, int y, const std::string& channel) const {
        const int index = spec.channelindex(channel);
        EXPECT_GE(index, 0) << channel;
        if (index < 0) return std::numeric_limits<float>::quiet_NaN();
        return values[(number(y) * number(spec.width) + number(x)) * number(spec.nchannels) + number(index)];
    }
    [[nodiscard]] OIIO::TypeDesc type(const std::string& channel) const { return spec.channelformat(spec.channelindex(channel)); }
};

inline Picture readPicture(const fs::path& path) {
    Picture picture;
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);  // as the file has it
    const auto input = OIIO::ImageInput::open(path.string(), &hints);
    if (!input) {
        ADD_FAILURE() << OIIO::geterror();
        return picture;
    }
    picture.spec = input->spec();
    picture.values.resize(picture.spec.image_pixels() * static_cast<std::size_t>(picture.spec.nchannels));
    EXPECT_TRUE(input->read_image(0, 0, 0, -1, OIIO::TypeFloat, picture.values.data())) << input->geterror();
    return picture;
}

inline std::string bytesOf(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

template <typename Action>
std::string errorOf(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace tessera
