// A tessellation's statistics as JSON, under the names that --stats promises.
#include "mesh_stats_json.h"

#include "subdivision_json.h"
#include "tessera/renderer.h"

#include <nlohmann/json.hpp>

namespace tessera::program {

namespace {

using nlohmann::ordered_json;

// Options is TessellateOptions or TableOptions.
template <typename Options>
void addOptions(ordered_json& json, const Options& options) {
    const bool seen = options.camera.has_value();
    json["camera"] = seen ? ordered_json(options.camera->name) : ordered_json();
    json["width"] = seen ? ordered_json(options.width) : ordered_json();
    json["height"] = seen ? ordered_json(options.height) : ordered_json();
    json["tolerance"] = options.tolerance > 0.0 && !seen ? ordered_json(options.tolerance) : ordered_json();
    json["pixel_error"] = seen ? ordered_json(options.pixelError) : ordered_json();
}

void addSizes(ordered_json& json, const MeshSizes& sizes) {
    json["patches"] = sizes.patches;
    json["patches_culled"] = sizes.patchesCulled;
    json["units"] = sizes.units;
    json["vertices"] = sizes.vertices;
    json["distinct_vertices"] = sizes.distinctVertices;
    json["triangles"] = sizes.triangles;
    json["vertex_bytes"] = sizes.vertexBytes;
    json["index_bytes"] = sizes.indexBytes;
}

void addTimes(ordered_json& json, const MeshStatistics& statistics) {
    json["place_ms"] = statistics.placeMs;
    json["factors_ms"] = statistics.factorsMs;
    json["offsets_ms"] = statistics.offsetsMs;
    json["vertex_ms"] = statistics.vertexMs;
    json["index_ms"] = statistics.indexMs;
    json["tessellate_ms"] = statistics.tessellateMs;
}

void addWritten(ordered_json& json, const WrittenMesh& written) {
    json["file_vertices"] = written.vertices;
    json["file_triangles"] = written.triangles;
    json["file_quads"] = written.quads;
    json["file_bytes"] = written.bytes;
}

void addTables(ordered_json& json, const TableSizes& tables) {
    json["faces"] = tables.faces;
    json["configurations"] = tables.configurations;
    json["edge_classes"] = tables.edgeClasses;
    json["vertex_classes"] = tables.vertexClasses;
    json["coarse_steps"] = tables.coarseSteps;
    json["table_bytes"] = tables.tableBytes;
    json["table_index_bytes"] = tables.indexBytes;
    json["stencil_bytes"] = tables.stencilBytes;
    json["point_bytes"] = tables.pointBytes;
    json["table_build_ms"] = tables.buildMs;
}

void addTimes(ordered_json& json, const TableStatistics& statistics) {
    json["upload_ms"] = statistics.uploadMs;
    json["coarse_ms"] = statistics.coarseMs;
    json["levels_ms"] = statistics.levelsMs;
    json["vertex_ms"] = statistics.vertexMs;
    json["index_ms"] = statistics.indexMs;
    json["tessellate_ms"] = statistics.tessellateMs;
}

// Names come from files, whose bytes need not be UTF-8.
std::string textOf(const ordered_json& json) { return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n"; }

}  // namespace

std::string meshStatsJson(const MeshReport& report) {
    const MeshStatistics& statistics = report.statistics;
    ordered_json json;
    json["version"] = std::string(versionString());
    json["scene"] = report.scene;
    json["method"] = "patches";
    addOptions(json, report.options);
    json["device"] = statistics.device;
    addSizes(json, statistics.sizes);
    json["pieces"] = statistics.pieces;
    json["chunks"] = statistics.chunks;
    addWritten(json, report.written);
    addTimes(json, statistics);
    json["write_ms"] = report.written.writeMs;
    json["total_ms"] = report.totalMs;
    json["kernel_ms"] = ordered_json::object();
    for (const auto& [kernel, milliseconds] : statistics.kernelMs) json["kernel_ms"][kernel] = milliseconds;
    json["build_ms"] = statistics.buildMs;
    json["device_bytes_budget"] = statistics.deviceBytesBudget;
    json["device_bytes_peak"] = statistics.deviceBytesPeak;
    json["subdivision"] = subdivisionJson(report.cages);
    return textOf(json);
}

std::string tableStatsJson(const TableReport& report) {
    const TableStatistics& statistics = report.statistics;
    ordered_json json;
    json["version"] = std::string(versionString());
    json["scene"] = report.scene;
    json["method"] = "tables";
    json["level"] = report.options.level >= 0 ? ordered_json(report.options.level) : ordered_json();
    json["summation"] = report.options.order == TableOrder::global ? "ordered" : "unordered";
    addOptions(json, report.options);
    json["device"] = statistics.device;
    addTables(json, statistics.tables);
    addSizes(json, statistics.sizes);
    addWritten(json, report.written);
    addTimes(json, statistics);
    json["write_ms"] = report.written.writeMs;
    json["total_ms"] = report.totalMs;
    json["uploaded_bytes"] = statistics.uploadedBytes;
    json["device_bytes_budget"] = statistics.deviceBytesBudget;
    json["device_bytes_peak"] = statistics.deviceBytesPeak;
    return textOf(json);
}

}  // namespace tessera::program
