// Finds the scene that a command line names: a built-in one, an .mscene file or a polygon mesh; makes meshes of its cages.
#include "load_scene.h"

#include "commands.h"
#include "console.h"
#include "formats/mesh_file.h"
#include "formats/mscene.h"
#include "parse_values.h"
#include "progress_line.h"
#include "tessera/error.h"

#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>

namespace tessera::program {

namespace {

enum class Source { builtin, mscene, polygons };

Source sourceOf(const std::string& nameOrFile) {
    if (isBuiltinScene(nameOrFile)) return Source::builtin;
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(nameOrFile, ignored);
    if (!std::filesystem::exists(status)) {
        throw Error("'" + nameOrFile + "' is neither a file nor a built-in scene: give " + sceneFormats());
    }
    if (std::filesystem::is_directory(status)) throw Error(nameOrFile + ": is a folder; name a scene file in it");
    if (lowerEnding(nameOrFile) == ".mscene") return Source::mscene;
    if (isMeshFile(nameOrFile)) return Source::polygons;
    throw Error(nameOrFile + ": its ending is that of no known format; give " + sceneFormats());
}

Scene readPolygons(const SceneArguments& arguments, std::vector<std::string>& warnings) {
    const std::optional<SubdivisionScheme> scheme = arguments.subdivision.scheme;
    if (arguments.flat || scheme == SubdivisionScheme::none) return readMeshFile(arguments.scene, arguments.flat, &warnings);
    return readCageFile(arguments.scene, scheme, &warnings);
}

Scene readScene(Source source, const SceneArguments& arguments, std::vector<std::string>& warnings) {
    if (source == Source::builtin) return builtinScene(arguments.scene);
    return source == Source::mscene ? readMscene(arguments.scene, &warnings) : readPolygons(arguments, warnings);
}

// Options for surfaces that are not there.
void checkSurfaces(Source source, const SceneArguments& arguments, const Scene& scene) {
    if (!scene.cages.empty()) return;
    const std::string none = ", and '" + arguments.scene + "' has none: ";
    if (arguments.subdivision.scheme.has_value() && source != Source::polygons) {
        throw UsageError("--subdivision-scheme is for polygons and cages" + none + "leave it out");
    }
    const std::string surface = givenForSurfaces(arguments);
    if (surface.empty()) return;
    throw UsageError(surface + " is for subdivision surfaces" + none +
                     (source == Source::polygons ? "give --subdivision-scheme, or leave it out" : "leave it out"));
}

// The reports' notes become warnings.
void makeMeshes(LoadedScene& loaded, SubdivisionOptions options, bool quiet) {
    if (loaded.scene.cages.empty()) return;
    ProgressLine line(!quiet, 1);
    if (line.enabled()) options.progress = [&line](std::string_view stage, double fraction) { line.update(0, stage, fraction); };
    loaded.cages = subdivide(loaded.scene, options);
    for (const CageReport& report : loaded.cages) {
        for (const std::string& note : report.notes) {
            loaded.warnings.push_back(loaded.scene.name + ": cage '" + oneLine(report.cage) + "': " + note);
        }
    }
}

}  // namespace

LoadedScene loadCages(const SceneArguments& arguments) {
    checkSceneArguments(arguments);
    const Source source = sourceOf(arguments.scene);
    if (arguments.flat && source != Source::polygons) {
        throw UsageError("--flat is for triangle meshes, and '" + arguments.scene + "' is none: leave it out");
    }
    LoadedScene loaded;
    loaded.scene = readScene(source, arguments, loaded.warnings);
    checkSurfaces(source, arguments, loaded.scene);
    for (Cage& cage : loaded.scene.cages) cage.scheme = arguments.subdivision.scheme.value_or(cage.scheme);
    return loaded;
}

LoadedScene loadScene(const SceneArguments& arguments, bool quiet) {
    LoadedScene loaded = loadCages(arguments);
    makeMeshes(loaded, arguments.subdivision, quiet);
    if (loaded.scene.placedPatchCount() == 0) {
        loaded.warnings.push_back(arguments.scene + " places no patches: there is nothing of it to be seen");
    }
    loaded.weld = weld(loaded.scene, arguments.weldTolerance);
    return loaded;
}

std::string sceneFormats() {
    std::string list;
    for (const std::string_view name : builtinSceneNames()) list += (list.empty() ? "" : ", ") + std::string(name);
    return "an .mscene file, a triangle mesh (OBJ, PLY, glTF, ...) or a built-in scene (" + list + ")";
}

}  // namespace tessera::program
