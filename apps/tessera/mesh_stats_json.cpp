// A tessellation's statistics as JSON, under the names that --stats promises.
#include "mesh_stats_json.h"

#include "tessera/renderer.h"

#include <nlohmann/json.hpp>

namespace tessera::program {

namespace {

using nlohmann::ordered_json;

void addOptions(ordered_json& json, const TessellateOptions& options) {
    const bool seen = options.camera.has_value();
    json["camera"] = seen ? ordered_json(options.camera->name) : ordered_json();
    json["width"] = seen ? ordered_json(options.width) : ordered_json();
    json["height"] = seen ? ordered_json(options.height) : ordered_json();
    json["tolerance"] = seen ? ordered_json() : ordered_json(options.tolerance);
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

}  // namespace

std::string meshStatsJson(const MeshReport& report) {
    const MeshStatistics& statistics = report.statistics;
    ordered_json json;
    json["version"] = std::string(versionString());
    json["scene"] = report.scene;
    addOptions(json, report.options);
    json["device"] = statistics.device;
    addSizes(json, statistics.sizes);
    json["pieces"] = statistics.pieces;
    json["chunks"] = statistics.chunks;
    json["file_vertices"] = report.written.vertices;
    json["file_triangles"] = report.written.triangles;
    json["file_quads"] = report.written.quads;
    json["file_bytes"] = report.written.bytes;
    addTimes(json, statistics);
    json["write_ms"] = report.written.writeMs;
    json["total_ms"] = report.totalMs;
    json["kernel_ms"] = ordered_json::object();
    for (const auto& [kernel, milliseconds] : statistics.kernelMs) json["kernel_ms"][kernel] = milliseconds;
    json["build_ms"] = statistics.buildMs;
    json["device_bytes_budget"] = statistics.deviceBytesBudget;
    json["device_bytes_peak"] = statistics.deviceBytesPeak;
    // Names come from files, whose bytes need not be UTF-8.
    return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace tessera::program
