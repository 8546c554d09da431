// Cuts a domain into bicubic cells. What is bicubic is found by looking: a patch with the limit's data in its four corners is the limit
// surface on that part, or it is not.
#include "subdivision/cell_cutter.h"

#include <algorithm>

namespace tessera::subdivision {

namespace {

std::array<CellBox, 2> halvesU(const CellBox& b) {
    return {CellBox{b.levelU + 1, b.levelV, 2 * b.u, b.v}, CellBox{b.levelU + 1, b.levelV, 2 * b.u + 1, b.v}};
}

std::array<CellBox, 2> halvesV(const CellBox& b) {
    return {CellBox{b.levelU, b.levelV + 1, b.u, 2 * b.v}, CellBox{b.levelU, b.levelV + 1, b.u, 2 * b.v + 1}};
}

}  // namespace

CellBox cornerBox(std::uint32_t corner, std::uint32_t level) {
    const std::uint32_t last = (1U << level) - 1;
    return {level, level, corner == 1 || corner == 2 ? last : 0, corner >= 2 ? last : 0};
}

// The domain's irregular corner that the box has, 4 for none.
std::uint32_t CellCutter::irregularCorner(const CellBox& box) const {
    const bool lowU = box.u == 0, lowV = box.v == 0;
    const bool highU = box.u + 1 == 1U << box.levelU, highV = box.v + 1 == 1U << box.levelV;
    const std::array<bool, 4> touches{lowU && lowV, highU && lowV, highU && highV, lowU && highV};
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
        if (touches[corner] && rules_.depths[corner] > 0) return corner;
    }
    return 4;
}

bool CellCutter::isExact(const CellBox& box) const {
    return irregularCorner(box) == 4 && isLimit(limit_, box, hermiteNet(limit_, box), rules_.exact);
}

void CellCutter::add(const CellBox& box) {
    const std::uint32_t corner = irregularCorner(box);
    if (corner < 4) {
        if (box.levelU < rules_.depths[corner]) return addQuarters(box);
        if (!rules_.leftOut[corner]) emit(box, capNet(limit_, box, corner));
        return;
    }
    const BicubicNet net = hermiteNet(limit_, box);
    if (limit_.isRegular() || std::min(box.levelU, box.levelV) >= rules_.deepest || isLimit(limit_, box, net, rules_.exact)) {
        return emit(box, net);
    }
    const auto [left, right] = halvesU(box);
    const auto [lower, upper] = halvesV(box);
    const bool byU = box.levelU < rules_.deepest && (isExact(left) || isExact(right));
    const bool byV = box.levelV < rules_.deepest && (isExact(lower) || isExact(upper));
    if (byU == byV && box.levelU == box.levelV) return addQuarters(box);
    const bool alongU = byU != byV ? byU : box.levelU < box.levelV;
    add(alongU ? left : lower);
    add(alongU ? right : upper);
}

void CellCutter::addQuarters(const CellBox& box) {
    for (const CellBox& row : halvesV(box)) {
        for (const CellBox& part : halvesU(row)) add(part);
    }
}

void CellCutter::emit(const CellBox& box, const BicubicNet& net) {
    Cell cell;
    cell.domain = domain_;
    cell.levelU = box.levelU;
    cell.levelV = box.levelV;
    cell.u = box.u;
    cell.v = box.v;
    std::copy(net.begin(), net.end(), cell.points.begin());
    cells_.push_back(cell);
}

}  // namespace tessera::subdivision
