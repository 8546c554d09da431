// libFuzzer on the reader of mesh files: any bytes give a valid scene or a one-line Error. The first byte chooses the format and whether
// triangles are curved. Assimp itself is not instrumented: what it lets through is looked for, rather than faults of its own.
#include "formats/mesh_file.h"
#include "mesh_formats.h"
#include "tessera/error.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace {

void require(bool condition) {
    if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::span<const std::uint8_t> bytes(data + 1, size - 1);
    const std::string fileName = "fuzz." + std::string(tessera::kFuzzedFormats[data[0] % tessera::kFuzzedFormats.size()]);
    const bool flat = data[0] >= 128;
    std::vector<std::string> warnings;
    try {
        const tessera::Scene scene = tessera::parseMeshFile(std::as_bytes(bytes), fileName, flat, &warnings);
        scene.validate();
        require(scene.placedPatchCount() > 0);
        static_cast<void>(tessera::framingCamera(scene, 45.0F));
    } catch (const tessera::Error& error) {
        require(std::string_view(error.what()).find('\n') == std::string_view::npos);
        require(std::string_view(error.what()).starts_with(fileName + ": "));
    }
    for (const std::string& warning : warnings) require(warning.find('\n') == std::string::npos);
    return 0;
}
