// What a frame measured of itself. Counts are of the frame; times are wall-clock or device milliseconds as said.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tessera {

// A kernel or transfer as the device timed it. Times in nanoseconds since the frame's first command was queued.
struct TraceEvent {
    std::string name;
    std::uint64_t queuedNs = 0;
    std::uint64_t startNs = 0;
    std::uint64_t endNs = 0;
};

struct Statistics {
    std::string device;
    int width = 0;  // of the full picture, pixels
    int height = 0;
    std::string mode;          // DiceMode's name
    float shadingRate = 0.0F;  // watertight mode: greatest area of a micropolygon, pixels; else 0
    int gridSize = 0;          // watertight mode: most micropolygons along an edge of a range; else 0
    std::string method;
    std::uint64_t batch = 0;
    int pixelSamples = 0;  // N of N x N
    std::uint64_t patches = 0;
    std::uint64_t rangesProcessed = 0;  // ranges bounded
    std::uint64_t rangesDiced = 0;
    std::uint64_t rangesCulled = 0;
    std::uint64_t rangesOccluded = 0;        // of the culled ones, those behind what was drawn already
    std::uint64_t patchesSkipped = 0;        // patches that were not bounded, because their box misses the bucket; once a bucket
    std::uint64_t stackPeak = 0;             // ranges; most that waited at the start of an iteration
    std::uint64_t iterations = 0;            // split iterations with work
    std::uint64_t batches = 0;               // dice-and-hide batches with work
    std::uint64_t micropolygons = 0;         // in the grids of the diced ranges
    std::uint64_t pixelsCovered = 0;         // pixels with a visible sample
    double splitMs = 0;                      // device time of the split kernels (host time for the cpu method)
    double frameMs = 0;                      // first enqueue to the picture on the host
    double buildMs = 0;                      // building or loading the kernels, when the renderer was made
    std::map<std::string, double> kernelMs;  // device time by kernel name
    std::uint64_t hostWaits = 0;             // times the host stood still for the device, the last one for the picture included
    std::uint64_t buckets = 1;               // parts of the picture that were rendered one after the other
    int bucketWidth = 0;                     // pixels, of the largest
    int bucketHeight = 0;
    std::uint64_t chunks = 1;                          // parts of the scene's patches that were on the device one after the other
    std::uint64_t streamedBytes = 0;                   // uploaded during the frame
    std::uint64_t stackGrowths = 0;                    // breadth: times that its buffers had to grow
    std::uint64_t launches = 0;                        // local: launches of its kernel
    std::vector<std::uint64_t> groupRanges;            // local: ranges that each work-group bounded
    std::uint64_t deviceBytesBudget = 0;               // what the frame's buffers may take
    std::uint64_t deviceBytesPeak = 0;                 // bytes of all device buffers at once
    std::map<std::string, std::uint64_t> deviceBytes;  // of them by purpose: "scene", "queues", "film", "picture"
    std::vector<TraceEvent> trace;                     // filled when RenderOptions::trace
};

}  // namespace tessera
