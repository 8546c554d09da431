// The part of a command line that says which scene and how it is read.
#include "scene_arguments.h"

#include "add_options.h"
#include "console.h"
#include "load_scene.h"
#include "parse_values.h"

namespace tessera::program {

namespace {

// weld() takes no more.
constexpr double kLargestTolerance = 0.1;

}  // namespace

void addSceneArguments(CLI::App& app, SceneArguments& arguments, const std::string& group) {
    app.add_option("SCENE", arguments.scene, "What to read: " + sceneFormats())->type_name("")->required();
    addParsed(
        app, "--weld-tolerance",
        [&arguments](const std::string& text) { arguments.weldTolerance = parseFraction(text, kLargestTolerance); },
        "Borders of patches that agree within T become one, those shorter than T\na point; in parts of their mesh's size (its box's "
        "diagonal), 0 to 0.1; "
        "0\nmoves nothing")
        ->type_name("T")
        ->default_str(shortest(arguments.weldTolerance))
        ->group(group);
    app.add_flag("--flat", arguments.flat,
                 "Take a triangle mesh's triangles as they are; without it they are curved\nafter its normals (PN triangles)")
        ->group(group);
}

}  // namespace tessera::program
