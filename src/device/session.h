// An open device with what every station needs of it.
#pragma once

#include "device/kernels.h"
#include "device/memory.h"
#include "device/open_device.h"
#include "device/timeline.h"

namespace tessera {

struct DeviceSession {
    DeviceSession(int deviceIndex, const KernelSources& sources, const std::filesystem::path& cacheFolder, int lanes = 0,
                  const KernelFiles& files = renderKernelFiles())
        : device(openDevice(deviceIndex, lanes)), memory(device), timeline(device), kernels(device, sources, cacheFolder, files) {}
    DeviceSession(const DeviceSession&) = delete;
    DeviceSession& operator=(const DeviceSession&) = delete;
    ~DeviceSession() = default;

    // Launches in groups of the shape's size, the shape's number of groups where none is given.
    void launch(const cl::Kernel& kernel, const std::string& label) { launch(kernel, label, device.shape.groups); }
    void launch(const cl::Kernel& kernel, const std::string& label, std::size_t groups) {
        timeline.launch(kernel, label, groups, static_cast<std::size_t>(device.shape.group));
    }

    OpenDevice device;
    DeviceMemory memory;
    Timeline timeline;
    Kernels kernels;
};

}  // namespace tessera
