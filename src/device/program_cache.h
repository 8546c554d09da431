// Builds kernels, and keeps what was built on disk.
#pragma once

#include <filesystem>
#include <string>

#include "device/open_device.h"

namespace tessera {

struct BuildRequest {
    std::string source;
    std::string options;
    std::filesystem::path cacheFolder;  // empty: no cache
};

// $TESSERA_CACHE, else $XDG_CACHE_HOME/tessera, else ~/.cache/tessera; empty where none of them is known.
[[nodiscard]] std::filesystem::path defaultCacheFolder();

// Where a renderer keeps its kernels: `folder`, the default one where that is empty, or none.
[[nodiscard]] std::filesystem::path cacheFolder(bool cacheKernels, const std::string& folder);

// Whether the platform keeps built kernels on disk itself, as PoCL does. Asking PoCL for a program's binary makes it compile every kernel
// for unknown group sizes: 5 s, to save nothing.
[[nodiscard]] bool keepsOwnCache(const DeviceInfo& info);

// Loads the program from the cache or builds it, and stores it then. The key covers device, driver, options and source.
// A cache that can't be read, is stale or can't be written only costs time. Throws Error with the first line of the build log.
[[nodiscard]] cl::Program buildProgram(const OpenDevice& device, const BuildRequest& request);

}  // namespace tessera
