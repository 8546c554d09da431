// Image files by their ending: encoded in memory by OpenImageIO, then written in one go.
#include "formats/image_file.h"

#include "formats/image_encoding.h"
#include "formats/output_file.h"
#include "tessera/error.h"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <string_view>
#include <vector>

namespace tessera {
namespace {

namespace fs = std::filesystem;

enum class ImageFormat { exr, png, tiff, jpeg };

struct Ending {
    std::string_view text;
    ImageFormat format;
    const char* plugin;  // OpenImageIO's name of the format
};

constexpr std::array endings{
    Ending{".exr", ImageFormat::exr, "openexr"}, Ending{".png", ImageFormat::png, "png"},   Ending{".tif", ImageFormat::tiff, "tiff"},
    Ending{".tiff", ImageFormat::tiff, "tiff"},  Ending{".jpg", ImageFormat::jpeg, "jpeg"}, Ending{".jpeg", ImageFormat::jpeg, "jpeg"},
};

const Ending& endingOf(const fs::path& path) {
    std::string text = path.extension().string();
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto* found = std::find_if(endings.begin(), endings.end(), [&](const Ending& ending) { return ending.text == text; });
    if (found != endings.end()) return *found;
    std::string known;
    for (const Ending& ending : endings) known.append(" ").append(ending.text);
    throw Error("cannot write '" + path.string() + "': its ending names no known image format; use one of" + known);
}

void checkFrame(const Frame& frame, ImageFormat format, const fs::path& path) {
    const auto pixels = static_cast<std::size_t>(std::max(frame.width, 0)) * static_cast<std::size_t>(std::max(frame.height, 0));
    if (pixels == 0) throw Error("cannot write '" + path.string() + "': the frame has no pixels; render one first");
    // libjpeg ends the program on larger ones.
    constexpr int longestJpegSide = 65500;
    if (format == ImageFormat::jpeg && std::max(frame.width, frame.height) > longestJpegSide) {
        throw Error("cannot write '" + path.string() + "': JPEG holds at most " + std::to_string(longestJpegSide) +
                    " pixels a side; use another format");
    }
    const Plane* colour = frame.plane("rgba");
    if (colour == nullptr || colour->channels != 4) {
        throw Error("cannot write '" + path.string() + "': the frame has no plane 'rgba' of 4 channels; render one first");
    }
    for (const Plane& plane : frame.planes) {
        if (plane.values.size() == pixels * static_cast<std::size_t>(plane.channels)) continue;
        throw Error("cannot write '" + path.string() + "': plane '" + std::string(plane.name) +
                    "' does not have the frame's size; pass a frame as render() made it");
    }
}

ImageEncoding encodingFor(ImageFormat format, const Frame& frame, const ImageMetadata& metadata) {
    ImageEncoding encoding = format == ImageFormat::exr    ? exrEncoding(frame, metadata)
                             : format == ImageFormat::jpeg ? displayEncoding(frame, DisplayAlpha::overBlack)
                                                           : displayEncoding(frame, DisplayAlpha::unassociated);
    encoding.spec.attribute("Software", "Tessera " + std::string(versionString()));
    // A TIFF that names its colour space gets a directory that OpenImageIO cannot link in memory; 8-bit TIFF means sRGB unnamed.
    if (format == ImageFormat::png || format == ImageFormat::jpeg) encoding.spec.attribute("oiio:ColorSpace", "sRGB");
    // A fixed date, for OpenImageIO would put today's: equal pictures are to be equal files. PNG and JPEG have none unless it is set.
    if (format == ImageFormat::exr || format == ImageFormat::tiff) encoding.spec.attribute("DateTime", "1970:01:01 00:00:00");
    return encoding;
}

[[noreturn]] void failEncoding(const fs::path& path, const OIIO::ImageOutput& output) {
    std::string reason = output.geterror();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw Error("cannot write '" + path.string() + "': " + reason + "; try another format");
}

// Some rows at a time: enough for OpenEXR to compress on all cores, few enough to cost little beside the frame.
void writeRows(const fs::path& path, const ImageEncoding& encoding, OIIO::ImageOutput& output) {
    constexpr int rowsAtOnce = 256;
    const int height = encoding.spec.height;
    const std::size_t rowBytes = encoding.spec.scanline_bytes(true);
    std::vector<std::byte> rows(rowBytes * static_cast<std::size_t>(std::min(rowsAtOnce, height)));
    for (int first = 0; first < height; first += rowsAtOnce) {
        const int count = std::min(rowsAtOnce, height - first);
        for (int i = 0; i < count; ++i) {
            encoding.packRow(first + i, std::span(rows).subspan(rowBytes * static_cast<std::size_t>(i), rowBytes));
        }
        const int y = encoding.spec.y + first;
        // Unknown format = as the specification says, unconverted: ids would be scaled as colours are otherwise.
        if (!output.write_scanlines(y, y + count, 0, OIIO::TypeDesc::UNKNOWN, rows.data())) failEncoding(path, output);
    }
}

std::vector<unsigned char> encode(const fs::path& path, const char* plugin, const ImageEncoding& encoding) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(plugin);
    if (!output) throw Error("cannot write '" + path.string() + "': this OpenImageIO lacks the format; try another one");
    if (!output->set_ioproxy(&memory) || !output->open(path.string(), encoding.spec)) failEncoding(path, *output);
    writeRows(path, encoding, *output);
    if (!output->close()) failEncoding(path, *output);
    return bytes;
}

}  // namespace

std::span<const float> rowOf(const Frame& frame, const Plane& plane, int row) {
    const std::size_t length = static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(plane.channels);
    return plane.values.subspan(length * static_cast<std::size_t>(row), length);
}

void checkImagePath(const fs::path& path) {
    static_cast<void>(endingOf(path));
    checkOutputFile(path);
}

void writeImage(const fs::path& path, const Frame& frame, const ImageMetadata& metadata) {
    const Ending& ending = endingOf(path);
    checkOutputFile(path);
    checkFrame(frame, ending.format, path);
    const std::vector<unsigned char> bytes = encode(path, ending.plugin, encodingFor(ending.format, frame, metadata));
    writeOutputFile(path, std::as_bytes(std::span(bytes)));
}

}  // namespace tessera
