// What Assimp may open while it reads a mesh file: files name others, and an untrusted one could name any.
#pragma once

#include <assimp/DefaultIOSystem.h>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tessera {

constexpr std::uintmax_t kLargestMeshFile = std::uintmax_t{1} << 31U;

// Outlives the import, so that it can be asked what was refused.
class MeshFolder {
public:
    // The file at `path`, and ordinary files of at most 2 GiB in its folder and below; also beside the file that a link leads to.
    explicit MeshFolder(const std::filesystem::path& path);

    // A file that is only in memory, alone in the world.
    MeshFolder(std::string fileName, std::span<const std::byte> bytes);

    // What is read as the file itself from now on, instead of what is on the disk. Streams and this folder refer to it.
    void replaceFile(std::span<const std::byte> bytes);

    // For Assimp::Importer::SetIOHandler, which takes it over. Refers to this folder.
    [[nodiscard]] std::unique_ptr<Assimp::IOSystem> makeAccess();

    [[nodiscard]] bool mayOpen(const char* file) const;
    [[nodiscard]] std::unique_ptr<Assimp::IOStream> open(const char* file);

    // Names that were asked for and lie elsewhere: the first few, each once.
    [[nodiscard]] const std::vector<std::string>& refused() const { return refused_; }

private:
    std::string fileName_;
    bool inMemory_ = false;  // and no other file is there
    bool replaced_ = false;  // the file itself is in memory
    std::span<const std::byte> bytes_;
    std::filesystem::path file_;
    std::vector<std::filesystem::path> folders_;
    std::vector<std::string> refused_;
    Assimp::DefaultIOSystem disk_;
};

}  // namespace tessera
