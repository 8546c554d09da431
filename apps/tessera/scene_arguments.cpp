// The part of a command line that says which scene and how it is read.
#include "scene_arguments.h"

#include "add_options.h"
#include "commands.h"
#include "console.h"
#include "load_scene.h"
#include "parse_values.h"
#include "tessera/error.h"

#include <algorithm>
#include <functional>

namespace tessera::program {

namespace {

// weld() takes no more.
constexpr double kLargestTolerance = 0.1;

constexpr double kLeastSubdivisionTolerance = 1e-9, kLargestSubdivisionTolerance = 0.1;

SubdivisionSurface parseSurface(const std::string& text) {
    if (text == "exact") return SubdivisionSurface::exact;
    if (text == "gregory") return SubdivisionSurface::gregory;
    throw Error("'" + text + "' is none of exact and gregory");
}

double parseSubdivisionTolerance(const std::string& text) {
    const double value = parseFraction(text, kLargestSubdivisionTolerance);
    if (value >= kLeastSubdivisionTolerance) return value;
    throw Error("'" + text + "' is out of range: " + shortest(kLeastSubdivisionTolerance) + " to " +
                shortest(kLargestSubdivisionTolerance));
}

void addSubdivisionOptions(CLI::App& app, SceneArguments& arguments, const std::string& group) {
    SubdivisionOptions& options = arguments.subdivision;
    const auto add = [&](const std::string& option, const std::function<void(const std::string&)>& read, const std::string& description) {
        const auto noted = [&arguments, option, read](const std::string& text) {
            read(text);
            arguments.given.push_back(option);
        };
        return addParsed(app, option, noted, description)->group(group);
    };
    add(
        "--subdivision-scheme", [&options](const std::string& text) { options.scheme = parseScheme(text); },
        "Take polygons as cages of subdivision surfaces: catmull-clark, loop,\nbilinear or none, smooth triangles. Without it OBJ files "
        "with "
        "tags, glTF\nwith TESSERA_subdivision_surface and .mscene cages have their own, other\npolygons none")
        ->type_name("NAME");
    add(
        "--subdivision-surface", [&options](const std::string& text) { options.surface = parseSurface(text); },
        "exact, the limit surface, or gregory, one patch a quadrilateral: cheaper,\nnear to it")
        ->type_name("NAME")
        ->default_str("exact");
    add(
        "--subdivision-tolerance", [&options](const std::string& text) { options.tolerance = parseSubdivisionTolerance(text); },
        "How far exact patches at irregular vertices may lie from the limit\nsurface, in parts of the cage's size (its box's diagonal), "
        "1e-9 to "
        "0.1")
        ->type_name("T")
        ->default_str(shortest(options.tolerance));
    add(
        "--crease-angle", [&options](const std::string& text) { options.creaseAngle = parseFraction(text, 180.0); },
        "Crease a cage's edges whose faces' normals differ by more than DEG, 0 to\n180; 180 creases none")
        ->type_name("DEG")
        ->default_str(shortest(options.creaseAngle));
}

}  // namespace

void addSceneArguments(CLI::App& app, SceneArguments& arguments, const std::string& group) {
    app.add_option("SCENE", arguments.scene, "What to read: " + sceneFormats())->type_name("")->required();
    addParsed(
        app, "--weld-tolerance",
        [&arguments](const std::string& text) {
            arguments.weldTolerance = parseFraction(text, kLargestTolerance);
            arguments.given.emplace_back("--weld-tolerance");
        },
        "Borders of patches that agree within T become one, those shorter than T\na point; in parts of their mesh's size (its box's "
        "diagonal), 0 to 0.1; "
        "0\nmoves nothing")
        ->type_name("T")
        ->default_str(shortest(arguments.weldTolerance))
        ->group(group);
    app.add_flag("--flat", arguments.flat,
                 "Take a triangle mesh's triangles as they are; without it they are curved\nafter its normals (PN triangles)")
        ->group(group);
    addSubdivisionOptions(app, arguments, group);
}

bool isGiven(const SceneArguments& arguments, const std::string& option) {
    return std::find(arguments.given.begin(), arguments.given.end(), option) != arguments.given.end();
}

std::string givenForSurfaces(const SceneArguments& arguments) {
    for (const char* const option : {"--subdivision-surface", "--subdivision-tolerance", "--crease-angle"}) {
        if (isGiven(arguments, option)) return option;
    }
    return {};
}

void checkSceneArguments(const SceneArguments& arguments) {
    const SubdivisionOptions& options = arguments.subdivision;
    const bool unsmoothed = options.scheme == SubdivisionScheme::none;
    if (arguments.flat && options.scheme.has_value() && !unsmoothed) {
        throw UsageError("--flat takes triangles as they are, and --subdivision-scheme smooths them: give one of them");
    }
    const std::string surface = givenForSurfaces(arguments);
    if (!surface.empty() && (arguments.flat || unsmoothed)) {
        throw UsageError(surface + " is for subdivision surfaces, which " + (arguments.flat ? "--flat" : "--subdivision-scheme none") +
                         " makes none of: leave one of them out");
    }
    if (options.surface == SubdivisionSurface::gregory && isGiven(arguments, "--subdivision-tolerance")) {
        throw UsageError("--subdivision-tolerance is for --subdivision-surface exact: leave one of them out");
    }
}

}  // namespace tessera::program
