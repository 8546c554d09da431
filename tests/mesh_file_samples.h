// Small mesh files, as text, for the tests of the mesh reader and the seeds of its fuzzer.
#pragma once

#include "formats/mesh_file.h"
#include "tessera/error.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

inline std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text.data(), text.size())); }

// Two squares, one a quadrilateral, of two materials; no normals.
inline std::string objText() {
    return "mtllib colors.mtl\n"
           "o plate\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl red\nf 1 2 3 4\n"
           "o wing\nv 0 0 1\nv 1 0 1\nv 1 1 1\nusemtl green\nf 5 6 7\n";
}

inline std::string mtlText() { return "newmtl red\nKd 0.8 0.1 0.05\nnewmtl green\nKd 0 0.5 0.25\n"; }

// A tetrahedron whose corners are shared.
inline std::string plyText() {
    return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
           "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}

// A triangle with its normal.
inline std::string stlText() {
    return "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid one\n";
}

inline std::string offText() { return "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"; }

inline std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8U | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[group >> (18U - 6U * k) & 63U];
    }
    return text;
}

// glTF with one mesh, "leaf": a triangle in the plane z = 0, counter-clockwise from +z, with normals (0.6, 0, 0.8), coloured
// (0.25, 0.5, 0.75). `nodes` is the list of nodes, all of which are in the scene; `more` are further members of the file.
inline std::string gltfText(const std::string& nodes, const std::string& roots = "0", const std::string& more = "") {
    std::vector<float> numbers{0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F};
    for (int k = 0; k < 3; ++k) numbers.insert(numbers.end(), {0.6F, 0.0F, 0.8F});
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" + roots + R"(]}],"nodes":[)" + nodes + "]," + more +
           R"("meshes":[{"name":"leaf","primitives":[{"attributes":{"POSITION":0,"NORMAL":1},"material":0}]}],)"
           R"("materials":[{"name":"m","pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,0.75,1]}}],)"
           R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
           R"({"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC3"}],)"
           R"("bufferViews":[{"buffer":0,"byteLength":72}],)"
           R"("buffers":[{"byteLength":72,"uri":"data:application/octet-stream;base64,)" +
           base64(std::as_bytes(std::span(numbers))) + R"("}]})";
}

// Files by name, whose endings tell their formats.
inline std::map<std::string, std::string> meshFileSamples() {
    return {{"file.obj", objText()},
            {"file.ply", plyText()},
            {"file.stl", stlText()},
            {"file.off", offText()},
            {"file.gltf", gltfText(R"({"name":"n","mesh":0,"scale":[2,2,2]})")}};
}

// What reading says of `text`; empty where it gives a scene.
inline std::string meshComplaint(std::string_view text, const std::string& fileName, std::vector<std::string>* warnings = nullptr) {
    try {
        static_cast<void>(parseMeshFile(bytesOf(text), fileName, false, warnings));
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

}  // namespace tessera
