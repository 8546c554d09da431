// Reads Micropolis' scene files: packed Cap'n Proto messages (schema: mscene.capnp).
#pragma once

#include "tessera/scene.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tessera {

// Reads and validates the scene in `path`. Throws Error, which begins with the path, on: a file that cannot be read,
// a message that is truncated or no scene, lists of a wrong length, values that Scene::validate() refuses.
// Memory is bounded by a small multiple of the file's size (packed zeros are refused, not unpacked).
// Oddities that still leave a scene (an object without a colour, say) are told in `warnings`, a line each.
[[nodiscard]] Scene readMscene(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);

// The same from memory; `sceneName` stands in messages. For tests and the fuzzer.
[[nodiscard]] Scene parseMscene(std::span<const std::byte> bytes, const std::string& sceneName,
                                std::vector<std::string>* warnings = nullptr);

// Writes `scene` as a packed message: for tests, and to make scenes with Tessera's own fields. Temporary name, then renamed.
// Meshes' edge records and texture nets are left out: the former are weld()'s, to be made again whenever a scene is loaded.
void writeMscene(const Scene& scene, const std::filesystem::path& path);
[[nodiscard]] std::vector<std::byte> serializeMscene(const Scene& scene);

}  // namespace tessera
