// The one place where device memory is allocated, and counted.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "device/open_device.h"

namespace tessera {

class DeviceMemory;

// A device buffer that gives its bytes back to the count when it goes.
class DeviceBuffer {
public:
    DeviceBuffer() = default;
    DeviceBuffer(DeviceBuffer&& other) noexcept;
    DeviceBuffer& operator=(DeviceBuffer&& other) noexcept;
    DeviceBuffer(const DeviceBuffer&) = delete;
    DeviceBuffer& operator=(const DeviceBuffer&) = delete;
    ~DeviceBuffer();

    [[nodiscard]] const cl::Buffer& cl() const { return buffer_; }
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

private:
    friend class DeviceMemory;
    struct Count {
        std::uint64_t now = 0;
        std::uint64_t peak = 0;
    };

    cl::Buffer buffer_;
    std::uint64_t bytes_ = 0;
    std::shared_ptr<Count> count_;
};

// Allocates and counts the buffers of one device.
class DeviceMemory {
public:
    explicit DeviceMemory(const OpenDevice& device) : device_(device), count_(std::make_shared<DeviceBuffer::Count>()) {}

    // What a buffer of `bytes` takes: 16 at least.
    [[nodiscard]] static constexpr std::uint64_t bytesFor(std::uint64_t bytes) { return bytes < 16 ? 16 : bytes; }

    // A buffer of bytesFor(bytes). `purpose` names it in the Error thrown when the device cannot give it.
    [[nodiscard]] DeviceBuffer allocate(const std::string& purpose, std::uint64_t bytes, cl_mem_flags flags = CL_MEM_READ_WRITE);

    // Makes `buffer` hold at least `bytes`; its contents are lost when it grows. Returns whether it is another buffer now.
    bool ensure(DeviceBuffer& buffer, const std::string& purpose, std::uint64_t bytes, cl_mem_flags flags = CL_MEM_READ_WRITE);

    [[nodiscard]] std::uint64_t bytes() const { return count_->now; }
    [[nodiscard]] std::uint64_t peakBytes() const { return count_->peak; }
    void restartPeak() { count_->peak = count_->now; }

private:
    const OpenDevice& device_;
    std::shared_ptr<DeviceBuffer::Count> count_;
};

// "64.0 MiB (67108864 bytes)".
[[nodiscard]] std::string bytesText(std::uint64_t bytes);

}  // namespace tessera
