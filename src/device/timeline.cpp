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

void Timeline::writeAt(const cl::Buffer& buffer, std::size_t offset, const void* data, std::size_t bytes) {
    device_.queue.enqueueWriteBuffer(buffer, CL_TRUE, offset, bytes, data, nullptr, record("write"));
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

void Timeline::writeLater(const cl::Buffer& buffer, const void* data, std::size_t bytes) {
    device_.queue.enqueueWriteBuffer(buffer, CL_FALSE, 0, bytes, data, nullptr, record("write"));
}

void Timeline::readRows(const cl::Buffer& buffer, std::size_t offset, std::size_t rowBytes, std::size_t rows, void* data,
                        std::size_t dataOffset, std::size_t pitch, bool wait) {
    // Origins count bytes in a row and rows: `offset` may lie anywhere, so it is given as bytes of one long row.
    const cl::array<cl::size_type, 3> from{offset, 0, 0};
    const cl::array<cl::size_type, 3> to{0, 0, 0};
    const cl::array<cl::size_type, 3> region{rowBytes, rows, 1};
    char* const target = static_cast<char*>(data) + dataOffset;
    device_.queue.enqueueReadBufferRect(buffer, wait ? CL_TRUE : CL_FALSE, from, to, region, rowBytes, 0, pitch, 0, target, nullptr,
                                        record("read"));
}

void* Timeline::map(const cl::Buffer& buffer, std::size_t bytes) {
    return device_.queue.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_READ, 0, bytes, nullptr, record("map"));
}

void Timeline::unmap(const cl::Buffer& buffer, void* mapped) { device_.queue.enqueueUnmapMemObject(buffer, mapped); }

cl::Event Timeline::upload(const cl::Buffer& buffer, const void* data, std::size_t bytes, const cl::Event& after) {
    std::vector<cl::Event> before;
    if (after() != nullptr) before.push_back(after);
    cl::Event* const event = record(uploads_, "upload");
    device_.transfers.enqueueWriteBuffer(buffer, CL_FALSE, 0, bytes, data, &before, event);
    // A queue may wait for another's event only when that is on its way to the device.
    device_.queue.flush();
    device_.transfers.flush();
    return *event;
}

cl::Event Timeline::mark() {
    cl::Event event;
    device_.queue.enqueueMarkerWithWaitList(nullptr, &event);
    return event;
}

void Timeline::await(const cl::Event& event) {
    const std::vector<cl::Event> before{event};
    device_.queue.enqueueBarrierWithWaitList(&before);
}

void Timeline::restart(bool keepTrace) {
    commands_.clear();
    uploads_.clear();
    sumsNs_.clear();
    trace_.clear();
    keepTrace_ = keepTrace;
}

cl::Event* Timeline::record(Commands& commands, const std::string& label) {
    if (commands.size() >= commandsMost) settle(commands);
    return &commands.emplace_back(Command{label, {}}).event;
}

// Sums the commands that have ended, oldest first, and lets go of their events.
void Timeline::settle(Commands& commands) {
    while (!commands.empty() && commands.front().event.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>() == CL_COMPLETE) {
        const Command& command = commands.front();
        TraceEvent event;
        event.startNs = command.event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
        event.endNs = std::max(event.startNs, command.event.getProfilingInfo<CL_PROFILING_COMMAND_END>());
        sumsNs_[command.label] += event.endNs - event.startNs;
        if (keepTrace_) {
            event.name = command.label;
            event.queuedNs = command.event.getProfilingInfo<CL_PROFILING_COMMAND_QUEUED>();
            trace_.push_back(std::move(event));
        }
        commands.pop_front();
    }
}

void Timeline::settleAll() {
    settle(commands_);
    settle(uploads_);
}

std::map<std::string, double> Timeline::milliseconds() {
    settleAll();
    std::map<std::string, double> sums;
    for (const auto& [label, nanoseconds] : sumsNs_) sums[label] = static_cast<double>(nanoseconds) * 1e-6;
    return sums;
}

std::vector<TraceEvent> Timeline::trace() {
    settleAll();
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
