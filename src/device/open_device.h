// Chooses and opens an OpenCL device.
#pragma once

#include "device/opencl.h"
#include "tessera/device.h"

namespace tessera {

// How kernels are laid over a device (device/lanes.clh).
struct DeviceShape {
    int group = 1;         // work-items a group
    int lanes = 16;        // values a work-item computes at a time
    unsigned groups = 64;  // groups a launch; each takes chunk after chunk
};

struct OpenDevice {
    DeviceInfo info;
    cl::Device device;
    cl::Context context;
    cl::CommandQueue queue;      // in order, with profiling
    cl::CommandQueue transfers;  // the same, for uploads beside what `queue` does
    DeviceShape shape;
};

// Opens DeviceInfo::index `index`, or the default for -1. `lanes`: 16, 8 or 1, or 0 for what suits the device's type.
// Throws Error: no device, unknown index, unusable device, other numbers of lanes.
[[nodiscard]] OpenDevice openDevice(int index, int lanes = 0);

// "CL_OUT_OF_RESOURCES (-5)" and the like, for messages.
[[nodiscard]] std::string clErrorName(cl_int code);

}  // namespace tessera
