// Pieces of patches: halving by de Casteljau, and the bounds for the rational part of Gregory patches.
#include "patch_piece.h"

#include <algorithm>

namespace tessera::reference {

namespace {

constexpr double secondDerivativeBound = 18.0;

// The left and right half of the cubic with points at, at + stride, ...
template <typename Value>
void halveCurve(const std::array<Value, 16>& net, std::size_t at, std::size_t stride, std::array<Value, 16>& left,
                std::array<Value, 16>& right) {
    const Value a = net[at];
    const Value b = net[at + stride];
    const Value c = net[at + 2 * stride];
    const Value d = net[at + 3 * stride];
    const Value ab = 0.5 * (a + b);
    const Value bc = 0.5 * (b + c);
    const Value cd = 0.5 * (c + d);
    const Value abc = 0.5 * (ab + bc);
    const Value bcd = 0.5 * (bc + cd);
    const Value middle = 0.5 * (abc + bcd);
    left[at] = a;
    left[at + stride] = ab;
    left[at + 2 * stride] = abc;
    left[at + 3 * stride] = right[at] = middle;
    right[at + stride] = bcd;
    right[at + 2 * stride] = cd;
    right[at + 3 * stride] = d;
}

// G of the header for one corner, and its first derivatives.
struct Tangent {
    double value, du, dv;
};

Tangent tangentAt(std::size_t corner, const glm::dvec2& at) {
    const Bernstein bu = bernstein(at.x);
    const Bernstein bv = bernstein(at.y);
    const std::size_t i = blendSlot[corner] % 4;
    const std::size_t j = blendSlot[corner] / 4;
    const Blend share = blend(corner, at.x, at.y);
    const double weight = bu.value[i] * bv.value[j];
    const double excess = 0.5 * (share.plus - share.minus);
    return {weight * excess, bu.slope[i] * bv.value[j] * excess + weight * share.plusDu,
            bu.value[i] * bv.slope[j] * excess + weight * share.plusDv};
}

}  // namespace

PatchShape makeShape(PatchKind kind, std::vector<glm::dvec3> points, std::vector<double> weights) {
    points.resize(positionsPerPatch(kind));
    PatchShape shape{kind, std::move(points), std::move(weights), {}, false};
    if (kind != PatchKind::gregory) return shape;
    for (std::size_t k = 0; k < 4; ++k) {
        shape.apart[k] = shape.points[12 + k] - shape.points[16 + k];
        shape.blended = shape.blended || shape.apart[k] != glm::dvec3(0.0);
    }
    return shape;
}

PatchShape transformed(const PatchShape& shape, const glm::dmat3& linear, const glm::dvec3& origin) {
    PatchShape result = shape;
    for (glm::dvec3& point : result.points) point = linear * (point - origin);
    for (glm::dvec3& difference : result.apart) difference = linear * difference;
    return result;
}

Piece wholePiece(const PatchShape& shape) {
    Piece piece;
    if (shape.kind == PatchKind::gregory) {
        std::array<glm::dvec3, 4> means;
        for (std::size_t k = 0; k < 4; ++k) means[k] = 0.5 * (shape.points[12 + k] + shape.points[16 + k]);
        piece.net = gregoryNet(shape.points, means);
        return piece;
    }
    if (shape.kind == PatchKind::pn) {
        piece.net = pnNet(shape.points);
        return piece;
    }
    std::copy_n(shape.points.begin(), piece.net.size(), piece.net.begin());
    if (shape.weights.empty()) return piece;
    piece.rational = true;
    std::copy_n(shape.weights.begin(), piece.weights.size(), piece.weights.begin());
    for (std::size_t i = 0; i < piece.net.size(); ++i) piece.net[i] *= piece.weights[i];
    return piece;
}

Piece transformed(const Piece& piece, const glm::dmat3& linear, const glm::dvec3& origin) {
    Piece result = piece;
    for (std::size_t i = 0; i < piece.net.size(); ++i)
        result.net[i] = linear * (piece.net[i] - (piece.rational ? piece.weights[i] : 1.0) * origin);
    return result;
}

std::pair<Piece, Piece> halves(const Piece& piece, bool alongU) {
    std::pair<Piece, Piece> result{piece, piece};
    const int axis = alongU ? 0 : 1;
    result.first.rectangle.upper[axis] = result.second.rectangle.lower[axis] = piece.rectangle.middle()[axis];
    const std::size_t stride = alongU ? 1 : 4;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t at = alongU ? 4 * k : k;
        halveCurve(piece.net, at, stride, result.first.net, result.second.net);
        if (piece.rational) halveCurve(piece.weights, at, stride, result.first.weights, result.second.weights);
    }
    return result;
}

Enclosure enclose(const PatchShape& shape, const Piece& piece) {
    Enclosure result{piece.net, piece.weights, piece.rational, {}, {}, {}};
    if (!shape.blended) return result;
    const glm::dvec2 middle = piece.rectangle.middle();
    const glm::dvec2 width = piece.rectangle.width();
    const double reach = 0.5 * (width.x + width.y);
    for (std::size_t k = 0; k < 4; ++k) {
        const Tangent tangent = tangentAt(k, middle);
        for (std::size_t p = 0; p < 16; ++p) {
            const std::size_t column = p % 4;
            const std::size_t row = p / 4;
            // A linear function's control values are its values at the thirds.
            const double alongU = width.x * (static_cast<double>(column) / 3.0 - 0.5);
            const double alongV = width.y * (static_cast<double>(row) / 3.0 - 0.5);
            result.net[p] += (tangent.value + alongU * tangent.du + alongV * tangent.dv) * shape.apart[k];
        }
        const glm::dvec3 size = secondDerivativeBound * glm::abs(shape.apart[k]);
        result.pad += 0.5 * reach * reach * size;
        result.slopePadU += width.x * reach * size;
        result.slopePadV += width.y * reach * size;
    }
    return result;
}

Box boxOf(const Enclosure& enclosure) {
    const auto point = [&](std::size_t i) { return enclosure.rational ? enclosure.net[i] / enclosure.weights[i] : enclosure.net[i]; };
    Box box{point(0), point(0)};
    for (std::size_t i = 1; i < enclosure.net.size(); ++i) {
        box.lower = glm::min(box.lower, point(i));
        box.upper = glm::max(box.upper, point(i));
    }
    return {box.lower - enclosure.pad, box.upper + enclosure.pad};
}

double greatestWeight(const Enclosure& enclosure) {
    return enclosure.rational ? *std::max_element(enclosure.weights.begin(), enclosure.weights.end()) : 1.0;
}

}  // namespace tessera::reference
