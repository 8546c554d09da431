// Options that several commands have, the same under each.
#include "shared_options.h"

#include "add_options.h"
#include "parse_values.h"
#include "tessera/error.h"

#include <limits>
#include <vector>

namespace tessera::program {

namespace {

// 16 TiB, beyond all devices.
constexpr long long kMostMebibytes = 1LL << 24;

Transform readLookAt(const std::string& text) {
    const std::vector<float> n = parseNumbers(text, 6, 6);
    return lookAt({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, Camera{}.fovy).transform;
}

float readFov(const std::string& text) {
    const float degrees = parseNumber(text);
    if (!(degrees > 0.0F && degrees < 180.0F)) throw Error("'" + text + "' is out of range: above 0 and below 180 degrees");
    return degrees;
}

}  // namespace

void addCameraOptions(CLI::App& app, CameraArguments& camera, const std::function<void(const std::string&)>& given) {
    const auto add = [&app, given](const std::string& option, const std::function<void(const std::string&)>& read,
                                   const std::string& description) {
        const auto noted = [option, read, given](const std::string& text) {
            read(text);
            if (given) given(option);
        };
        return addParsed(app, option, noted, description)->group("Camera");
    };
    add(
        "--camera", [&camera](const std::string& text) { camera.name = text; },
        "A camera of the scene; without it the first one, or one that sees all of a\nscene that has none")
        ->type_name("NAME");
    add(
        "--look-at", [&camera](const std::string& text) { camera.lookAt = readLookAt(text); },
        "Put the camera at E, looking at T, y up: six numbers in scene units")
        ->type_name("EX,EY,EZ,TX,TY,TZ");
    add(
        "--fov", [&camera](const std::string& text) { camera.fov = readFov(text); },
        "Vertical field of view in degrees, above 0 and below 180; without it the\ncamera's own")
        ->type_name("DEG");
}

void addMemoryOption(CLI::App& app, std::uint64_t& bytes) {
    const auto read = [&bytes](const std::string& text) { bytes = static_cast<std::uint64_t>(parseWhole(text, 1, kMostMebibytes)) << 20; };
    addParsed(app, "--memory", read,
              "Device memory in MiB that may be taken, 1 to 16777216; without it 512 or a\nquarter of the device's, whichever is less")
        ->type_name("MIB");
}

void addDeviceOption(CLI::App& app, int& device) {
    addWhole(app, "--device", device, {0, std::numeric_limits<int>::max()},
             "Number of the device in 'tessera devices'; without it the first GPU, else\nthe first usable device")
        ->type_name("I")
        ->default_str("");
}

void addCacheOptions(CLI::App& app, RendererSettings& settings) {
    app.add_option("--cache-dir", settings.cacheFolder,
                   "Folder of compiled kernels; without it $TESSERA_CACHE,\n$XDG_CACHE_HOME/tessera or ~/.cache/tessera.\nNot used on "
                   "PoCL, which keeps its own")
        ->type_name("DIR");
    app.add_flag_callback(
        "--no-cache", [&settings] { settings.cacheKernels = false; }, "Neither read nor write compiled kernels");
}

}  // namespace tessera::program
