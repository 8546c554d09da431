// The options that a frame's memory plan depends on, but for those of a mode.
#include "plan_options.h"

#include "add_options.h"
#include "console.h"
#include "parse_values.h"
#include "shared_options.h"

#include <algorithm>
#include <vector>

namespace tessera::program {

namespace {

void readCrop(const std::string& text, std::array<float, 4>& crop) {
    const std::vector<float> numbers = parseNumbers(text, 4, 4);
    std::copy(numbers.begin(), numbers.end(), crop.begin());
}

void readSize(const std::string& text, RenderOptions& options) {
    const Size size = parseSize(text);
    options.width = size.width;
    options.height = size.height;
}

void readBucket(const std::string& text, RenderOptions& options) {
    const Size size = parseSize(text, kSmallestBucketSide);
    options.bucketWidth = size.width;
    options.bucketHeight = size.height;
}

}  // namespace

void addSizeOptions(CLI::App& app, RenderOptions& options) {
    addParsed(
        app, "--size", [&options](const std::string& text) { readSize(text, options); },
        "Width and height of the full picture in pixels, each 1 to 65536")
        ->type_name("WxH")
        ->default_str(std::to_string(options.width) + "x" + std::to_string(options.height));
    addParsed(
        app, "--crop", [&options](const std::string& text) { readCrop(text, options.crop); },
        "Render this window alone: fractions of the picture, 0 to 1, y down")
        ->type_name("X0,X1,Y0,Y1")
        ->default_str(listText(options.crop));
    addWhole(app, "--pixel-samples", options.pixelSamples, {1, 16}, "N x N stratified samples a pixel, 1 to 16")->type_name("N");
    addParsed(
        app, "--aov", [&options](const std::string& text) { options.aovs = parseAovs(text); },
        "More outputs for .exr, with commas between:\n" + aovNames())
        ->type_name("LIST");
}

void addMemoryOptions(CLI::App& app, RenderOptions& options) {
    addParsed(
        app, "--method", [&options](const std::string& text) { options.method = parseMethod(text); },
        "How ranges are split: cpu (on the host, the reference), breadth (all at\nonce), bounded (memory fixed beforehand), local (as "
        "bounded, with a stack\na work-group)")
        ->type_name("NAME")
        ->default_str(std::string(name(options.method)));
    addMemoryOption(app, options.memoryBytes);
    addWhole(app, "--batch", options.batch, {0, 1 << 20}, "Ranges bounded at a time, 1 to 1048576; 0 is what fits the memory best")
        ->type_name("P");
    addParsed(
        app, "--bucket", [&options](const std::string& text) { readBucket(text, options); },
        "Render the picture in parts of this many pixels, each side 8 to 65536,\nrounded up to tiles of samples; without it in as few as "
        "fit the memory")
        ->type_name("WxH");
}

}  // namespace tessera::program
