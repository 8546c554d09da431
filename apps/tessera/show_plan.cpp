// A memory plan in words and as JSON.
#include "show_plan.h"

#include "console.h"

#include <nlohmann/json.hpp>

namespace tessera::program {

namespace {

std::string queuesText(const MemoryPlan& plan) {
    if (plan.readyCapacity == 0) return "grow with the ranges, beyond this plan";
    std::string text = plan.batch == 0 ? "" : counted(plan.batch, "range", "ranges") + " at a time, ";
    if (plan.stackCapacity != 0) text += "a stack of at most " + std::to_string(plan.stackCapacity) + ", ";
    return text + "room for " + std::to_string(plan.readyCapacity) + " that wait to be diced";
}

std::string sceneText(const MemoryPlan& plan) {
    if (!plan.streamed()) return "resident";
    return "streamed in " + std::to_string(plan.chunks) + " chunks of at most " + counted(plan.chunkPatches, "patch", "patches");
}

std::string bucketsText(const MemoryPlan& plan) {
    const std::string size = std::to_string(plan.bucketWidth) + "x" + std::to_string(plan.bucketHeight) + " pixels";
    if (plan.buckets() == 1) return "at once, " + size;
    return "in " + std::to_string(plan.bucketsX) + "x" + std::to_string(plan.bucketsY) + " buckets of at most " + size;
}

std::string mebibytes(std::uint64_t bytes) {
    const std::string text = fixed(static_cast<double>(bytes) / (1024.0 * 1024.0), 1);
    return std::string(text.size() < 8 ? 8 - text.size() : 0, ' ') + text + " MiB";
}

}  // namespace

std::string planText(const MemoryPlan& plan, const DeviceInfo& device) {
    return "memory  " + mebibytes(plan.bytes.total()) + " of a budget of " + byteText(plan.budget) + " on " + oneLine(device.name) +
           "\nscene   " + mebibytes(plan.bytes.scene) + ", " + sceneText(plan) + "\nqueues  " + mebibytes(plan.bytes.queues) + ", " +
           queuesText(plan) + "\nfilm    " + mebibytes(plan.bytes.film) + ", " + bucketsText(plan) + "\npicture " +
           mebibytes(plan.bytes.picture) + "\n";
}

nlohmann::ordered_json planJson(const MemoryPlan& plan, const DeviceInfo& device) {
    return {{"device", device.name},
            {"budget", plan.budget},
            {"bytes", plan.bytes.total()},
            {"device_bytes",
             {{"scene", plan.bytes.scene}, {"queues", plan.bytes.queues}, {"film", plan.bytes.film}, {"picture", plan.bytes.picture}}},
            {"batch", plan.batch},
            {"ready_capacity", plan.readyCapacity},
            {"stack_capacity", plan.stackCapacity},
            {"buckets", plan.buckets()},
            {"buckets_x", plan.bucketsX},
            {"buckets_y", plan.bucketsY},
            {"bucket_width", plan.bucketWidth},
            {"bucket_height", plan.bucketHeight},
            {"chunks", plan.chunks},
            {"chunk_patches", plan.chunkPatches}};
}

}  // namespace tessera::program
