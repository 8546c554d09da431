// The kernels' sources as compiled into the library, by path below src/.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace tessera {

using KernelSources = std::map<std::string, std::string, std::less<>>;

[[nodiscard]] const KernelSources& kernelSources();

// One text of all `files` with their #include "..." lines replaced by the files they name, each once.
// Throws Error when a file is missing from `sources`.
[[nodiscard]] std::string assembleKernels(const KernelSources& sources, const std::vector<std::string>& files);

}  // namespace tessera
