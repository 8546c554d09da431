// `tessera tessellate --method tables`: Catmull-Clark surfaces by tables of coefficients.
#include "tessellate_tables.h"

#include "commands.h"
#include "console.h"
#include "load_scene.h"
#include "mesh_stats_json.h"
#include "stats_json.h"
#include "tessellate_report.h"
#include "tessera/subdivision_tables.h"

#include <string>
#include <vector>

namespace tessera::program {

namespace {

// As the command line says it.
TableOptions tableOptions(const TessellateArguments& arguments) {
    TableOptions options;
    options.level = arguments.level;
    options.tolerance = arguments.options.tolerance;
    options.pixelError = arguments.options.pixelError;
    options.width = arguments.options.width;
    options.height = arguments.options.height;
    options.order = arguments.order;
    options.positionsOnly = arguments.file.positionsOnly;
    options.memoryBytes = arguments.options.memoryBytes;
    return options;
}

std::string tablesText(const TableSizes& tables) {
    return counted(tables.faces, "face", "faces") + " of " + counted(tables.configurations, "table", "tables") + " (" +
           byteText(tables.tableBytes) + ")";
}

}  // namespace

void tessellateTables(const TessellateArguments& arguments, Interrupt& interrupt, MeshOutput& output) {
    const LoadedScene loaded = loadCages(arguments.scene);
    if (loaded.scene.cages.empty()) {
        throw UsageError("--method tables is for subdivision surfaces, and '" + arguments.scene.scene +
                         "' has none: give --subdivision-scheme catmull-clark for polygons, or --method patches");
    }
    TableOptions options = tableOptions(arguments);
    const std::vector<std::string> notes = options.level >= 0 ? loaded.warnings : completeDensity(options, arguments.camera, loaded);
    TableTessellator tessellator(arguments.settings);
    tessellator.setScene(loaded.scene, arguments.scene.subdivision.creaseAngle, options.memoryBytes);
    if (!arguments.quiet) {
        for (const std::string& note : notes) printNote(note);
    }
    const StreamedMesh mesh = streamMesh(tessellator, options, output, arguments.quiet);
    const TableStatistics& statistics = tessellator.statistics();
    {
        const auto whole = interrupt.files();
        writeStats(arguments.stats, tableStatsJson({loaded.scene.name, options, statistics, mesh.written, mesh.totalMs}));
    }
    if (arguments.quiet) return;
    printSummary(meshSummary(tablesText(statistics.tables), statistics.sizes, mesh, statistics.device, arguments));
}

}  // namespace tessera::program
