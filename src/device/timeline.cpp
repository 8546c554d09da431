#include "device/timeline.h"

#include <algorithm>

namespace tessera {
namespace {

// Events held before those that have ended are summed: a frame of small batches has millions of commands.
constexpr std::size_t commandsMost = 1024;

}  // namespace

void Timeline::launch(const cl::Kernel& kernel, const std::string& label, std::size_t groups, std::size_t local) {
    device_.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(groups * local), cl::NDRange(local), nullptr, record(label));
}

void Timeline::fill(const cl::Buffer& buffer, cl_uint pattern, std::size_t bytes) {
    device_.queue.enqueueFillBuffer(buffer, pattern, 0, bytes, nullptr, record("fill"));
}

void Timeline::write(const cl::Buffer& buffer, const void* data, std::size_t bytes) {
    device_.queue.enqueueWriteBuffer(buffer, CL_TRUE, 0, bytes, data, nullptr, record("write"));
}

void Timeline::read(const cl::Buffer& buffer, void* data, std::size_t bytes) {
    device_.queue.enqueueReadBuffer(buffer, CL_TRUE, 0, bytes, data, nullptr, record("read"));
}

void Timeline::copy(const cl::Buffer& from, const cl::Buffer& to, std::size_t bytes) {
    device_.queue.enqueueCopyBuffer(from, to, 0, 0, bytes, nullptr, record("copy"));
}

cl::Event Timeline::readLater(const cl::Buffer& buffer, void* data, std::size_t bytes) {
    cl::Event* const event = record("read");
    device_.queue.enqueueReadBuffer(buffer, CL_FALSE, 0, bytes, data, nullptr, event);
    return *event;
}

void* Timeline::map(const cl::Buffer& buffer, std::size_t bytes) {
    return device_.queue.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_READ, 0, bytes, nullptr, record("map"));
}

void Timeline::unmap(const cl::Buffer& buffer, void* mapped) { device_.queue.enqueueUnmapMemObject(buffer, mapped); }

void Timeline::restart(bool keepTrace) {
    commands_.clear();
    sumsNs_.clear();
    trace_.clear();
    keepTrace_ = keepTrace;
}

cl::Event* Timeline::record(const std::string& label) {
    if (commands_.size() >= commandsMost) settle();
    return &commands_.emplace_back(Command{label, {}}).event;
}

// Sums the commands that have ended, oldest first, and lets go of their events.
void Timeline::settle() {
    while (!commands_.empty() && commands_.front().event.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>() == CL_COMPLETE) {
        const Command& command = commands_.front();
        TraceEvent event;
        event.startNs = command.event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
        event.endNs = std::max(event.startNs, command.event.getProfilingInfo<CL_PROFILING_COMMAND_END>());
        sumsNs_[command.label] += event.endNs - event.startNs;
        if (keepTrace_) {
            event.name = command.label;
            event.queuedNs = command.event.getProfilingInfo<CL_PROFILING_COMMAND_QUEUED>();
            trace_.push_back(std::move(event));
        }
        commands_.pop_front();
    }
}

std::map<std::string, double> Timeline::milliseconds() {
    settle();
    std::map<std::string, double> sums;
    for (const auto& [label, nanoseconds] : sumsNs_) sums[label] = static_cast<double>(nanoseconds) * 1e-6;
    return sums;
}

std::vector<TraceEvent> Timeline::trace() {
    settle();
    std::vector<TraceEvent> events = trace_;
    std::uint64_t first = ~std::uint64_t{0};
    for (const TraceEvent& event : events) first = std::min(first, event.queuedNs);
    for (TraceEvent& event : events) {
        event.queuedNs -= first;
        event.startNs = std::max(event.startNs, first) - first;
        event.endNs = std::max(event.endNs, first) - first;
    }
    return events;
}

}  // namespace tessera
