// Enqueues kernels and transfers on the device's queue and keeps what the device timed of them.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "device/open_device.h"
#include "tessera/statistics.h"

namespace tessera {

class Timeline {
public:
    explicit Timeline(const OpenDevice& device) : device_(device) {}

    // Forgets the last frame's commands. Only with `keepTrace` is each of the next one's kept to its end; else their sums are.
    void restart(bool keepTrace);

    // Launches `groups` work-groups of `local` work-items. The label is the kernel's name.
    void launch(const cl::Kernel& kernel, const std::string& label, std::size_t groups, std::size_t local);
    void fill(const cl::Buffer& buffer, cl_uint pattern, std::size_t bytes);
    void write(const cl::Buffer& buffer, const void* data, std::size_t bytes);  // returns when `data` may be reused
    void read(const cl::Buffer& buffer, void* data, std::size_t bytes);         // returns when `data` is there
    void copy(const cl::Buffer& from, const cl::Buffer& to, std::size_t bytes);
    // Starts a read; `data` must stay until the event is complete.
    [[nodiscard]] cl::Event readLater(const cl::Buffer& buffer, void* data, std::size_t bytes);
    // Makes the buffer's bytes visible to the host; ends with unmap.
    [[nodiscard]] void* map(const cl::Buffer& buffer, std::size_t bytes);
    void unmap(const cl::Buffer& buffer, void* mapped);
    void flush() { device_.queue.flush(); }
    void finish() { device_.queue.finish(); }

    // Of the commands since restart(), all of which must have finished.
    [[nodiscard]] std::map<std::string, double> milliseconds();
    [[nodiscard]] std::vector<TraceEvent> trace();

private:
    struct Command {
        std::string label;
        cl::Event event;
    };
    cl::Event* record(const std::string& label);
    void settle();

    const OpenDevice& device_;
    std::deque<Command> commands_;  // not yet summed
    std::map<std::string, std::uint64_t> sumsNs_;
    std::vector<TraceEvent> trace_;  // device times, absolute
    bool keepTrace_ = false;
};

}  // namespace tessera
