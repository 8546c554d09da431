// The kernels of a device, built once.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "device/kernel_sources.h"
#include "device/program_cache.h"

namespace tessera {

// What a program is made of: files below src/, which may include others.
using KernelFiles = std::vector<std::string>;
[[nodiscard]] const KernelFiles& renderKernelFiles();  // of a Renderer
[[nodiscard]] const KernelFiles& meshKernelFiles();    // of a Tessellator
[[nodiscard]] const KernelFiles& tableKernelFiles();   // of a TableTessellator

class Kernels {
public:
    // Builds `files` of `sources` (kernelSources(), or a test's variation of them) for the device's shape.
    Kernels(const OpenDevice& device, const KernelSources& sources, const std::filesystem::path& cacheFolder,
            const KernelFiles& files = renderKernelFiles());

    // A kernel with its arguments set in order. Kernels are made once; each call sets all arguments anew.
    template <typename... Arguments>
    const cl::Kernel& with(const std::string& kernelName, const Arguments&... arguments) {
        cl::Kernel& kernel = find(kernelName);
        cl_uint index = 0;
        (kernel.setArg(index++, arguments), ...);
        return kernel;
    }

    [[nodiscard]] double buildMilliseconds() const { return buildMilliseconds_; }

private:
    cl::Kernel& find(const std::string& kernelName);

    cl::Program program_;
    std::map<std::string, cl::Kernel> kernels_;
    double buildMilliseconds_ = 0;
};

}  // namespace tessera
