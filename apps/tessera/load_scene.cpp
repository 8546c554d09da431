// Finds the scene that a command line names: a built-in one, an .mscene file or a triangle mesh.
#include "load_scene.h"

#include "commands.h"
#include "formats/mesh_file.h"
#include "formats/mscene.h"
#include "parse_values.h"
#include "tessera/error.h"

#include <filesystem>
#include <string_view>
#include <system_error>

namespace tessera::program {

namespace {

enum class Source { builtin, mscene, triangles };

Source sourceOf(const std::string& nameOrFile) {
    if (isBuiltinScene(nameOrFile)) return Source::builtin;
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(nameOrFile, ignored);
    if (!std::filesystem::exists(status)) {
        throw Error("'" + nameOrFile + "' is neither a file nor a built-in scene: give " + sceneFormats());
    }
    if (std::filesystem::is_directory(status)) throw Error(nameOrFile + ": is a folder; name a scene file in it");
    if (lowerEnding(nameOrFile) == ".mscene") return Source::mscene;
    if (isMeshFile(nameOrFile)) return Source::triangles;
    throw Error(nameOrFile + ": its ending is that of no known format; give " + sceneFormats());
}

void readFile(LoadedScene& loaded, Source source, const SceneArguments& arguments) {
    const std::string& file = arguments.scene;
    loaded.scene = source == Source::mscene ? readMscene(file, &loaded.warnings) : readMeshFile(file, arguments.flat, &loaded.warnings);
    if (loaded.scene.placedPatchCount() == 0) {
        loaded.warnings.push_back(file + " places no patches: there is nothing of it to be seen");
    }
}

}  // namespace

LoadedScene loadScene(const SceneArguments& arguments) {
    const Source source = sourceOf(arguments.scene);
    if (arguments.flat && source != Source::triangles) {
        throw UsageError("--flat is for triangle meshes, and '" + arguments.scene + "' is none: leave it out");
    }
    LoadedScene loaded;
    if (source == Source::builtin) {
        loaded.scene = builtinScene(arguments.scene);
    } else {
        readFile(loaded, source, arguments);
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
