// What the borders of diced ranges leave open: their segments, and how often each was walked which way.
#pragma once

#include "quad_rig.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tessera::splitting {

// Bits of a vertex' eye-space coordinates, as in BorderVertex.
using Position = std::array<std::uint32_t, 3>;

// A segment between vertices that differ, and how often it was walked: forward less backward, and in all.
struct Segment {
    std::array<Position, 2> ends{};  // the lower first
    int direction = 0;
    int times = 0;
};

// Each segment once, in the order of their ends.
[[nodiscard]] std::vector<Segment> segmentsOf(const std::vector<Border>& borders);

// Segments walked an odd number of times: what they bound has a hole there.
[[nodiscard]] std::size_t openSegments(const std::vector<Border>& borders);

// Segments not walked as often forward as backward.
[[nodiscard]] std::size_t unorientedSegments(const std::vector<Border>& borders);

}  // namespace tessera::splitting
