// libFuzzer on pnMesh(): any triangles give valid patches whose shared borders agree in every bit, or a one-line Error.
#include "../triangle_samples.h"
#include "tessera/error.h"
#include "tessera/triangles.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <span>
#include <string_view>
#include <utility>

namespace {

void require(bool condition) {
    if (!condition) std::abort();
}

// The bytes in turn, zeros after their end.
class Bytes {
public:
    explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    [[nodiscard]] bool empty() const { return bytes_.empty(); }
    std::uint8_t byte() {
        if (bytes_.empty()) return 0;
        const std::uint8_t first = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return first;
    }
    // Small numbers, so that positions meet; now and then any bits.
    float number() {
        const std::uint8_t first = byte();
        if (first != 255) return static_cast<float>(first % 8) - 3.0F;
        std::uint32_t bits = 0;
        for (int i = 0; i < 4; ++i) bits = bits << 8U | byte();
        return std::bit_cast<float>(bits);
    }
    glm::vec3 vector() {
        const float x = number(), y = number();
        return {x, y, number()};
    }
    std::uint32_t index(std::size_t count) {
        const std::uint8_t first = byte();
        return first == 255 ? byte() * 0x01010101U : static_cast<std::uint32_t>(first % count);
    }

private:
    std::span<const std::uint8_t> bytes_;
};

tessera::TriangleMesh meshOf(Bytes bytes) {
    tessera::TriangleMesh mesh;
    mesh.name = "fuzz";
    const std::size_t count = 1U + bytes.byte() % 32U;
    const bool hasNormals = bytes.byte() % 2 == 0;
    for (std::size_t i = 0; i < count; ++i) mesh.positions.push_back(bytes.vector());
    while (!bytes.empty()) {
        const std::uint32_t a = bytes.index(count), b = bytes.index(count);
        mesh.triangles.push_back({a, b, bytes.index(count)});
        if (hasNormals) {
            const glm::vec3 first = bytes.vector(), second = bytes.vector();
            mesh.normals.push_back({first, second, bytes.vector()});
        }
    }
    return mesh;
}

// Between two places there is one curve: triangles that share an edge share it to the bit.
void requireOneCurveAnEdge(const tessera::Mesh& mesh) {
    std::map<std::pair<tessera::Bits, tessera::Bits>, int> edges;
    for (const auto& [curve, count] : tessera::countCurves(mesh)) require(++edges[std::minmax(curve[0], curve[3])] == 1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const tessera::TriangleMesh triangles = meshOf(Bytes({data, size}));
    for (const bool flat : {false, true}) {
        try {
            tessera::TriangleRepairs repairs;
            tessera::Scene scene;
            scene.meshes.push_back(tessera::pnMesh(triangles, flat, &repairs));
            scene.validate();
            require(scene.meshes[0].patchCount() + repairs.droppedBadIndex + repairs.droppedNotFinite + repairs.droppedDegenerate +
                        repairs.droppedDuplicates ==
                    triangles.triangles.size());
            requireOneCurveAnEdge(scene.meshes[0]);
        } catch (const tessera::Error& error) {
            require(std::string_view(error.what()).find('\n') == std::string_view::npos);
            require(std::string_view(error.what()).starts_with("mesh 'fuzz': "));
        }
    }
    return 0;
}
