// `tessera tessellate`: a scene's surfaces to a mesh file, as fine as asked for.
#include "choose_camera.h"
#include "commands.h"
#include "console.h"
#include "interrupt.h"
#include "load_scene.h"
#include "mesh_output.h"
#include "mesh_stats_json.h"
#include "progress_line.h"
#include "stats_json.h"
#include "tessellate_arguments.h"
#include "tessera/error.h"
#include "tessera/tessellator.h"

#include <chrono>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::program {

namespace {

// Made whole of pieces and written as they come; what a file's end takes is not told by the tessellator.
constexpr double kStreamShare = 0.95;

double usualTolerance(const Scene& scene) {
    const Bounds bounds = worldBounds(scene);
    const double size = bounds.empty() ? 0.0 : glm::length(glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower));
    // Of what has no size any will do.
    return size > 0.0 ? size / 1000.0 : 1.0;
}

// Sets what is left open on the command line; returns what the user may not expect, a line each.
std::vector<std::string> completeOptions(TessellateArguments& arguments, const LoadedScene& loaded) {
    std::vector<std::string> notes = loaded.warnings;
    TessellateOptions& options = arguments.options;
    options.positionsOnly = arguments.file.positionsOnly;
    if (options.pixelError > 0.0) {
        const ChosenCamera chosen = chooseCamera(loaded.scene, arguments.camera);
        options.camera = chosen.camera;
        if (!chosen.note.empty()) notes.push_back(chosen.note);
    } else if (!(options.tolerance > 0.0)) {
        options.tolerance = usualTolerance(loaded.scene);
        notes.push_back("the tolerance is " + about(options.tolerance) + ", a thousandth of the scene's size; choose one by --tolerance");
    }
    return notes;
}

MeshReport makeMesh(Tessellator& tessellator, MeshOutput& output, const TessellateArguments& arguments, const std::string& scene) {
    ProgressLine line(!arguments.quiet, 1);
    // Without a line to show, the tessellator need not look at its counts in between.
    Progress progress;
    if (line.enabled()) progress = [&line](std::string_view stage, double fraction) { line.update(0, stage, kStreamShare * fraction); };
    const auto start = std::chrono::steady_clock::now();
    tessellator.stream(arguments.options, output, progress);
    line.update(0, "write", kStreamShare);
    MeshReport report{scene, arguments.options, tessellator.statistics(), output.finish(), 0.0};
    report.totalMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return report;
}

std::string summary(const MeshReport& report, const TessellateArguments& arguments) {
    const WrittenMesh& written = report.written;
    const MeshSizes& sizes = report.statistics.sizes;
    const bool welded = arguments.file.weld && written.vertices < sizes.distinctVertices;
    std::string text = counted(sizes.patches, "patch", "patches");
    if (sizes.patchesCulled > 0) text += " (" + std::to_string(sizes.patchesCulled) + " out of view)";
    text += ", " + counted(written.vertices, "vertex", "vertices") + (welded ? " (welded)" : "");
    if (written.quads > 0) text += ", " + counted(written.quads, "quad", "quads");
    text += ", " + counted(written.triangles, "triangle", "triangles");
    text += ", " + fixed(report.totalMs - written.writeMs, 1) + " ms on " + report.statistics.device;
    return text + ", " + byteText(written.bytes) + " in " + fixed(written.writeMs, 1) + " ms, wrote " + arguments.output;
}

void tessellate(TessellateArguments arguments) {
    checkTessellateArguments(arguments);
    Interrupt interrupt;
    // Before the work, which may be long: so that what cannot be written is told at once.
    MeshOutput output(interrupt, arguments.output, arguments.file);
    {
        const auto whole = interrupt.files();
        checkStatsFile(arguments.stats);
    }
    const LoadedScene loaded = loadScene(arguments.scene);
    const std::vector<std::string> notes = completeOptions(arguments, loaded);
    Tessellator tessellator(arguments.settings);
    tessellator.setScene(loaded.scene, arguments.orientation);
    if (!arguments.quiet) {
        for (const std::string& note : notes) printNote(note);
    }
    const MeshReport report = makeMesh(tessellator, output, arguments, loaded.scene.name);
    {
        const auto whole = interrupt.files();
        writeStats(arguments.stats, meshStatsJson(report));
    }
    if (arguments.quiet) return;
    const MeshSizes& sizes = report.statistics.sizes;
    if (sizes.patches > 0 && sizes.patchesCulled == sizes.patches) {
        printNote("all patches lie outside the view; choose a camera by --camera or --look-at, or keep them by --no-cull");
    } else if (sizes.patches > 0 && sizes.triangles == 0) {
        printNote("no patch has an area: the mesh is empty");
    }
    printSummary(summary(report, arguments));
}

}  // namespace

Command addTessellateCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("tessellate", "Make a triangle mesh without cracks of a scene's surfaces");
    command->get_formatter()->column_width(34);
    command->footer(
        "Examples: tessera tessellate teapot -o teapot.glb --tolerance 0.001\n"
        "          tessera tessellate city.mscene -o city.ply --pixel-error 0.5 --camera spike --size 1920x1080");
    const auto arguments = std::make_shared<TessellateArguments>();
    addTessellateOptions(*command, *arguments);
    const auto run = [arguments] {
        try {
            tessellate(*arguments);
        } catch (const std::bad_alloc&) {
            throw Error("tessellate " + arguments->scene.scene +
                        ": the host is out of memory; give a greater --tolerance or --pixel-error, or --no-weld");
        }
    };
    return {command, run};
}

}  // namespace tessera::program
