// Output files that appear under their name complete or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace tessera {

// Throws Error unless a file of this name can be made: `path` is no folder, its name is not too long, and its folder takes new files
// (one is made there and removed again). An existing file is left as it is.
void checkOutputFile(const std::filesystem::path& path);

// A file that is written piece by piece, anywhere in it, under a temporary name in the folder of its own; without giveName() it is removed
// again, and an older file of its name is left as it was. What goes wrong is thrown as Error with the file's name.
class OutputFile {
public:
    // checkOutputFile() tells more of what is wrong with `path`.
    explicit OutputFile(std::filesystem::path path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    OutputFile(OutputFile&&) = delete;
    OutputFile& operator=(OutputFile&&) = delete;

    // Makes the file so many bytes long and takes the space for them now, where the file system can: a disk too full is told at once.
    void reserve(std::uint64_t bytes);
    void write(std::uint64_t offset, std::span<const std::byte> bytes);
    // All is written: the file gets its name, in place of an older one. Nothing may be called after it.
    void giveName();

private:
    std::filesystem::path target_;
    std::filesystem::path temporary_;
    int descriptor_ = -1;
    bool named_ = false;
};

// Writes `bytes` to a temporary name in the folder of `path`, then gives the file its name, in place of an older one.
// Throws Error; the temporary is removed then and an older file of that name is left as it was.
void writeOutputFile(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace tessera
