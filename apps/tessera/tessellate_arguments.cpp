// The command line of `tessera tessellate`: every option with its unit, range and default.
#include "tessellate_arguments.h"

#include "add_options.h"
#include "commands.h"
#include "parse_values.h"
#include "shared_options.h"
#include "tessera/error.h"

#include <string_view>

namespace tessera::program {

namespace {

Orientation parseOrientation(const std::string& text) {
    if (text == "consistent") return Orientation::consistent;
    if (text == "given") return Orientation::asGiven;
    throw Error("'" + text + "' is none of consistent and given");
}

TessellateMethod parseTessellateMethod(const std::string& text) {
    if (text == "patches") return TessellateMethod::patches;
    if (text == "tables") return TessellateMethod::tables;
    throw Error("'" + text + "' is none of patches and tables");
}

TableOrder parseSummation(const std::string& text) {
    if (text == "ordered") return TableOrder::global;
    if (text == "unordered") return TableOrder::unordered;
    throw Error("'" + text + "' is none of ordered and unordered");
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
        app, "--orientation",
        [&arguments](const std::string& text) {
            arguments.orientation = parseOrientation(text);
            arguments.methodOptions.emplace_back("--orientation", TessellateMethod::patches);
        },
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

void addMethodOptions(CLI::App& app, TessellateArguments& arguments) {
    constexpr int kDeepest = 8;
    addParsed(
        app, "--method", [&arguments](const std::string& text) { arguments.method = parseTessellateMethod(text); },
        "patches, or tables: of Catmull-Clark surfaces alone, each vertex by a table\nof coefficients, all cells of a face alike")
        ->type_name("NAME")
        ->default_str("patches");
    addParsed(
        app, "--level",
        [&arguments](const std::string& text) {
            arguments.level = static_cast<int>(parseWhole(text, 0, kDeepest));
            arguments.methodOptions.emplace_back("--level", TessellateMethod::tables);
        },
        "Of tables, instead of --tolerance: every face gets 2^N cells along each\nside, 0 to 8")
        ->type_name("N");
    addParsed(
        app, "--summation",
        [&arguments](const std::string& text) {
            arguments.order = parseSummation(text);
            arguments.methodOptions.emplace_back("--summation", TessellateMethod::tables);
        },
        "Of tables: ordered, so that neighbours have the same bits along their edge,\nor unordered, faster")
        ->type_name("NAME")
        ->default_str("ordered");
    groupRest(app, "Method");
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
    addMethodOptions(app, arguments);
    addDensityOptions(app, arguments.options);
    addViewOptions(app, arguments);
    addDeviceOptions(app, arguments);
    addReportOptions(app, arguments);
    app.set_help_flag("-h,--help", "Print this help and exit")->group("Reports");
}

namespace {

std::string_view name(TessellateMethod method) { return method == TessellateMethod::tables ? "tables" : "patches"; }

// Options that the chosen method does not look at.
void checkMethod(const TessellateArguments& arguments) {
    const auto refuse = [&](const std::string& option, TessellateMethod wanted) {
        throw UsageError(option + " is for --method " + std::string(name(wanted)) + ": leave it out, or choose that method");
    };
    for (const auto& [option, method] : arguments.methodOptions) {
        if (method != arguments.method) refuse(option, method);
    }
    if (arguments.method != TessellateMethod::tables) return;
    for (const char* const option : {"--weld-tolerance", "--subdivision-surface", "--subdivision-tolerance"}) {
        if (isGiven(arguments.scene, option)) refuse(option, TessellateMethod::patches);
    }
    if (!arguments.options.cull) refuse("--no-cull", TessellateMethod::patches);
    if (arguments.scene.flat) refuse("--flat", TessellateMethod::patches);
    if (arguments.scene.subdivision.scheme.value_or(SubdivisionScheme::catmullClark) != SubdivisionScheme::catmullClark) {
        throw UsageError("--method tables is for --subdivision-scheme catmull-clark alone: choose one of them otherwise");
    }
}

}  // namespace

void checkTessellateArguments(const TessellateArguments& arguments) {
    const TessellateOptions& options = arguments.options;
    if (arguments.output == "-") throw UsageError("--output -: a mesh cannot go to standard output, name a file");
    if (sameFile(arguments.output, arguments.stats)) throw UsageError("--output and --stats name the same file: give each its own");
    if (sameFile(arguments.output, arguments.scene.scene)) throw UsageError("--output names the scene's own file: give the mesh another");
    if (sameFile(arguments.stats, arguments.scene.scene)) throw UsageError("--stats names the scene's own file: give another");
    if (options.tolerance > 0.0 && options.pixelError > 0.0) {
        throw UsageError("--tolerance and --pixel-error both say how fine the mesh is: give one of them");
    }
    checkMethod(arguments);
    if (arguments.level >= 0 && (options.tolerance > 0.0 || options.pixelError > 0.0)) {
        throw UsageError("--level, --tolerance and --pixel-error all say how fine the mesh is: give one of them");
    }
    if (options.pixelError > 0.0 || arguments.viewOptions.empty()) return;
    throw UsageError(arguments.viewOptions.front() + " does nothing without --pixel-error: leave it out, or give --pixel-error");
}

}  // namespace tessera::program
