// The formats that the mesh fuzzer's first byte stands for, modulo their number; its seeds begin with it. Not OFF: Assimp 5.2 reads beyond
// its memory on damaged files of that format, which ends every run.
#pragma once

#include <array>
#include <string_view>

namespace tessera {

inline constexpr std::array<std::string_view, 4> kFuzzedFormats{"obj", "ply", "stl", "gltf"};

}  // namespace tessera
