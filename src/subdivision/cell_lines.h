// Where cells' borders and corners lie, told by numbers and not by positions: so that what is one place is one place whatever the geometry.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "subdivision/cells.h"

namespace tessera::subdivision {

// A whole line is so long: a half's sixteenth halving is still a whole number.
constexpr std::uint32_t kLineLength = 1U << 20U;

// A line between domains, or one inside of a domain.
struct LineKey {
    std::uint32_t number = 0;  // of the line; inside: of the domain
    std::uint32_t inside = 0;  // 0: between domains; 1: along u; 2: along v
    std::uint32_t across = 0;  // inside: the other parameter, of kLineLength

    bool operator==(const LineKey&) const = default;
    bool operator<(const LineKey& other) const {
        return std::tie(number, inside, across) < std::tie(other.number, other.inside, other.across);
    }
};

// A cell's side on its line. Sides as in EdgeRecord (tessera/scene.h).
struct CellBorder {
    LineKey line;
    std::uint32_t begin = 0, end = 0;  // along the line, of kLineLength
    bool reversed = false;             // whether the side's parameter falls along the line
};

[[nodiscard]] CellBorder borderOf(const QuadDomains& domains, const Cell& cell, std::uint32_t side);

// A place on a line or inside of a domain.
struct PlaceKey {
    std::uint32_t kind = 0;  // 0: a point of QuadDomains; 1: on a line between domains, at `a`; 2: inside of a domain, at (a, b)
    std::uint32_t number = 0;
    std::uint32_t a = 0, b = 0;  // of kLineLength

    bool operator==(const PlaceKey&) const = default;
};

// Corners in the order (0, 0), (1, 0), (1, 1), (0, 1).
[[nodiscard]] PlaceKey placeOf(const QuadDomains& domains, const Cell& cell, std::uint32_t corner);

// Of a place on a cell's border's line. Ends of whole lines are points, which only a domain knows: those are not for this function.
[[nodiscard]] PlaceKey placeOn(const QuadDomains& domains, const LineKey& line, std::uint32_t at);

// The halves of a bicubic cell, cut in u or else in v.
[[nodiscard]] std::array<Cell, 2> cutCell(const Cell& cell, bool cutU);

struct PlaceHash {
    std::size_t operator()(const PlaceKey& key) const {
        std::uint64_t sum = 0;
        for (const std::uint32_t word : {key.kind, key.number, key.a, key.b}) {
            sum = (sum ^ word) * 0x9E3779B97F4A7C15U;
            sum ^= sum >> 29U;
        }
        return static_cast<std::size_t>(sum);
    }
};

}  // namespace tessera::subdivision
