// Enqueues kernels and transfers on the device's queues and keeps what the device timed of them.
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
    void write(const cl::Buffer& buffer, const void* data, std::size_t bytes);                        // returns when `data` may be reused
    void writeAt(const cl::Buffer& buffer, std::size_t offset, const void* data, std::size_t bytes);  // the same, from `offset` bytes on
    void read(const cl::Buffer& buffer, void* data, std::size_t bytes);                               // returns when `data` is there
    void copy(const cl::Buffer& from, const cl::Buffer& to, std::size_t bytes);
    // Starts a read; `data` must stay until the event is complete.
    [[nodiscard]] cl::Event readLater(const cl::Buffer& buffer, void* data, std::size_t bytes);
    // Starts a write; `data` must stay until all is finished.
    void writeLater(const cl::Buffer& buffer, const void* data, std::size_t bytes);
    // Reads `rows` rows of `rowBytes` that lie one behind the other in `buffer` from `offset` on into `data` from `dataOffset` on, rows
    // `pitch` bytes apart. With `wait` returns when these and all reads before are there.
    void readRows(const cl::Buffer& buffer, std::size_t offset, std::size_t rowBytes, std::size_t rows, void* data, std::size_t dataOffset,
                  std::size_t pitch, bool wait);
    // Makes the buffer's bytes visible to the host; ends with unmap.
    [[nodiscard]] void* map(const cl::Buffer& buffer, std::size_t bytes);
    void unmap(const cl::Buffer& buffer, void* mapped);
    void flush() { device_.queue.flush(); }
    void finish() {
        device_.queue.finish();
        device_.transfers.finish();
    }

    // Starts a write on the transfer queue, behind those before it and, where it has one, `after`; both queues are flushed. `data` must
    // stay until the event is complete.
    [[nodiscard]] cl::Event upload(const cl::Buffer& buffer, const void* data, std::size_t bytes, const cl::Event& after);
    // An event that is complete when all is that the main queue has been given so far.
    [[nodiscard]] cl::Event mark();
    // Lets the main queue's next commands wait for an event.
    void await(const cl::Event& event);

    // Of the commands since restart(), all of which must have finished.
    [[nodiscard]] std::map<std::string, double> milliseconds();
    [[nodiscard]] std::vector<TraceEvent> trace();

private:
    struct Command {
        std::string label;
        cl::Event event;
    };
    using Commands = std::deque<Command>;
    cl::Event* record(Commands& commands, const std::string& label);
    cl::Event* record(const std::string& label) { return record(commands_, label); }
    void settle(Commands& commands);
    void settleAll();

    const OpenDevice& device_;
    Commands commands_;  // not yet summed
    Commands uploads_;   // the transfer queue's, for neither queue waits until the other's have ended
    std::map<std::string, std::uint64_t> sumsNs_;
    std::vector<TraceEvent> trace_;  // device times, absolute
    bool keepTrace_ = false;
};

}  // namespace tessera
