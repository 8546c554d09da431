// The channels and the metadata of OpenEXR files.
#include "formats/image_encoding.h"
#include "tessera/error.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace tessera {
namespace {

// One channel of the file and where its values come from.
struct Channel {
    std::string name;
    OIIO::TypeDesc type;
    const Plane* plane;
    std::size_t component;
};

// The channels that a plane becomes, in order; their number is the plane's.
struct PlaneLayout {
    std::string_view plane;
    OIIO::TypeDesc type;
    std::vector<std::string> channels;
};

std::vector<Channel> channelsOf(const Frame& frame) {
    const std::array layouts{
        PlaneLayout{"rgba", OIIO::TypeHalf, {"R", "G", "B", "A"}}, PlaneLayout{"Z", OIIO::TypeFloat, {"Z"}},
        PlaneLayout{"N", OIIO::TypeFloat, {"N.X", "N.Y", "N.Z"}},  PlaneLayout{"object.id", OIIO::TypeUInt32, {"object.id"}},
        PlaneLayout{"patch.id", OIIO::TypeUInt32, {"patch.id"}},   PlaneLayout{"uv", OIIO::TypeFloat, {"u", "v"}},
    };
    std::vector<Channel> channels;
    for (const PlaneLayout& layout : layouts) {
        const Plane* plane = frame.plane(layout.plane);
        if (plane == nullptr) continue;
        if (static_cast<std::size_t>(plane->channels) != layout.channels.size()) {
            throw Error("plane '" + std::string(layout.plane) + "' of the frame has " + std::to_string(plane->channels) +
                        " channels; pass a frame as render() made it");
        }
        for (std::size_t i = 0; i < layout.channels.size(); ++i) channels.push_back({layout.channels[i], layout.type, plane, i});
    }
    return channels;
}

void storeHalf(float value, std::byte* out) {
    // Beyond the largest finite half a value would become infinite, which filters of a compositor spread.
    constexpr float largestHalf = 65504.0F;
    const float clamped = std::clamp(value, -largestHalf, largestHalf);
    OIIO::convert_pixel_values(OIIO::TypeFloat, &clamped, OIIO::TypeHalf, out, 1);
}

void storeId(float value, std::byte* out) {
    const std::uint32_t id = value >= 0.0F ? static_cast<std::uint32_t>(value) : std::numeric_limits<std::uint32_t>::max();
    std::memcpy(out, &id, sizeof id);
}

void store(const OIIO::TypeDesc& type, float value, std::byte* out) {
    if (type == OIIO::TypeHalf) {
        storeHalf(value, out);
    } else if (type == OIIO::TypeUInt32) {
        storeId(value, out);
    } else {
        std::memcpy(out, &value, sizeof value);
    }
}

void packExrRow(const Frame& frame, const std::vector<Channel>& channels, std::size_t pixelBytes, int row, std::span<std::byte> pixels) {
    std::size_t offset = 0;
    for (const Channel& channel : channels) {
        const std::span<const float> values = rowOf(frame, *channel.plane, row);
        const auto stride = static_cast<std::size_t>(channel.plane->channels);
        std::byte* out = pixels.data() + offset;
        for (std::size_t i = channel.component; i < values.size(); i += stride, out += pixelBytes) store(channel.type, values[i], out);
        offset += channel.type.size();
    }
}

void setCount(OIIO::ImageSpec& spec, const std::string& name, std::uint64_t value) {
    // OpenEXR's only integer attribute is a signed one of 32 bits.
    if (value <= static_cast<std::uint64_t>(std::numeric_limits<int>::max())) {
        spec.attribute(name, static_cast<int>(value));
    } else {
        spec.attribute(name, std::to_string(value));
    }
}

void setMilliseconds(OIIO::ImageSpec& spec, const std::string& name, double value) { spec.attribute(name, OIIO::TypeDesc::DOUBLE, &value); }

// By the names that `--stats` uses.
void setStatistics(OIIO::ImageSpec& spec, const Statistics& statistics) {
    const std::string prefix = "tessera:";
    spec.attribute(prefix + "device", statistics.device);
    spec.attribute(prefix + "width", statistics.width);
    spec.attribute(prefix + "height", statistics.height);
    spec.attribute(prefix + "method", statistics.method);
    spec.attribute(prefix + "pixel_samples", statistics.pixelSamples);
    setCount(spec, prefix + "batch", statistics.batch);
    setCount(spec, prefix + "patches", statistics.patches);
    setCount(spec, prefix + "ranges_processed", statistics.rangesProcessed);
    setCount(spec, prefix + "ranges_diced", statistics.rangesDiced);
    setCount(spec, prefix + "ranges_culled", statistics.rangesCulled);
    setCount(spec, prefix + "stack_peak", statistics.stackPeak);
    setCount(spec, prefix + "iterations", statistics.iterations);
    setCount(spec, prefix + "batches", statistics.batches);
    setCount(spec, prefix + "micropolygons", statistics.micropolygons);
    setCount(spec, prefix + "pixels_covered", statistics.pixelsCovered);
    setCount(spec, prefix + "device_bytes_peak", statistics.deviceBytesPeak);
    setMilliseconds(spec, prefix + "split_ms", statistics.splitMs);
    setMilliseconds(spec, prefix + "frame_ms", statistics.frameMs);
    setMilliseconds(spec, prefix + "build_ms", statistics.buildMs);
    for (const auto& [kernel, milliseconds] : statistics.kernelMs) setMilliseconds(spec, prefix + "kernel_ms:" + kernel, milliseconds);
}

void setMatrices(OIIO::ImageSpec& spec, const ImageMetadata& metadata) {
    // OpenEXR multiplies row vectors and GLM column vectors, one stores rows and the other columns: the same 16 floats in memory.
    // OpenEXR's camera space is left-handed and looks along +z.
    glm::mat4 turned{1.0F};
    turned[2][2] = -1.0F;
    const glm::mat4 worldToCamera = turned * metadata.worldToCamera;
    spec.attribute("worldtocamera", OIIO::TypeMatrix, glm::value_ptr(worldToCamera));
    spec.attribute("worldToNDC", OIIO::TypeMatrix, glm::value_ptr(metadata.worldToScreen));
}

OIIO::ImageSpec exrSpec(const Frame& frame, const ImageMetadata& metadata, const std::vector<Channel>& channels) {
    OIIO::ImageSpec spec(frame.width, frame.height, static_cast<int>(channels.size()), OIIO::TypeFloat);
    spec.channelnames.clear();
    for (const Channel& channel : channels) {
        spec.channelnames.push_back(channel.name);
        spec.channelformats.push_back(channel.type);
        if (channel.name == "A") spec.alpha_channel = static_cast<int>(spec.channelnames.size()) - 1;
        if (channel.name == "Z") spec.z_channel = static_cast<int>(spec.channelnames.size()) - 1;
    }
    spec.x = frame.x0;
    spec.y = frame.y0;
    spec.full_width = frame.fullWidth;
    spec.full_height = frame.fullHeight;
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    for (const auto& [name, value] : metadata.options) spec.attribute("tessera:" + name, value);
    if (!metadata.command.empty()) spec.attribute("ImageDescription", metadata.command);
    setStatistics(spec, frame.statistics);
    setMatrices(spec, metadata);
    return spec;
}

}  // namespace

ImageEncoding exrEncoding(const Frame& frame, const ImageMetadata& metadata) {
    std::vector<Channel> channels = channelsOf(frame);
    ImageEncoding encoding;
    encoding.spec = exrSpec(frame, metadata, channels);
    encoding.packRow = [&frame, channels = std::move(channels), pixelBytes = encoding.spec.pixel_bytes(true)](
                           int row, std::span<std::byte> pixels) { packExrRow(frame, channels, pixelBytes, row, pixels); };
    return encoding;
}

}  // namespace tessera
