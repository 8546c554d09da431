// A run of bytes somewhere in an output file, put together in memory and written in large blocks.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "formats/output_file.h"

namespace tessera {

// Numbers are put as the host has them, which is as the formats want them.
static_assert(std::endian::native == std::endian::little);

class FileSection {
public:
    static constexpr std::size_t blockBytes = std::size_t{1} << 20U;

    // From `offset` of the file on. The file must outlive the section.
    FileSection(OutputFile& file, std::uint64_t offset) : file_(&file), offset_(offset), block_(blockBytes) {}

    // The next `bytes` of the section, at most blockBytes, to be filled by the caller before the next call.
    std::byte* room(std::size_t bytes) {
        if (used_ + bytes > blockBytes) flush();
        std::byte* const at = block_.data() + used_;
        used_ += bytes;
        return at;
    }

    void put(std::span<const std::byte> bytes) {
        while (!bytes.empty()) {
            const std::size_t some = bytes.size() < blockBytes ? bytes.size() : blockBytes;
            std::memcpy(room(some), bytes.data(), some);
            bytes = bytes.subspan(some);
        }
    }

    void flush() {
        file_->write(offset_, std::span(block_).first(used_));
        offset_ += used_;
        used_ = 0;
    }

    // The file's offset behind what was put.
    [[nodiscard]] std::uint64_t end() const { return offset_ + used_; }

private:
    OutputFile* file_;
    std::uint64_t offset_;  // of the block
    std::vector<std::byte> block_;
    std::size_t used_ = 0;
};

// Puts values into memory one after the other.
class BytePutter {
public:
    explicit BytePutter(std::byte* at) : at_(at) {}

    template <typename T>
    void put(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        std::memcpy(at_, &value, sizeof(T));
        at_ += sizeof(T);
    }
    template <typename T>
    void put(std::span<const T> values) {
        std::memcpy(at_, values.data(), values.size_bytes());
        at_ += values.size_bytes();
    }

private:
    std::byte* at_;
};

}  // namespace tessera
