// The OpenCL devices of this machine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tessera {

struct DeviceInfo {
    int index = 0;  // what --device takes: position over all platforms, in the loader's order
    std::string platform;
    std::string name;
    std::string vendor;
    std::string deviceVersion;  // "OpenCL 3.0 ..."
    std::string driverVersion;
    std::string type;  // "CPU", "GPU", "accelerator", "other"
    unsigned computeUnits = 0;
    std::uint64_t globalBytes = 0;         // device memory
    std::uint64_t maxAllocationBytes = 0;  // largest single buffer
    std::uint64_t localBytes = 0;          // local memory of a work-group
    bool usable = false;                   // OpenCL 1.2, available, a compiler, little-endian
    bool atomics64 = false;                // cl_khr_int64_extended_atomics: 64-bit atomic min
    bool correctlyRoundedDivideSqrt = false;
    bool unifiedMemory = false;  // host and device share memory: mapping a picture copies nothing
    bool isDefault = false;      // taken when none is named: the first usable GPU, else the first usable device
};

// All devices of all platforms; empty when there is no OpenCL platform. Never throws for want of devices.
[[nodiscard]] std::vector<DeviceInfo> listDevices();

// The device of that index, or the default for -1. Throws Error: no device, unknown index, unusable device.
[[nodiscard]] DeviceInfo findDevice(int index);

}  // namespace tessera
