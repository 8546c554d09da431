// The one place where device memory is allocated, counted by purpose, and held to the budget.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "device/open_device.h"
#include "tessera/memory_plan.h"

namespace tessera {

enum class Purpose { scene, queues, film, picture };

class DeviceMemory;

// A handle of a device buffer. Copies share it; its bytes go back to the count with the last of them.
class DeviceBuffer {
public:
    [[nodiscard]] const cl::Buffer& cl() const;
    [[nodiscard]] std::uint64_t bytes() const;

private:
    friend class DeviceMemory;
    struct Held;
    std::shared_ptr<const Held> held_;
};

// Allocates and counts the buffers of one device.
class DeviceMemory {
public:
    explicit DeviceMemory(const OpenDevice& device);

    // What a buffer of `bytes` takes: 16 at least.
    [[nodiscard]] static constexpr std::uint64_t bytesFor(std::uint64_t bytes) { return bytes < 16 ? 16 : bytes; }

    // No allocation takes the sum beyond this: Error instead. At first all that the device holds.
    void setBudget(std::uint64_t bytes) { budget_ = bytes; }
    [[nodiscard]] std::uint64_t budget() const { return budget_; }

    // A buffer of bytesFor(bytes). `name` stands in the Error thrown when the budget or the device cannot give it.
    [[nodiscard]] DeviceBuffer allocate(Purpose purpose, const std::string& name, std::uint64_t bytes,
                                        cl_mem_flags flags = CL_MEM_READ_WRITE);

    // Makes `buffer` hold at least `bytes`; its contents are lost when it grows. Returns whether it is another buffer now.
    bool ensure(DeviceBuffer& buffer, Purpose purpose, const std::string& name, std::uint64_t bytes,
                cl_mem_flags flags = CL_MEM_READ_WRITE);

    [[nodiscard]] std::uint64_t bytes() const;
    [[nodiscard]] std::uint64_t peakBytes() const;
    // What each purpose held when the sum was at its peak.
    [[nodiscard]] MemoryUse peakUse() const;
    void restartPeak();

private:
    friend class DeviceBuffer;
    struct Count;
    const OpenDevice& device_;
    std::shared_ptr<Count> count_;
    std::uint64_t budget_;
};

// What a user's work may take where nothing else was said: 512 MiB or a quarter of the device's memory, whichever is less.
[[nodiscard]] std::uint64_t defaultBudget(const DeviceInfo& device);

// "64.0 MiB (67108864 bytes)".
[[nodiscard]] std::string bytesText(std::uint64_t bytes);

}  // namespace tessera
