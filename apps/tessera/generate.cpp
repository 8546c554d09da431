// `tessera generate`: a scene made by rule, to an .mscene file.
#include "tessera/generate.h"
#include "add_options.h"
#include "commands.h"
#include "console.h"
#include "formats/mscene.h"
#include "formats/output_file.h"
#include "interrupt.h"
#include "parse_values.h"
#include "progress_line.h"
#include "tessera/error.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <optional>

namespace tessera::program {

namespace {

struct GenerateArguments {
    std::string scene;
    std::string output;
    std::optional<std::uint64_t> count;
    std::uint32_t seed = 1;
    bool quiet = false;
};

std::string sceneList() {
    std::string text = "Scenes, and what --count counts:";
    for (const GeneratedScene& scene : generatedScenes()) {
        std::string name(scene.name);
        name.resize(10, ' ');
        text += "\n  " + name + std::string(scene.contents) + ";\n            " + std::string(scene.counted) + ", " +
                std::to_string(scene.least) + " to " + std::to_string(scene.most) + ", " + std::to_string(scene.usual) + " without";
    }
    return text;
}

void addGenerateOptions(CLI::App& app, GenerateArguments& arguments) {
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    app.set_help_flag();
    std::string names;
    for (const std::string_view name : generatedSceneNames()) names += (names.empty() ? "" : ", ") + std::string(name);
    app.add_option("NAME", arguments.scene, "Which scene to make: " + names)->type_name("")->required();
    app.add_option("-o,--output", arguments.output, "File of the scene, its ending .mscene; an older one is replaced")
        ->type_name("FILE.mscene")
        ->required();
    addParsed(
        app, "--count",
        [&arguments](const std::string& text) {
            arguments.count = static_cast<std::uint64_t>(parseWhole(text, 0, std::numeric_limits<long long>::max()));
        },
        "How many, each scene in its range (below)")
        ->type_name("N");
    addWhole(app, "--seed", arguments.seed, {0, std::numeric_limits<std::uint32_t>::max()},
             "What chance begins with, 0 to 4294967295: the same seed gives the same\nfile on every machine")
        ->type_name("S");
    app.add_flag("--quiet", arguments.quiet, "No progress or summary: errors alone");
    app.set_help_flag("-h,--help", "Print this help and exit");
}

void checkCount(const GenerateArguments& arguments) {
    const auto& scenes = generatedScenes();
    const auto named = std::find_if(scenes.begin(), scenes.end(), [&](const GeneratedScene& one) { return one.name == arguments.scene; });
    if (named == scenes.end() || !arguments.count) return;
    if (*arguments.count >= named->least && *arguments.count <= named->most) return;
    throw UsageError("--count: '" + std::to_string(*arguments.count) + "' is out of range: " + std::to_string(named->least) + " to " +
                     std::to_string(named->most) + " " + std::string(named->counted) + " for " + arguments.scene);
}

void generate(const GenerateArguments& arguments) {
    checkCount(arguments);
    if (lowerEnding(arguments.output) != ".mscene") {
        throw UsageError("--output: '" + arguments.output + "' does not end in .mscene, by which its readers know it");
    }
    Interrupt interrupt;
    {
        const auto whole = interrupt.files();
        checkOutputFile(arguments.output);
    }
    ProgressLine line(!arguments.quiet, 1);
    // Making takes no longer than packing and writing, which cannot tell how far they are.
    const Progress progress = [&line](std::string_view stage, double fraction) { line.update(0, stage, 0.5 * fraction); };
    const Scene scene = generateScene(arguments.scene, arguments.count, arguments.seed, progress);
    line.update(0, "write", 0.5);
    const std::vector<std::byte> bytes = serializeMscene(scene);
    line.update(0, "write", 0.9);
    {
        const auto whole = interrupt.files();
        writeOutputFile(arguments.output, bytes);
    }
    line.clear();
    if (arguments.quiet) return;
    printSummary(arguments.scene + ": " + counted(scene.placedPatchCount(), "patch", "patches") + " in " +
                 counted(scene.objects.size(), "object", "objects") + " of " + counted(scene.meshes.size(), "mesh", "meshes") + ", " +
                 byteText(bytes.size()) + ", wrote " + arguments.output);
}

}  // namespace

Command addGenerateCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("generate", "Make a scene for measuring, of any size");
    command->get_formatter()->column_width(34);
    command->footer(sceneList() + "\nExample: tessera generate city --count 200000 -o city.mscene");
    const auto arguments = std::make_shared<GenerateArguments>();
    addGenerateOptions(*command, *arguments);
    const auto run = [arguments] {
        try {
            generate(*arguments);
        } catch (const std::bad_alloc&) {
            throw Error("generate " + arguments->scene + ": the host is out of memory; give a smaller --count");
        }
    };
    return {command, run};
}

}  // namespace tessera::program
