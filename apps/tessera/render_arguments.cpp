// The command line of `tessera render`: every option with its unit, range and default.
#include "render_arguments.h"

#include "add_options.h"
#include "commands.h"
#include "console.h"
#include "mode_options.h"
#include "parse_values.h"
#include "plan_options.h"
#include "shared_options.h"
#include "tessera/error.h"

#include <algorithm>
#include <vector>

namespace tessera::program {

namespace {

void readBackground(const std::string& text, std::array<float, 4>& background) {
    const std::vector<float> numbers = parseNumbers(text, 3, 4);
    background[3] = 1.0F;
    std::copy(numbers.begin(), numbers.end(), background.begin());
}

void addPictureOptions(CLI::App& app, RenderArguments& arguments) {
    RenderOptions& options = arguments.options;
    app.add_option("-o,--output", arguments.output,
                   "File of the picture; its ending says the format: .exr (half float,\nlinear, all outputs), .png .tif .jpg (8-bit sRGB)")
        ->type_name("OUT")
        ->required();
    addSizeOptions(app, options);
    addParsed(
        app, "--background", [&options](const std::string& text) { readBackground(text, options.background); },
        "Linear colour and alpha where nothing is seen; alpha is 1 when left out")
        ->type_name("R,G,B[,A]")
        ->default_str(listText(options.background));
    groupRest(app, "Picture");
}

void addSplitOptions(CLI::App& app, RenderArguments& arguments) {
    RenderOptions& options = arguments.options;
    addModeOptions(app, arguments, ModeOptions::all);
    addMemoryOptions(app, options);
    app.add_flag("--cull-backfaces", options.cullBackfaces, "Drop micropolygons that face away (normal: du x dv)");
    app.add_flag("--headlight", options.headlight, "Light from the camera instead of the scene's lights");
    groupRest(app, "Splitting and memory");
}

void addDeviceOptions(CLI::App& app, RenderArguments& arguments) {
    addDeviceOption(app, arguments.settings.device);
    addWhole(app, "--threads", arguments.options.threads, {0, 1024}, "Host threads of --method cpu, 1 to 1024; 0 is one a core")
        ->type_name("N");
    app.add_flag("--emulate-atomics", arguments.options.emulateAtomics,
                 "Hide with 32-bit atomics in two passes even where there are 64-bit ones");
    addCacheOptions(app, arguments.settings);
    groupRest(app, "Device");
}

void addReportOptions(CLI::App& app, RenderArguments& arguments) {
    addWhole(app, "--frames", arguments.frames, {1, 100000}, "Render N times, 1 to 100000, and report the median frame")
        ->type_name("N")
        ->group("Reports");
    app.add_option("--stats", arguments.stats, "Write counts, times (ms) and memory (bytes) as JSON; - is standard output")
        ->type_name("FILE.json")
        ->group("Reports");
    app.add_option("--trace", arguments.trace, "Write every kernel and transfer as a trace for ui.perfetto.dev or\nchrome://tracing")
        ->type_name("FILE.json")
        ->group("Reports");
    app.add_flag("--quiet", arguments.quiet, "No progress, notes or summary: errors alone")->group("Reports");
}

}  // namespace

void addRenderOptions(CLI::App& app, RenderArguments& arguments) {
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    // Taken away and put back at the end: it is to stand last.
    app.set_help_flag();
    addSceneArguments(app, arguments.scene, "Scene");
    addPictureOptions(app, arguments);
    addCameraOptions(app, arguments.camera);
    addSplitOptions(app, arguments);
    addDeviceOptions(app, arguments);
    addReportOptions(app, arguments);
    app.set_help_flag("-h,--help", "Print this help and exit")->group("Reports");
}

void checkFrameOptions(const RenderArguments& arguments) {
    checkModeOptions(arguments);
    try {
        arguments.options.validate();
    } catch (const Error& error) {
        throw UsageError(error.what());
    }
}

void checkRenderArguments(const RenderArguments& arguments) {
    if (arguments.output == "-") throw UsageError("--output -: a picture cannot go to standard output, name a file");
    if (arguments.trace == "-") throw UsageError("--trace -: a trace cannot go to standard output, name a file");
    if (sameFile(arguments.output, arguments.stats) || sameFile(arguments.output, arguments.trace) ||
        sameFile(arguments.stats, arguments.trace)) {
        throw UsageError("--output, --stats and --trace name the same file: give each its own");
    }
    checkFrameOptions(arguments);
}

}  // namespace tessera::program
