// Finds the scene that a command line names: a built-in one or a file.
#include "load_scene.h"

#include "formats/mscene.h"
#include "tessera/error.h"

#include <filesystem>
#include <string_view>
#include <system_error>

namespace tessera::program {

LoadedScene loadScene(const std::string& nameOrFile) {
    LoadedScene loaded;
    if (isBuiltinScene(nameOrFile)) {
        loaded.scene = builtinScene(nameOrFile);
        return loaded;
    }
    std::error_code ignored;
    if (!std::filesystem::exists(nameOrFile, ignored)) {
        throw Error("'" + nameOrFile + "' is neither a file nor a built-in scene (" + builtinSceneList() + ")");
    }
    loaded.scene = readMscene(nameOrFile, &loaded.warnings);
    if (loaded.scene.placedPatchCount() == 0) {
        loaded.warnings.push_back(nameOrFile + " places no patches: its picture shows the background alone");
    }
    return loaded;
}

std::string builtinSceneList() {
    std::string list;
    for (const std::string_view name : builtinSceneNames()) list += (list.empty() ? "" : ", ") + std::string(name);
    return list;
}

}  // namespace tessera::program
