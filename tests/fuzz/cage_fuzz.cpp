// libFuzzer on the readers of cages that are Tessera's own: OBJ with tags, and glTF's extension before Assimp sees the file. Any bytes give
// cages whose lists fit each other, or a one-line Error. The first byte chooses: even an OBJ, odd the extension.
#include "formats/gltf_subdivision.h"
#include "formats/mesh_file.h"
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

void requireWhole(const tessera::Cage& cage) {
    std::size_t corners = 0;
    for (const std::uint32_t size : cage.faceSizes) corners += size;
    require(corners == cage.faceVertices.size());
    require(cage.faceTexturePoints.empty() || cage.faceTexturePoints.size() == corners);
    for (const std::uint32_t vertex : cage.faceVertices) require(vertex < cage.points.size());
    for (const std::uint32_t point : cage.faceTexturePoints) require(point < cage.texturePoints.size());
    for (const tessera::Crease& crease : cage.creases) require(crease.a < cage.points.size() && crease.b < cage.points.size());
    for (const tessera::Corner& corner : cage.corners) require(corner.vertex < cage.points.size());
    for (const std::uint32_t hole : cage.holes) require(hole < cage.faceCount());
}

void readObj(std::span<const std::uint8_t> bytes, std::vector<std::string>& warnings) {
    const tessera::Scene scene =
        tessera::parseCageFile(std::as_bytes(bytes), "fuzz.obj", tessera::SubdivisionScheme::catmullClark, &warnings);
    require(!scene.cages.empty() && scene.cages.size() == scene.objects.size());
    for (const tessera::Cage& cage : scene.cages) requireWhole(cage);
}

void readExtension(std::span<const std::uint8_t> bytes, std::vector<std::string>& warnings) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const tessera::MeshNotes notes("fuzz.obj", &warnings);
    const tessera::GltfSubdivision read(text, notes);
    if (read.empty()) return;
    // What is handed to Assimp has the same cages.
    require(!tessera::GltfSubdivision(read.numbered(), notes).empty());
    static_cast<void>(read.find("TESSERA_mesh_0"));
    static_cast<void>(read.find(text.substr(0, 40)));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::span<const std::uint8_t> bytes(data + 1, size - 1);
    std::vector<std::string> warnings;
    try {
        (data[0] % 2 == 0 ? readObj : readExtension)(bytes, warnings);
    } catch (const tessera::Error& error) {
        require(std::string_view(error.what()).find('\n') == std::string_view::npos);
        require(std::string_view(error.what()).starts_with("fuzz.obj: "));
    }
    for (const std::string& warning : warnings) require(warning.find('\n') == std::string::npos);
    return 0;
}
