// One cage in every format that has cages, as text: what readers must agree on.
#pragma once

#include "mesh_file_samples.h"
#include "tessera/cage.h"

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace tessera {

// A box of side 1 on the ground whose top is one n-gon of five corners, with creases, a corner, a hole and texture coordinates: a vertex's
// own but for the last face, which has a seam.
inline Cage sampleCage() {
    Cage cage;
    cage.name = "box";
    cage.points = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}, {0.5F, 1, 1.25F}};
    cage.faceSizes = {4, 4, 4, 5, 4, 5};
    cage.faceVertices = {0, 1, 2, 3, 0, 4, 5, 1, 1, 5, 6, 2, 2, 6, 8, 7, 3, 3, 7, 4, 0, 4, 7, 8, 6, 5};
    cage.creases = {{0, 1, 2.0F}, {1, 2, 3.5F}};
    cage.corners = {{8, 10.0F}};
    cage.holes = {0};
    cage.boundary = BoundaryRule::edgeOnly;
    return cage;
}

inline std::string cageObjText() {
    return "# the box\no box\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\nv 0.5 1 1.25 # the tip\n"
           "vn 0 1 0\nusemtl red\nf 1 2 3 4\nf 1//1 5//1 6//1 2//1\ng sides\nf -8 -4 -3 -7\nf 3 7 9 \\\n8 4\nf 4 8 5 1\ns off\n"
           "f 5 8 9 7 6\n"
           "t crease 4/2/0 0 1 1 2 2 3.5\nt corner 1/1/0 8 10\nt hole 1/0/0 0\nt interpolateboundary 1/0/0 2\n";
}

inline std::string cagePlyText() {
    return "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 6\nproperty list uchar int vertex_indices\nend_header\n"
           "0 0 0\n1 0 0\n1 0 1\n0 0 1\n0 1 0\n1 1 0\n1 1 1\n0 1 1\n0.5 1 1.25\n"
           "4 0 1 2 3\n4 0 4 5 1\n4 1 5 6 2\n5 2 6 8 7 3\n4 3 7 4 0\n5 4 7 8 6 5\n";
}

// glTF of the box: a vertex a corner, so that welding has something to do; `extension` is the primitive's; polygons are
// triangle fans. Numbers are in the text, or in `binary`, where given, for a .glb file.
inline std::string cageGltfText(const std::string& extension, const std::string& more = "", std::string* binary = nullptr) {
    const Cage cage = sampleCage();
    std::vector<float> numbers;
    for (int copy = 0; copy < 2; ++copy) {
        for (const glm::vec3& p : cage.points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
    }
    std::vector<std::uint32_t> indices;
    std::size_t first = 0;
    for (std::size_t face = 0; face < cage.faceCount(); ++face) {
        const std::uint32_t copy = face % 2 == 0 ? 0 : 9;
        for (std::size_t k = 2; k < cage.faceSizes[face]; ++k) {
            for (const std::size_t corner : {std::size_t{0}, k - 1, k}) indices.push_back(copy + cage.faceVertices[first + corner]);
        }
        first += cage.faceSizes[face];
    }
    std::vector<std::byte> bytes(numbers.size() * 4 + indices.size() * 4);
    std::memcpy(bytes.data(), numbers.data(), numbers.size() * 4);
    std::memcpy(bytes.data() + numbers.size() * 4, indices.data(), indices.size() * 4);
    const std::string uri = binary == nullptr ? R"(,"uri":"data:application/octet-stream;base64,)" + base64(bytes) + "\"" : "";
    if (binary != nullptr) binary->assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string vertexBytes = std::to_string(numbers.size() * 4), indexBytes = std::to_string(indices.size() * 4);
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[1,0]}],"nodes":[{"mesh":1,"name":"placed"},{"mesh":0}],)"
           R"("meshes":[{"name":"plain","primitives":[{"attributes":{"POSITION":0},"indices":1}]},)"
           R"({"name":"box","primitives":[{"attributes":{"POSITION":0},"indices":1,"extensions":{)" +
           extension + "}}]}]," + more + R"("accessors":[{"bufferView":0,"componentType":5126,"count":18,"type":"VEC3",)" +
           R"("min":[0,0,0],"max":[1,1,1.25]},{"bufferView":1,"componentType":5125,"count":)" + std::to_string(indices.size()) +
           R"(,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":)" + vertexBytes + R"(},{"buffer":0,"byteOffset":)" + vertexBytes +
           R"(,"byteLength":)" + indexBytes + R"(}],"buffers":[{"byteLength":)" + std::to_string(bytes.size()) + uri + "}]}";
}

// The extension as it says all of the box; its vertices are those of the second copy, but for some.
inline std::string cageExtension(const std::string& more = "") {
    return R"("TESSERA_subdivision_surface":{"scheme":"catmull-clark","boundary":"edge-only",)"
           R"("creases":[[9,10,2],[1,11,3.5]],"corners":[[17,10.0]],"holes":[0],)"
           R"("faceSizes":[4,4,4,5,4,5],"faceVertices":[0,1,2,3,9,13,14,10,1,5,6,2,11,15,17,16,12,3,7,4,0,13,16,17,15,14])" +
           more + "}";
}

// The same as a .glb file.
inline std::string cageGlb(const std::string& extension) {
    std::string binary, json = cageGltfText(extension, "", &binary);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const auto word = [](std::size_t value) {
        std::string text;
        for (unsigned k = 0; k < 4; ++k) text += static_cast<char>(value >> (8 * k) & 255U);
        return text;
    };
    return "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" + json + word(binary.size()) +
           std::string("BIN\0", 4) + binary;
}

}  // namespace tessera
