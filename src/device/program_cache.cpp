#include "device/program_cache.h"

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <sstream>

#include "tessera/error.h"

namespace tessera {
namespace {

namespace fs = std::filesystem;

// FNV-1a (Fowler, Noll and Vo, 1991), 64 bits.
std::uint64_t hash(const std::string& text, std::uint64_t seed) {
    std::uint64_t value = 0xcbf29ce484222325U ^ seed;
    for (const char c : text) value = (value ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    return value;
}

fs::path cacheFile(const OpenDevice& device, const BuildRequest& request) {
    const std::string key = device.info.platform + '\n' + device.info.name + '\n' + device.info.deviceVersion + '\n' +
                            device.info.driverVersion + '\n' + request.options + '\n' + request.source;
    std::ostringstream name;
    name << std::hex << hash(key, 0) << hash(key, 0x9e3779b97f4a7c15U) << ".clbin";
    return request.cacheFolder / name.str();
}

using Binary = std::vector<unsigned char>;

std::optional<cl::Program> load(const OpenDevice& device, const BuildRequest& request) {
    std::ifstream file(cacheFile(device, request), std::ios::binary);
    if (!file) return std::nullopt;
    const Binary binary{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (binary.empty()) return std::nullopt;
    try {
        cl::Program program(device.context, {device.device}, {binary});
        program.build(device.device, request.options.c_str());
        return program;
    } catch (const cl::Error&) {
        return std::nullopt;  // damaged, or of another driver: built anew
    }
}

void store(const OpenDevice& device, const BuildRequest& request, const cl::Program& program) {
    std::error_code failed;
    fs::create_directories(request.cacheFolder, failed);
    const fs::path path = cacheFile(device, request);
    const fs::path temporary = path.string() + "." + std::to_string(std::random_device{}());
    try {
        const std::vector<Binary> binaries = program.getInfo<CL_PROGRAM_BINARIES>();
        if (binaries.empty() || binaries.front().empty()) return;
        std::ofstream file(temporary, std::ios::binary);
        file.write(reinterpret_cast<const char*>(binaries.front().data()), static_cast<std::streamsize>(binaries.front().size()));
        file.close();
        if (file) fs::rename(temporary, path, failed);
    } catch (const cl::Error&) {
        failed = std::make_error_code(std::errc::io_error);  // a driver that gives no binaries
    }
    fs::remove(temporary, failed);
}

std::string firstError(const std::string& log) {
    std::istringstream lines(log);
    std::string line;
    std::string first;
    while (std::getline(lines, line)) {
        if (first.empty() && !line.empty()) first = line;
        if (line.find("error") != std::string::npos) return line;
    }
    return first;
}

}  // namespace

fs::path defaultCacheFolder() {
    // A variable that is set but empty counts as unset (XDG Base Directory Specification).
    const auto variable = [](const char* name) {
        const char* const value = std::getenv(name);
        return std::string(value == nullptr ? "" : value);
    };
    if (const std::string own = variable("TESSERA_CACHE"); !own.empty()) return own;
    if (const std::string cache = variable("XDG_CACHE_HOME"); !cache.empty()) return fs::path(cache) / "tessera";
    if (const std::string home = variable("HOME"); !home.empty()) return fs::path(home) / ".cache" / "tessera";
    return {};
}

std::filesystem::path cacheFolder(bool cacheKernels, const std::string& folder) {
    if (!cacheKernels) return {};
    return folder.empty() ? defaultCacheFolder() : std::filesystem::path(folder);
}

bool keepsOwnCache(const DeviceInfo& info) { return info.platform == "Portable Computing Language"; }

cl::Program buildProgram(const OpenDevice& device, const BuildRequest& request) {
    const bool cached = !request.cacheFolder.empty();
    if (cached) {
        if (std::optional<cl::Program> program = load(device, request)) return *program;
    }
    cl::Program program;
    try {
        program = cl::Program(device.context, request.source);
        program.build(device.device, request.options.c_str());
    } catch (const cl::Error& error) {
        const std::string log = program() != nullptr ? program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device.device) : error.what();
        throw Error("kernels don't build on device " + device.info.name + " (" + clErrorName(error.err()) + "): " + firstError(log));
    }
    if (cached) store(device, request, program);
    return program;
}

}  // namespace tessera
