// Where cells' borders and corners lie, told by numbers and not by positions.
#include "subdivision/cell_lines.h"

#include <algorithm>

namespace tessera::subdivision {

namespace {

constexpr std::uint32_t kHalf = kLineLength / 2;

std::uint32_t lengthOf(std::uint32_t level) { return kLineLength >> level; }

// The point of a domain's side, `along` of kLineLength, on the side's line.
std::uint32_t onLine(const DomainSide& side, std::uint32_t along) {
    const std::uint32_t length = side.half ? kHalf : kLineLength;
    const std::uint32_t t = side.half ? along / 2 : along;
    return (side.half ? side.part * kHalf : 0U) + (side.reversed ? length - t : t);
}

// The middle of an edge is a point of the domains.
PlaceKey onOuterLine(const QuadDomains& domains, std::uint32_t line, std::uint32_t at) {
    if (line < domains.edges && at == kHalf) return {0, domains.vertices + line, 0, 0};
    return {1, line, at, 0};
}

template <typename Point>
std::array<std::array<Point, 4>, 2> halves(std::array<Point, 4> row) {
    std::array<std::array<Point, 4>, 2> result{};
    for (std::size_t done = 0; done < 4; ++done) {
        result[0][done] = row[0];
        result[1][3 - done] = row[3 - done];
        for (std::size_t k = 0; k + done < 3; ++k) row[k] = 0.5 * (row[k] + row[k + 1]);
    }
    return result;
}

template <typename Net>
void cutNet(const Net& net, bool cutU, Net& first, Net& second) {
    const std::size_t step = cutU ? 1 : 4, next = cutU ? 4 : 1;
    for (std::size_t row = 0; row < 4; ++row) {
        const std::size_t begin = row * next;
        const auto parts = halves(std::array{net[begin], net[begin + step], net[begin + 2 * step], net[begin + 3 * step]});
        for (std::size_t k = 0; k < 4; ++k) {
            first[begin + k * step] = parts[0][k];
            second[begin + k * step] = parts[1][k];
        }
    }
}

}  // namespace

CellBorder borderOf(const QuadDomains& domains, const Cell& cell, std::uint32_t side) {
    const bool alongU = side == 0 || side == 2;
    const std::uint32_t length = lengthOf(alongU ? cell.levelU : cell.levelV), width = lengthOf(alongU ? cell.levelV : cell.levelU);
    const std::uint32_t begin = (alongU ? cell.u : cell.v) * length;
    const std::uint32_t across = ((alongU ? cell.v : cell.u) + (side == 1 || side == 2 ? 1 : 0)) * width;
    CellBorder border;
    if (across != 0 && across != kLineLength) {
        border.line = {cell.domain, alongU ? 1U : 2U, across};
        border.begin = begin;
        border.end = begin + length;
        return border;
    }
    const DomainSide& outer = domains.domains[cell.domain].sides[side];
    border.line = {outer.line, 0, 0};
    border.reversed = outer.reversed;
    const std::uint32_t a = onLine(outer, begin), b = onLine(outer, begin + length);
    border.begin = std::min(a, b);
    border.end = std::max(a, b);
    return border;
}

PlaceKey placeOf(const QuadDomains& domains, const Cell& cell, std::uint32_t corner) {
    const std::uint32_t u = (cell.u + (corner == 1 || corner == 2 ? 1 : 0)) * lengthOf(cell.levelU);
    const std::uint32_t v = (cell.v + (corner >= 2 ? 1 : 0)) * lengthOf(cell.levelV);
    const QuadDomain& domain = domains.domains[cell.domain];
    const bool outerU = u == 0 || u == kLineLength, outerV = v == 0 || v == kLineLength;
    if (outerU && outerV) return {0, domain.corners[(v == 0 ? 0U : 2U) + (u == 0 ? (v == 0 ? 0U : 1U) : (v == 0 ? 1U : 0U))], 0, 0};
    if (outerV) return onOuterLine(domains, domain.sides[v == 0 ? 0 : 2].line, onLine(domain.sides[v == 0 ? 0 : 2], u));
    if (outerU) return onOuterLine(domains, domain.sides[u == 0 ? 3 : 1].line, onLine(domain.sides[u == 0 ? 3 : 1], v));
    return {2, cell.domain, u, v};
}

PlaceKey placeOn(const QuadDomains& domains, const LineKey& line, std::uint32_t at) {
    if (line.inside == 0) return onOuterLine(domains, line.number, at);
    return {2, line.number, line.inside == 1 ? at : line.across, line.inside == 1 ? line.across : at};
}

std::array<Cell, 2> cutCell(const Cell& cell, bool cutU) {
    std::array<Cell, 2> parts{cell, cell};
    for (std::uint32_t k = 0; k < 2; ++k) {
        (cutU ? parts[k].levelU : parts[k].levelV) += 1;
        (cutU ? parts[k].u : parts[k].v) = 2 * (cutU ? cell.u : cell.v) + k;
    }
    std::array<glm::dvec3, 16> net{}, first{}, second{};
    std::copy_n(cell.points.begin(), 16, net.begin());
    cutNet(net, cutU, first, second);
    std::copy(first.begin(), first.end(), parts[0].points.begin());
    std::copy(second.begin(), second.end(), parts[1].points.begin());
    cutNet(cell.texture, cutU, parts[0].texture, parts[1].texture);
    return parts;
}

}  // namespace tessera::subdivision
