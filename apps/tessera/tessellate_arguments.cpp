// The command line of `tessera tessellate`: every option with its unit, range and default.
#include "tessellate_arguments.h"

#include "add_options.h"
#include "commands.h"
#include "parse_values.h"
#include "shared_options.h"
#include "tessera/error.h"

namespace tessera::program {

namespace {

Orientation parseOrientation(const std::string& text) {
    if (text == "consistent") return Orientation::consistent;
    if (text == "given") return Orientation::asGiven;
    throw Error("'" + text + "' is none of consistent and given");
}

void addMeshOptions(CLI::App& app, TessellateArguments& arguments) {
    MeshFileOptions& file = arguments.file;
    app.add_option(
           "-o,--output", arguments.output,
           "File of the mesh; its ending says the format: .ply (binary), .obj, .glb\n(glTF, binary), .stl (binary: positions alone)")
        ->type_name("OUT")
        ->required();
    CLI::Option* weld = app.add_flag_callback(
        "--weld", [&file] { file.weld = true; },
        "Share the vertices along borders between patches (the default); .glb\nshares them with --positions-only, .stl never");
    app.add_flag_callback(
           "--no-weld", [&file] { file.weld = false; }, "Keep each patch's own vertices")
        ->excludes(weld);
    app.add_flag("--quads", file.quads, "Cells of four corners as quads: .ply and .obj");
    app.add_flag("--positions-only", file.positionsOnly, "No normals, (u,v), object and patch ids");
    addParsed(
        app, "--orientation", [&arguments](const std::string& text) { arguments.orientation = parseOrientation(text); },
        "Which way triangles and normals turn: consistent (of patches that meet, the\nfewer are turned so that all agree) or given (as "
        "(u,v) run)")
        ->type_name("NAME")
        ->default_str("consistent");
    groupRest(app, "Mesh");
}

void readSize(const std::string& text, TessellateOptions& options) {
    const Size size = parseSize(text);
    options.width = size.width;
    options.height = size.height;
}

void addDensityOptions(CLI::App& app, TessellateOptions& options) {
    addParsed(
        app, "--tolerance", [&options](const std::string& text) { options.tolerance = parsePositive(text); },
        "Greatest distance between mesh and surface in scene units, above 0; without\nit and --pixel-error a thousandth of the scene's "
        "size "
        "(its box's diagonal)")
        ->type_name("D");
    addParsed(
        app, "--pixel-error", [&options](const std::string& text) { options.pixelError = parsePositive(text); },
        "The same in pixels, above 0, as a camera sees it: finer where it is near.\nWhat is out of its view is left out")
        ->type_name("PX");
    groupRest(app, "Density");
}

// Options that say nothing unless --pixel-error is there; those given are remembered.
void addViewOptions(CLI::App& app, TessellateArguments& arguments) {
    TessellateOptions& options = arguments.options;
    const auto given = [&arguments](const std::string& option) { arguments.viewOptions.push_back(option); };
    addCameraOptions(app, arguments.camera, given);
    addParsed(
        app, "--size",
        [&options, given](const std::string& text) {
            readSize(text, options);
            given("--size");
        },
        "Width and height in pixels of the picture that --pixel-error is of, each 1\nto 65536")
        ->type_name("WxH")
        ->default_str(std::to_string(options.width) + "x" + std::to_string(options.height));
    app.add_flag_callback(
        "--no-cull",
        [&options, given] {
            options.cull = false;
            given("--no-cull");
        },
        "Keep what is out of the camera's view, too");
    groupRest(app, "Camera");
}

void addDeviceOptions(CLI::App& app, TessellateArguments& arguments) {
    addMemoryOption(app, arguments.options.memoryBytes);
    addDeviceOption(app, arguments.settings.device);
    addCacheOptions(app, arguments.settings);
    groupRest(app, "Memory and device");
}

void addReportOptions(CLI::App& app, TessellateArguments& arguments) {
    app.add_option("--stats", arguments.stats, "Write counts, times by stage (ms) and memory (bytes) as JSON; - is standard\noutput")
        ->type_name("FILE.json");
    app.add_flag("--quiet", arguments.quiet, "No progress, notes or summary: errors alone");
    groupRest(app, "Reports");
}

}  // namespace

void addTessellateOptions(CLI::App& app, TessellateArguments& arguments) {
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    // Taken away and put back at the end: it is to stand last.
    app.set_help_flag();
    addSceneArguments(app, arguments.scene, "Scene");
    addMeshOptions(app, arguments);
    addDensityOptions(app, arguments.options);
    addViewOptions(app, arguments);
    addDeviceOptions(app, arguments);
    addReportOptions(app, arguments);
    app.set_help_flag("-h,--help", "Print this help and exit")->group("Reports");
}

void checkTessellateArguments(const TessellateArguments& arguments) {
    const TessellateOptions& options = arguments.options;
    if (arguments.output == "-") throw UsageError("--output -: a mesh cannot go to standard output, name a file");
    if (sameFile(arguments.output, arguments.stats)) throw UsageError("--output and --stats name the same file: give each its own");
    if (sameFile(arguments.output, arguments.scene.scene)) throw UsageError("--output names the scene's own file: give the mesh another");
    if (sameFile(arguments.stats, arguments.scene.scene)) throw UsageError("--stats names the scene's own file: give another");
    if (options.tolerance > 0.0 && options.pixelError > 0.0) {
        throw UsageError("--tolerance and --pixel-error both say how fine the mesh is: give one of them");
    }
    if (options.pixelError > 0.0 || arguments.viewOptions.empty()) return;
    throw UsageError(arguments.viewOptions.front() + " does nothing without --pixel-error: leave it out, or give --pixel-error");
}

}  // namespace tessera::program
