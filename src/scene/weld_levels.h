// Borders beside finer ones: which borders are halves, quarters and so on of another's curve.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/weld_group.h"
#include "scene/weld_match.h"

namespace tessera::welding {

// A border that is the part [index, index + 1] / 2^level of another's curve.
struct FinePart {
    std::uint32_t border = 0;
    std::uint32_t level = 0;  // 1 to 8
    std::uint32_t index = 0;
    bool reversed = false;           // against the curve
    std::uint32_t from = 0, to = 0;  // clusters of the corners at the part's ends, in the curve's direction
};

struct CoarseBorder {
    std::uint32_t border = 0;
    std::vector<FinePart> parts;  // in the curve's order
    bool covered = false;         // whether they are all of it

    [[nodiscard]] std::uint32_t cuts() const;
};

// Looks among the borders that are alone and not degenerate. No border is in two of the results, nor both coarse and fine. Every patch
// with a corner strictly inside a coarse border has a part of it there.
[[nodiscard]] std::vector<CoarseBorder> findLevels(const Group& group, const Labels& labels, const Matching& matching);

}  // namespace tessera::welding
