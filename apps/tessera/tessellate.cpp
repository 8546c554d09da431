// `tessera tessellate`: a scene's surfaces to a mesh file, as fine as asked for.
#include "commands.h"
#include "console.h"
#include "interrupt.h"
#include "load_scene.h"
#include "mesh_output.h"
#include "mesh_stats_json.h"
#include "stats_json.h"
#include "tessellate_arguments.h"
#include "tessellate_report.h"
#include "tessellate_tables.h"
#include "tessera/error.h"
#include "tessera/tessellator.h"

#include <memory>
#include <new>
#include <string>
#include <vector>

namespace tessera::program {

namespace {

std::string patchesText(const MeshSizes& sizes) {
    std::string text = counted(sizes.patches, "patch", "patches");
    if (sizes.patchesCulled > 0) text += " (" + std::to_string(sizes.patchesCulled) + " out of view)";
    return text;
}

void tessellatePatches(TessellateArguments& arguments, Interrupt& interrupt, MeshOutput& output) {
    const LoadedScene loaded = loadScene(arguments.scene, arguments.quiet);
    TessellateOptions& options = arguments.options;
    options.positionsOnly = arguments.file.positionsOnly;
    const std::vector<std::string> notes = completeDensity(options, arguments.camera, loaded);
    Tessellator tessellator(arguments.settings);
    tessellator.setScene(loaded.scene, arguments.orientation);
    if (!arguments.quiet) {
        for (const std::string& note : notes) printNote(note);
    }
    const StreamedMesh mesh = streamMesh(tessellator, options, output, arguments.quiet);
    const MeshStatistics& statistics = tessellator.statistics();
    {
        const auto whole = interrupt.files();
        writeStats(arguments.stats, meshStatsJson({loaded.scene.name, options, statistics, mesh.written, mesh.totalMs, loaded.cages}));
    }
    if (arguments.quiet) return;
    const MeshSizes& sizes = statistics.sizes;
    if (sizes.patches > 0 && sizes.patchesCulled == sizes.patches) {
        printNote("all patches lie outside the view; choose a camera by --camera or --look-at, or keep them by --no-cull");
    } else if (sizes.patches > 0 && sizes.triangles == 0) {
        printNote("no patch has an area: the mesh is empty");
    }
    printSummary(meshSummary(patchesText(sizes), sizes, mesh, statistics.device, arguments));
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
    if (arguments.method == TessellateMethod::tables) {
        tessellateTables(arguments, interrupt, output);
    } else {
        tessellatePatches(arguments, interrupt, output);
    }
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
