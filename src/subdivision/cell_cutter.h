// Cuts a domain, or a part of one, into bicubic cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "subdivision/cells.h"
#include "subdivision/limit_fit.h"

namespace tessera::subdivision {

// The cell of a level in a domain's corner.
[[nodiscard]] CellBox cornerBox(std::uint32_t corner, std::uint32_t level);

struct CutRules {
    double exact = 0;                       // scene units: what is so near the limit surface is it
    std::uint32_t deepest = 0;              // most halvings of the domain in a direction
    std::array<std::uint32_t, 4> depths{};  // of irregular corners: the level of the cells there; 0: the corner is none
    std::array<bool, 4> leftOut{};          // whether those cells are left out
};

class CellCutter {
public:
    // Adds to `cells`. All references must stay; `limit` is set to the domain.
    CellCutter(const LimitSurface& limit, std::uint32_t domain, const CutRules& rules, std::vector<Cell>& cells)
        : limit_(limit), domain_(domain), rules_(rules), cells_(cells) {}

    // Where halving the box in one direction leaves a half that is bicubic that is all; else it is quartered.
    void add(const CellBox& box);

private:
    [[nodiscard]] std::uint32_t irregularCorner(const CellBox& box) const;
    [[nodiscard]] bool isExact(const CellBox& box) const;
    void addQuarters(const CellBox& box);
    void emit(const CellBox& box, const BicubicNet& net);

    const LimitSurface& limit_;
    std::uint32_t domain_;
    const CutRules& rules_;
    std::vector<Cell>& cells_;
};

}  // namespace tessera::subdivision
