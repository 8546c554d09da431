// A writer for each format (formats/mesh_writer.h).
#pragma once

#include <filesystem>
#include <memory>

#include "formats/mesh_writer.h"

namespace tessera {

[[nodiscard]] std::unique_ptr<MeshWriter> makePlyWriter(const std::filesystem::path& path, const MeshFileOptions& options);
[[nodiscard]] std::unique_ptr<MeshWriter> makeObjWriter(const std::filesystem::path& path, const MeshFileOptions& options);
[[nodiscard]] std::unique_ptr<MeshWriter> makeStlWriter(const std::filesystem::path& path);
[[nodiscard]] std::unique_ptr<MeshWriter> makeGlbWriter(const std::filesystem::path& path, const MeshFileOptions& options);

}  // namespace tessera
