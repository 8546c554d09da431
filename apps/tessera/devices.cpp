// `tessera devices`: the OpenCL devices of this machine and what each can do.
#include "commands.h"
#include "console.h"
#include "tessera/device.h"
#include "tessera/error.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

namespace tessera::program {

namespace {

std::string devicesJson(const std::vector<DeviceInfo>& devices) {
    nlohmann::ordered_json json;
    json["devices"] = nlohmann::ordered_json::array();
    for (const DeviceInfo& device : devices) {
        json["devices"].push_back({{"index", device.index},
                                   {"default", device.isDefault},
                                   {"usable", device.usable},
                                   {"name", device.name},
                                   {"platform", device.platform},
                                   {"vendor", device.vendor},
                                   {"type", device.type},
                                   {"device_version", device.deviceVersion},
                                   {"driver_version", device.driverVersion},
                                   {"compute_units", device.computeUnits},
                                   {"global_bytes", device.globalBytes},
                                   {"max_allocation_bytes", device.maxAllocationBytes},
                                   {"local_bytes", device.localBytes},
                                   {"atomics64", device.atomics64},
                                   {"correctly_rounded_divide_sqrt", device.correctlyRoundedDivideSqrt},
                                   {"unified_memory", device.unifiedMemory}});
    }
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string supportText(const DeviceInfo& device) {
    if (!device.usable) return "not usable: needs OpenCL 1.2 with a compiler, little-endian";
    std::string text = device.atomics64 ? "64-bit atomics" : "32-bit atomics alone";
    text += device.correctlyRoundedDivideSqrt ? ", exact divide and sqrt" : ", approximate divide and sqrt";
    return text + (device.unifiedMemory ? ", memory shared with the host" : ", memory of its own");
}

std::string deviceText(const DeviceInfo& device) {
    std::string text = std::to_string(device.index) + (device.isDefault ? " * " : "   ") + oneLine(device.name) + "\n";
    const auto row = [&text](std::string_view label, const std::string& value) {
        text += "      " + std::string(label) + std::string(10 - label.size(), ' ') + oneLine(value) + "\n";
    };
    row("platform", device.platform);
    row("vendor", device.vendor);
    row("type", device.type + ", " + counted(device.computeUnits, "compute unit", "compute units"));
    row("version", device.deviceVersion);
    row("driver", device.driverVersion);
    row("memory", byteText(device.globalBytes) + ", at most " + byteText(device.maxAllocationBytes) + " a buffer, " +
                      byteText(device.localBytes) + " local");
    row("supports", supportText(device));
    return text;
}

void showDevices(bool asJson) {
    const std::vector<DeviceInfo> devices = listDevices();
    if (asJson) {
        printResult(devicesJson(devices));
        return;
    }
    if (devices.empty()) {
        throw Error(
            "no OpenCL devices found: install a driver, for the CPU 'apt-get install pocl-opencl-icd', for a GPU its vendor's OpenCL "
            "package");
    }
    std::string text;
    for (const DeviceInfo& device : devices) text += deviceText(device);
    printResult(text + "* is taken when --device names none\n");
}

}  // namespace

Command addDevicesCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("devices", "List the OpenCL devices and what each supports");
    const auto asJson = std::make_shared<bool>(false);
    command->add_flag("--json", *asJson, "Print JSON instead of text");
    return {command, [asJson] { showDevices(*asJson); }};
}

}  // namespace tessera::program
