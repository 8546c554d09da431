// A frame's kernels and transfers as a trace: three tracks of one process, the device.
#include "trace_json.h"

#include "tessera/renderer.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace tessera::program {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kDeviceProcess = 1;
enum Track : int { queueTrack = 1, kernelTrack = 2, transferTrack = 3 };

bool isTransfer(std::string_view eventName) {
    constexpr std::array<std::string_view, 6> transfers{"read", "write", "copy", "fill", "map", "unmap"};
    return std::any_of(transfers.begin(), transfers.end(), [&](std::string_view transfer) { return eventName.starts_with(transfer); });
}

double microseconds(std::uint64_t nanoseconds) { return static_cast<double>(nanoseconds) / 1000.0; }

std::uint64_t between(std::uint64_t from, std::uint64_t to) { return to > from ? to - from : 0; }

Json complete(const TraceEvent& event, Track track, std::uint64_t startNs, std::uint64_t durationNs) {
    return {{"name", event.name},
            {"cat", track == kernelTrack     ? "kernel"
                    : track == transferTrack ? "transfer"
                                             : "queue"},
            {"ph", "X"},
            {"ts", microseconds(startNs)},
            {"dur", microseconds(durationNs)},
            {"pid", kDeviceProcess},
            {"tid", static_cast<int>(track)}};
}

Json nameOf(std::string_view what, std::string_view text, int track) {
    return {{"name", std::string(what)}, {"ph", "M"}, {"pid", kDeviceProcess}, {"tid", track}, {"args", {{"name", std::string(text)}}}};
}

void addExecution(Json& events, const TraceEvent& event) {
    Json json = complete(event, isTransfer(event.name) ? transferTrack : kernelTrack, event.startNs, between(event.startNs, event.endNs));
    json["args"] = {{"waited_us", microseconds(between(event.queuedNs, event.startNs))}};
    events.push_back(std::move(json));
}

// Commands wait in the queue together, but slices of one track must not overlap: a slice ends where the next command is
// queued, at the latest where its command starts.
void addQueue(Json& events, std::vector<TraceEvent> commands) {
    std::stable_sort(commands.begin(), commands.end(), [](const TraceEvent& a, const TraceEvent& b) { return a.queuedNs < b.queuedNs; });
    for (std::size_t i = 0; i < commands.size(); ++i) {
        std::uint64_t end = commands[i].startNs;
        if (i + 1 < commands.size()) end = std::min(end, commands[i + 1].queuedNs);
        events.push_back(complete(commands[i], queueTrack, commands[i].queuedNs, between(commands[i].queuedNs, end)));
    }
}

}  // namespace

std::string traceJson(const Statistics& statistics, const std::string& scene) {
    Json events = Json::array();
    events.push_back(nameOf("process_name", statistics.device, 0));
    events.push_back(nameOf("thread_name", "queue", queueTrack));
    events.push_back(nameOf("thread_name", "kernels", kernelTrack));
    events.push_back(nameOf("thread_name", "transfers", transferTrack));
    addQueue(events, statistics.trace);
    for (const TraceEvent& event : statistics.trace) addExecution(events, event);
    const Json json = {{"traceEvents", std::move(events)},
                       {"displayTimeUnit", "ms"},
                       {"otherData",
                        {{"version", "tessera " + std::string(versionString())},
                         {"scene", scene},
                         {"device", statistics.device},
                         {"frame_ms", statistics.frameMs}}}};
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tessera::program
