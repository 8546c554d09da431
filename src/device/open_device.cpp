#include "device/open_device.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <utility>

#include "tessera/error.h"

namespace tessera {
namespace {

std::string trimmed(std::string text) {
    while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();
    const auto start = text.find_first_not_of(' ');
    return start == std::string::npos ? std::string() : text.substr(start);
}

std::string typeName(cl_device_type type) {
    if ((type & CL_DEVICE_TYPE_GPU) != 0) return "GPU";
    if ((type & CL_DEVICE_TYPE_CPU) != 0) return "CPU";
    return (type & CL_DEVICE_TYPE_ACCELERATOR) != 0 ? "accelerator" : "other";
}

bool hasExtension(const cl::Device& device, const std::string& extension) {
    std::istringstream extensions(device.getInfo<CL_DEVICE_EXTENSIONS>());
    return std::find(std::istream_iterator<std::string>(extensions), {}, extension) != std::istream_iterator<std::string>();
}

// "OpenCL 1.2 ..." or later.
bool hasVersion12(const std::string& version) {
    const std::string number = version.size() > 7 ? version.substr(7) : "";
    const int major = std::atoi(number.c_str());
    return major > 1 || (major == 1 && number.substr(0, 3) >= "1.2");
}

DeviceInfo describe(const cl::Device& device, const std::string& platform, int index) {
    DeviceInfo info;
    info.index = index;
    info.platform = platform;
    info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
    info.vendor = trimmed(device.getInfo<CL_DEVICE_VENDOR>());
    info.deviceVersion = trimmed(device.getInfo<CL_DEVICE_VERSION>());
    info.driverVersion = trimmed(device.getInfo<CL_DRIVER_VERSION>());
    info.type = typeName(device.getInfo<CL_DEVICE_TYPE>());
    info.computeUnits = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    info.globalBytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    info.maxAllocationBytes = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    info.localBytes = device.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>();
    info.usable = hasVersion12(info.deviceVersion) && device.getInfo<CL_DEVICE_AVAILABLE>() != 0 &&
                  device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>() != 0 && device.getInfo<CL_DEVICE_ENDIAN_LITTLE>() != 0;
    info.atomics64 = hasExtension(device, "cl_khr_int64_extended_atomics");
    info.correctlyRoundedDivideSqrt = (device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
    cl_bool unified = CL_FALSE;
    device.getInfo(CL_DEVICE_HOST_UNIFIED_MEMORY, &unified);
    info.unifiedMemory = unified != CL_FALSE;
    return info;
}

using FoundDevice = std::pair<cl::Device, DeviceInfo>;

std::vector<FoundDevice> findDevices() {
    std::vector<FoundDevice> found;
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error&) {
        return found;  // the loader reports an error when no driver is installed
    }
    for (const cl::Platform& platform : platforms) {
        std::vector<cl::Device> devices;
        try {
            platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
            const std::string platformName = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
            for (const cl::Device& device : devices) {
                found.emplace_back(device, describe(device, platformName, static_cast<int>(found.size())));
            }
        } catch (const cl::Error&) {
            continue;  // a platform without devices
        }
    }
    const auto usableGpu = [](const FoundDevice& entry) { return entry.second.usable && entry.second.type == "GPU"; };
    const auto usable = [](const FoundDevice& entry) { return entry.second.usable; };
    auto chosen = std::find_if(found.begin(), found.end(), usableGpu);
    if (chosen == found.end()) chosen = std::find_if(found.begin(), found.end(), usable);
    if (chosen != found.end()) chosen->second.isDefault = true;
    return found;
}

FoundDevice chooseDevice(int index) {
    std::vector<FoundDevice> found = findDevices();
    if (found.empty()) throw Error("no OpenCL device found; install a driver, for a CPU the package pocl-opencl-icd");
    if (index < 0) {
        const auto chosen = std::find_if(found.begin(), found.end(), [](const FoundDevice& entry) { return entry.second.isDefault; });
        if (chosen == found.end()) throw Error("no OpenCL device here can be used: OpenCL 1.2 with a compiler is needed");
        return *chosen;
    }
    if (index >= static_cast<int>(found.size())) {
        throw Error("device " + std::to_string(index) + " does not exist; there are devices 0 to " + std::to_string(found.size() - 1) +
                    " (see 'tessera devices')");
    }
    FoundDevice chosen = found[static_cast<std::size_t>(index)];
    if (!chosen.second.usable) {
        throw Error("device " + std::to_string(index) + " (" + chosen.second.name +
                    ") can't be used: OpenCL 1.2 with a compiler is needed");
    }
    return chosen;
}

// A CPU's work-item does a group's work in vectors; elsewhere 64 work-items share it. The groups of a launch are a few for each
// compute unit, so that those done early take more.
DeviceShape shapeOf(const DeviceInfo& info, int lanes) {
    const int chosen = lanes != 0 ? lanes : (info.type == "CPU" ? 16 : 1);
    if (chosen == 16 || chosen == 8) return {1, chosen, info.computeUnits * 16};
    if (chosen == 1) return {64, 1, info.computeUnits * 32};
    throw Error("lanes is " + std::to_string(lanes) + ", but must be 1, 8 or 16, or 0 for the device's own");
}

}  // namespace

std::vector<DeviceInfo> listDevices() {
    std::vector<DeviceInfo> infos;
    for (const FoundDevice& entry : findDevices()) infos.push_back(entry.second);
    return infos;
}

DeviceInfo findDevice(int index) { return chooseDevice(index).second; }

OpenDevice openDevice(int index, int lanes) {
    const auto [device, info] = chooseDevice(index);
    try {
        OpenDevice open;
        open.info = info;
        open.device = device;
        open.context = cl::Context(device);
        open.queue = cl::CommandQueue(open.context, device, CL_QUEUE_PROFILING_ENABLE);
        open.transfers = cl::CommandQueue(open.context, device, CL_QUEUE_PROFILING_ENABLE);
        open.shape = shapeOf(info, lanes);
        return open;
    } catch (const cl::Error& error) {
        throw Error("device " + std::to_string(info.index) + " (" + info.name + ") can't be opened: " + error.what() + " gave " +
                    clErrorName(error.err()));
    }
}

std::string clErrorName(cl_int code) {
    static constexpr std::pair<cl_int, const char*> names[] = {
        {CL_DEVICE_NOT_AVAILABLE, "CL_DEVICE_NOT_AVAILABLE"},
        {CL_MEM_OBJECT_ALLOCATION_FAILURE, "CL_MEM_OBJECT_ALLOCATION_FAILURE"},
        {CL_OUT_OF_RESOURCES, "CL_OUT_OF_RESOURCES"},
        {CL_OUT_OF_HOST_MEMORY, "CL_OUT_OF_HOST_MEMORY"},
        {CL_BUILD_PROGRAM_FAILURE, "CL_BUILD_PROGRAM_FAILURE"},
        {CL_INVALID_VALUE, "CL_INVALID_VALUE"},
        {CL_INVALID_BINARY, "CL_INVALID_BINARY"},
        {CL_INVALID_KERNEL_NAME, "CL_INVALID_KERNEL_NAME"},
        {CL_INVALID_KERNEL_ARGS, "CL_INVALID_KERNEL_ARGS"},
        {CL_INVALID_WORK_GROUP_SIZE, "CL_INVALID_WORK_GROUP_SIZE"},
        {CL_INVALID_BUFFER_SIZE, "CL_INVALID_BUFFER_SIZE"},
    };
    const auto* const known = std::find_if(std::begin(names), std::end(names), [code](const auto& entry) { return entry.first == code; });
    return (known != std::end(names) ? std::string(known->second) + " " : std::string("error ")) + "(" + std::to_string(code) + ")";
}

}  // namespace tessera
