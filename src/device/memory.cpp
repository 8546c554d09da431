#include "device/memory.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "tessera/error.h"

namespace tessera {

DeviceBuffer::DeviceBuffer(DeviceBuffer&& other) noexcept
    : buffer_(std::move(other.buffer_)), bytes_(std::exchange(other.bytes_, 0)), count_(std::move(other.count_)) {}

DeviceBuffer& DeviceBuffer::operator=(DeviceBuffer&& other) noexcept {
    DeviceBuffer taken(std::move(other));
    // The handles themselves: the bindings' own assignment may throw.
    std::swap(buffer_(), taken.buffer_());
    std::swap(bytes_, taken.bytes_);
    std::swap(count_, taken.count_);
    return *this;
}

DeviceBuffer::~DeviceBuffer() {
    if (count_) count_->now -= bytes_;
}

DeviceBuffer DeviceMemory::allocate(const std::string& purpose, std::uint64_t bytes, cl_mem_flags flags) {
    const std::uint64_t size = bytesFor(bytes);
    const DeviceInfo& info = device_.info;
    if (size > info.maxAllocationBytes || count_->now + size > info.globalBytes) {
        throw Error(purpose + " would need " + bytesText(size) + " of device memory beside " + bytesText(count_->now) + " in use, but " +
                    info.name + " holds " + bytesText(info.globalBytes) + ", at most " + bytesText(info.maxAllocationBytes) +
                    " in one buffer");
    }
    try {
        DeviceBuffer buffer;
        buffer.buffer_ = cl::Buffer(device_.context, flags, size);
        buffer.bytes_ = size;
        buffer.count_ = count_;
        count_->now += size;
        count_->peak = std::max(count_->peak, count_->now);
        return buffer;
    } catch (const cl::Error& error) {
        throw Error(purpose + ": " + info.name + " can't give " + bytesText(size) + " of memory: " + clErrorName(error.err()));
    }
}

bool DeviceMemory::ensure(DeviceBuffer& buffer, const std::string& purpose, std::uint64_t bytes, cl_mem_flags flags) {
    if (buffer.bytes() >= bytesFor(bytes)) return false;
    buffer = DeviceBuffer();
    buffer = allocate(purpose, bytes, flags);
    return true;
}

std::string bytesText(std::uint64_t bytes) {
    char text[64];
    std::snprintf(text, sizeof text, "%.1f MiB (%llu bytes)", static_cast<double>(bytes) / (1024.0 * 1024.0),
                  static_cast<unsigned long long>(bytes));
    return text;
}

}  // namespace tessera
