// Mesh files read back: byte for byte by small readers of their own, and by Assimp; and what a mesh made on the host has to give.
#pragma once

#include "mesh_host.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

namespace tessera::test {

// A corner as files hold it; what a format or option leaves out is 0.
struct Corner {
    std::array<float, 3> position{};
    std::array<float, 3> normal{};
    std::array<float, 2> uv{};

    bool operator==(const Corner&) const = default;
    bool operator<(const Corner& other) const { return std::tie(position, normal, uv) < std::tie(other.position, other.normal, other.uv); }
};

struct Face {
    std::vector<Corner> corners;
    std::uint32_t object = 0;
    std::uint32_t patch = 0;

    bool operator==(const Face&) const = default;
    bool operator<(const Face& other) const {
        return std::tie(corners, object, patch) < std::tie(other.corners, other.object, other.patch);
    }
};

struct WrittenMesh {
    std::size_t vertices = 0;
    std::vector<Face> faces;
};

// Faces in the order of units. `attributes`: normals, (u, v) and patch; `object`: object as well.
[[nodiscard]] std::vector<Face> facesOf(const HostMesh& mesh, bool quads, bool attributes, bool object);

[[nodiscard]] std::string bytesOf(const std::filesystem::path& file);

// Each adds a failure to the test where the file is not as its format has it.
[[nodiscard]] WrittenMesh readPly(const std::filesystem::path& file);
[[nodiscard]] WrittenMesh readObj(const std::filesystem::path& file);  // `o` lines are numbered from 0
[[nodiscard]] WrittenMesh readStl(const std::filesystem::path& file);
[[nodiscard]] WrittenMesh readGlb(const std::filesystem::path& file);
// All meshes of the file, without objects and patches.
[[nodiscard]] WrittenMesh readWithAssimp(const std::filesystem::path& file);

// Edges, by their ends' positions, that are not in just two faces; and those that are not in just one in each direction.
[[nodiscard]] std::size_t openEdges(const std::vector<Face>& faces);
[[nodiscard]] std::size_t openOrTurnedEdges(const std::vector<Face>& faces);

}  // namespace tessera::test
