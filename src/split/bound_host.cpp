#include "split/bound_host.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "device/lanes_host.h"

// The kernel headers are C: casts and index types are theirs.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wunused-function"
namespace tessera::kernels {
#define NET_SPACE
#include "split/bound.clh"
#undef NET_SPACE
}  // namespace tessera::kernels
#pragma GCC diagnostic pop

namespace tessera {
namespace {

struct Side {
    int level;
    float size;
    float start;
};

Side sideOf(std::uint32_t side) {
    const int level = static_cast<int>(side >> SIDE_LEVEL_SHIFT);
    const float size = std::ldexp(1.0F, -level);
    return {level, size, static_cast<float>(side & SIDE_INDEX_MASK) * size};
}

}  // namespace

int boundOnHost(const frame_params& frame, const float* net, int count, const range_t& range) {
    std::array<float, 60> spread{};  // bound.clh expects 20 places a coordinate
    const auto points = static_cast<std::size_t>(count);
    for (std::size_t c = 0; c < 3; ++c) std::copy_n(net + c * points, points, spread.data() + c * 20);
    const Side u = sideOf(range.u_side);
    const Side v = sideOf(range.v_side);
    return kernels::bound_ranges(&frame, spread.data(), 1, u.start, v.start, u.size, v.size, u.level, v.level, count == 20 ? -1 : 0);
}

}  // namespace tessera
