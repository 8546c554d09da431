// Reads polygon meshes, with Assimp: OBJ, PLY, STL, glTF and what else it knows; as triangles or as cages of subdivision surfaces.
#pragma once

#include "tessera/scene.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tessera {

// Whether Assimp reads files whose names end as that of `path` does. The file need not exist.
[[nodiscard]] bool isMeshFile(const std::filesystem::path& path);

// Reads, repairs (tessera/triangles.h) and validates the scene in `path`: its meshes as PN triangles, or as plain ones with `flat`, its
// nodes as objects, its lights and cameras. Throws Error, which begins with the path, on: a file that cannot be read or is above 2 GiB,
// what Assimp refuses, faces with corners that do not exist, files without a triangle that can be drawn. No files are read but those in
// the file's folder and below. What was repaired or left out is told in `warnings`, a line each.
[[nodiscard]] Scene readMeshFile(const std::filesystem::path& path, bool flat, std::vector<std::string>* warnings = nullptr);

// The same with cages (Scene::cages) instead of triangles: of everything, with `scheme` for theirs; without it of what the file itself says
// is a subdivision surface, OBJ files by OpenSubdiv's tags and glTF's primitives by an extension (docs/formats.md), while all else becomes
// PN triangles. Polygons stay as they are. Throws Error as readMeshFile() does, of OBJ files with the line; and on tags and extensions that
// make no sense. An OBJ file's objects: formats/obj_cage.h; other files': as readMeshFile(), points equal to the bit being one.
[[nodiscard]] Scene readCageFile(const std::filesystem::path& path, std::optional<SubdivisionScheme> scheme,
                                 std::vector<std::string>* warnings = nullptr);

// The same two from memory, all of whose other files are missing; `fileName` stands in messages, and its ending tells the format. For tests
// and fuzzers.
[[nodiscard]] Scene parseCageFile(std::span<const std::byte> bytes, const std::string& fileName, std::optional<SubdivisionScheme> scheme,
                                  std::vector<std::string>* warnings = nullptr);
[[nodiscard]] Scene parseMeshFile(std::span<const std::byte> bytes, const std::string& fileName, bool flat,
                                  std::vector<std::string>* warnings = nullptr);

}  // namespace tessera
