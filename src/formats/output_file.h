// Output files that appear under their name complete or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace tessera {

// Throws Error unless a file of this name can be made: `path` is no folder, its name is not too long, and its folder takes new files
// (one is made there and removed again). An existing file is left as it is.
void checkOutputFile(const std::filesystem::path& path);

// Writes `bytes` to a temporary name in the folder of `path`, then gives the file its name, in place of an older one.
// Throws Error; the temporary is removed then and an older file of that name is left as it was.
void writeOutputFile(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace tessera
