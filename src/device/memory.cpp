#include "device/memory.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "tessera/error.h"

namespace tessera {

struct DeviceMemory::Count {
    MemoryUse now;
    MemoryUse peak;

    [[nodiscard]] static std::uint64_t& of(MemoryUse& use, Purpose purpose) {
        switch (purpose) {
            case Purpose::scene:
                return use.scene;
            case Purpose::queues:
                return use.queues;
            case Purpose::film:
                return use.film;
            case Purpose::picture:
                break;
        }
        return use.picture;
    }
    void add(Purpose purpose, std::uint64_t bytes) {
        of(now, purpose) += bytes;
        if (now.total() > peak.total()) peak = now;
    }
};

struct DeviceBuffer::Held {
    Held(std::shared_ptr<DeviceMemory::Count> count, Purpose purpose, std::uint64_t bytes, cl::Buffer buffer)
        : count_(std::move(count)), purpose_(purpose), bytes_(bytes), buffer_(std::move(buffer)) {
        count_->add(purpose_, bytes_);
    }
    ~Held() { DeviceMemory::Count::of(count_->now, purpose_) -= bytes_; }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;

    std::shared_ptr<DeviceMemory::Count> count_;
    Purpose purpose_;
    std::uint64_t bytes_;
    cl::Buffer buffer_;
};

const cl::Buffer& DeviceBuffer::cl() const {
    static const cl::Buffer none;
    return held_ ? held_->buffer_ : none;
}

std::uint64_t DeviceBuffer::bytes() const { return held_ ? held_->bytes_ : 0; }

DeviceMemory::DeviceMemory(const OpenDevice& device)
    : device_(device), count_(std::make_shared<Count>()), budget_(device.info.globalBytes) {}

std::uint64_t DeviceMemory::bytes() const { return count_->now.total(); }

std::uint64_t DeviceMemory::peakBytes() const { return count_->peak.total(); }

MemoryUse DeviceMemory::peakUse() const { return count_->peak; }

void DeviceMemory::restartPeak() { count_->peak = count_->now; }

DeviceBuffer DeviceMemory::allocate(Purpose purpose, const std::string& name, std::uint64_t bytes, cl_mem_flags flags) {
    const std::uint64_t size = bytesFor(bytes);
    const DeviceInfo& info = device_.info;
    const std::uint64_t used = count_->now.total();
    if (size > info.maxAllocationBytes || used + size > info.globalBytes) {
        throw Error(name + " would need " + bytesText(size) + " of device memory beside " + bytesText(used) + " in use, but " + info.name +
                    " holds " + bytesText(info.globalBytes) + ", at most " + bytesText(info.maxAllocationBytes) + " in one buffer");
    }
    if (used + size > budget_) {
        throw Error(name + " would need " + bytesText(size) + " of device memory beside " + bytesText(used) +
                    " in use, more than the budget of " + bytesText(budget_) + "; use a larger --memory");
    }
    try {
        DeviceBuffer buffer;
        buffer.held_ = std::make_shared<const DeviceBuffer::Held>(count_, purpose, size, cl::Buffer(device_.context, flags, size));
        return buffer;
    } catch (const cl::Error& error) {
        throw Error(name + ": " + info.name + " can't give " + bytesText(size) + " of memory: " + clErrorName(error.err()));
    }
}

bool DeviceMemory::ensure(DeviceBuffer& buffer, Purpose purpose, const std::string& name, std::uint64_t bytes, cl_mem_flags flags) {
    if (buffer.bytes() >= bytesFor(bytes)) return false;
    buffer = DeviceBuffer();
    buffer = allocate(purpose, name, bytes, flags);
    return true;
}

std::string bytesText(std::uint64_t bytes) {
    char text[64];
    std::snprintf(text, sizeof text, "%.1f MiB (%llu bytes)", static_cast<double>(bytes) / (1024.0 * 1024.0),
                  static_cast<unsigned long long>(bytes));
    return text;
}

std::uint64_t defaultBudget(const DeviceInfo& device) { return std::min(std::uint64_t{512} << 20, device.globalBytes / 4); }

}  // namespace tessera
