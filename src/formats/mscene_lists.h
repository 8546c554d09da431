// How long lists in .mscene files may be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace tessera {

// `size` as Cap'n Proto counts. Throws Error, which begins with `what`, where it is too large: a list's length has 29 bits.
[[nodiscard]] std::uint32_t msceneListSize(std::size_t size, const std::string& what);

}  // namespace tessera
