#include "device/kernels.h"

#include <chrono>

#include "tessera/error.h"

namespace tessera {
namespace {

std::string buildOptions(const OpenDevice& device) {
    std::string options = "-cl-std=CL1.2 -DGROUP=" + std::to_string(device.shape.group) + " -DLANES=" + std::to_string(device.shape.lanes) +
                          " -DATOMICS64=" + (device.info.atomics64 ? "1" : "0");
    if (device.info.correctlyRoundedDivideSqrt) options += " -cl-fp32-correctly-rounded-divide-sqrt";
    return options;
}

}  // namespace

const KernelFiles& renderKernelFiles() {
    static const KernelFiles files = {"surface/place.cl",    "surface/evaluate.cl",  "split/split.cl",       "split/quad_split.cl",
                                      "split/feed.cl",       "split/local_quads.cl", "split/local_boxes.cl", "split/local_book.cl",
                                      "dice/dice_hide.cl",   "film/resolve.cl",      "film/coarse.cl",       "shade/shade.cl",
                                      "shade/shade_chunk.cl"};
    return files;
}

const KernelFiles& meshKernelFiles() {
    static const KernelFiles files = {"surface/place.cl", "mesh/factors.cl", "mesh/offsets.cl", "mesh/vertices.cl", "mesh/indices.cl"};
    return files;
}

const KernelFiles& tableKernelFiles() {
    static const KernelFiles files = {"tables/points.cl", "tables/levels.cl", "tables/vertices.cl", "mesh/offsets.cl", "mesh/indices.cl"};
    return files;
}

Kernels::Kernels(const OpenDevice& device, const KernelSources& sources, const std::filesystem::path& cacheFolder,
                 const KernelFiles& files) {
    const auto start = std::chrono::steady_clock::now();
    const std::filesystem::path folder = keepsOwnCache(device.info) ? std::filesystem::path() : cacheFolder;
    program_ = buildProgram(device, {assembleKernels(sources, files), buildOptions(device), folder});
    try {
        std::vector<cl::Kernel> kernels;
        program_.createKernels(&kernels);
        for (cl::Kernel& kernel : kernels) {
            std::string name = kernel.getInfo<CL_KERNEL_FUNCTION_NAME>();
            while (!name.empty() && name.back() == '\0') name.pop_back();
            kernels_.emplace(std::move(name), std::move(kernel));
        }
    } catch (const cl::Error& error) {
        throw Error("kernels can't be made on device " + device.info.name + ": " + clErrorName(error.err()));
    }
    buildMilliseconds_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

cl::Kernel& Kernels::find(const std::string& kernelName) {
    const auto found = kernels_.find(kernelName);
    if (found == kernels_.end()) throw Error("kernel '" + kernelName + "' is not in the program");
    return found->second;
}

}  // namespace tessera
