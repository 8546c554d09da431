// A frame's statistics as JSON, under the names that --stats promises.
#include "stats_json.h"

#include "console.h"
#include "formats/output_file.h"
#include "subdivision_json.h"
#include "tessera/renderer.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

namespace tessera::program {

std::string statsJson(const Statistics& statistics, const std::string& scene, const std::string& camera, std::span<const double> frameMs,
                      std::span<const CageReport> cages) {
    nlohmann::ordered_json json;
    json["version"] = std::string(versionString());
    json["scene"] = scene;
    json["camera"] = camera;
    json["device"] = statistics.device;
    json["width"] = statistics.width;
    json["height"] = statistics.height;
    json["pixel_samples"] = statistics.pixelSamples;
    json["mode"] = statistics.mode;
    // As it would be typed: as a double 0.1 would print as 0.10000000149011612.
    json["shading_rate"] = nlohmann::ordered_json::parse(shortest(statistics.shadingRate));
    json["grid_size"] = statistics.gridSize;
    json["method"] = statistics.method;
    json["batch"] = statistics.batch;
    json["patches"] = statistics.patches;
    json["ranges_processed"] = statistics.rangesProcessed;
    json["ranges_diced"] = statistics.rangesDiced;
    json["ranges_culled"] = statistics.rangesCulled;
    json["ranges_occluded"] = statistics.rangesOccluded;
    json["patches_skipped"] = statistics.patchesSkipped;
    json["stack_peak"] = statistics.stackPeak;
    json["iterations"] = statistics.iterations;
    json["batches"] = statistics.batches;
    json["micropolygons"] = statistics.micropolygons;
    json["pixels_covered"] = statistics.pixelsCovered;
    json["buckets"] = statistics.buckets;
    json["bucket_width"] = statistics.bucketWidth;
    json["bucket_height"] = statistics.bucketHeight;
    json["chunks"] = statistics.chunks;
    json["streamed_bytes"] = statistics.streamedBytes;
    json["stack_growths"] = statistics.stackGrowths;
    json["launches"] = statistics.launches;
    json["group_ranges"] = statistics.groupRanges;
    json["host_waits"] = statistics.hostWaits;
    json["split_ms"] = statistics.splitMs;
    json["frame_ms"] = statistics.frameMs;
    json["frame_ms_all"] = std::vector<double>(frameMs.begin(), frameMs.end());
    json["kernel_ms"] = nlohmann::ordered_json::object();
    for (const auto& [kernel, milliseconds] : statistics.kernelMs) json["kernel_ms"][kernel] = milliseconds;
    json["build_ms"] = statistics.buildMs;
    json["device_bytes_budget"] = statistics.deviceBytesBudget;
    json["device_bytes_peak"] = statistics.deviceBytesPeak;
    json["device_bytes"] = nlohmann::ordered_json::object();
    for (const auto& [purpose, bytes] : statistics.deviceBytes) json["device_bytes"][purpose] = bytes;
    json["subdivision"] = subdivisionJson(cages);
    // Names come from files, whose bytes need not be UTF-8.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void checkStatsFile(const std::string& path) {
    if (!path.empty() && path != "-") checkOutputFile(path);
}

void writeStats(const std::string& path, const std::string& json) {
    if (path.empty()) return;
    if (path == "-") {
        printResult(json);
    } else {
        writeOutputFile(path, std::as_bytes(std::span(json)));
    }
}

}  // namespace tessera::program
