// Bicubic patches fitted to parts of a limit surface.
#include "subdivision/limit_fit.h"

#include <algorithm>
#include <cmath>

namespace tessera::subdivision {

namespace {

std::array<double, 4> cubic(double t) {
    const double s = 1.0 - t;
    return {s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t};
}

std::array<double, 4> cubicSlope(double t) {
    const double s = 1.0 - t;
    return {-3.0 * s * s, 3.0 * s * s - 6.0 * s * t, 6.0 * s * t - 3.0 * t * t, 3.0 * t * t};
}

glm::dvec3 blend(const BicubicNet& net, const std::array<double, 4>& along, const std::array<double, 4>& across) {
    glm::dvec3 sum(0.0);
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i < 4; ++i) sum += across[j] * along[i] * net[4 * j + i];
    }
    return sum;
}

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

// Where the points around a box's corner stand in its net: the corner, next along either side, inside; and the ends of the sides.
struct CornerPlaces {
    std::size_t corner, nearU, nearV, inner, farU2, farU, farV2, farV;
};
constexpr std::array<CornerPlaces, 4> kCornerPlaces{
    {{0, 1, 4, 5, 2, 3, 8, 12}, {3, 2, 7, 6, 1, 0, 11, 15}, {15, 14, 11, 10, 13, 12, 7, 3}, {12, 13, 8, 9, 14, 15, 4, 0}}};

// The second point of a cubic from `first` along `direction`, whose other points are given, that comes nearest to `middle` at its middle.
glm::dvec3 secondPoint(const glm::dvec3& first, const glm::dvec3& direction, const glm::dvec3& third, const glm::dvec3& last,
                       const glm::dvec3& middle) {
    const glm::dvec3 wanted = (8.0 * middle - first - 3.0 * third - last) / 3.0;
    const glm::dvec3 along = unit(direction);
    return first + std::max(0.0, glm::dot(wanted - first, along)) * along;
}

}  // namespace

double CellBox::sizeU() const { return std::ldexp(1.0, -static_cast<int>(levelU)); }
double CellBox::sizeV() const { return std::ldexp(1.0, -static_cast<int>(levelV)); }
glm::dvec2 CellBox::at(double s, double t) const { return {(u + s) * sizeU(), (v + t) * sizeV()}; }

glm::dvec3 netPoint(const BicubicNet& net, double s, double t) { return blend(net, cubic(s), cubic(t)); }

std::array<glm::dvec3, 2> netTangents(const BicubicNet& net, double s, double t) {
    return {blend(net, cubicSlope(s), cubic(t)), blend(net, cubic(s), cubicSlope(t))};
}

BicubicNet hermiteNet(const LimitSurface& limit, const CellBox& box) {
    BicubicNet net{};
    for (std::size_t j = 0; j < 2; ++j) {
        for (std::size_t i = 0; i < 2; ++i) {
            const glm::dvec2 place = box.at(static_cast<double>(i), static_cast<double>(j));
            const LimitPoint p = limit.at(place.x, place.y);
            const double s = (i == 0 ? 1.0 : -1.0) * box.sizeU() / 3.0, t = (j == 0 ? 1.0 : -1.0) * box.sizeV() / 3.0;
            const std::size_t outerU = 3 * i, innerU = 1 + i, outerV = 3 * j, innerV = 1 + j;
            net[4 * outerV + outerU] = p.position;
            net[4 * outerV + innerU] = p.position + s * p.du;
            net[4 * innerV + outerU] = p.position + t * p.dv;
            net[4 * innerV + innerU] = p.position + s * p.du + t * p.dv + s * t * p.duv;
        }
    }
    return net;
}

BicubicNet capNet(const LimitSurface& limit, const CellBox& box, std::uint32_t corner) {
    BicubicNet net = hermiteNet(limit, box);
    const CornerPlaces& k = kCornerPlaces[corner];
    const double s = corner == 1 || corner == 2 ? 1.0 : 0.0, t = corner >= 2 ? 1.0 : 0.0;
    const auto limitAt = [&](double a, double b) {
        const glm::dvec2 place = box.at(a, b);
        return limit.tangentsAt(place.x, place.y);
    };
    const LimitPoint apex = limitAt(s, t);
    const double towardsU = s == 0.0 ? 1.0 : -1.0, towardsV = t == 0.0 ? 1.0 : -1.0;
    net[k.nearU] = secondPoint(apex.position, towardsU * apex.du, net[k.farU2], net[k.farU], limitAt(0.5, t).position);
    net[k.nearV] = secondPoint(apex.position, towardsV * apex.dv, net[k.farV2], net[k.farV], limitAt(s, 0.5).position);
    net[k.inner] = glm::dvec3(0.0);
    // All but the inner point's share of the middle: it has 9 of 64 parts.
    net[k.inner] = (limitAt(0.5, 0.5).position - netPoint(net, 0.5, 0.5)) * (64.0 / 9.0);
    return net;
}

FitError fitError(const LimitSurface& limit, const CellBox& box, const BicubicNet& net, const FitError& most) {
    FitError worst;
    const double width = std::max(std::max(glm::distance(net[0], net[15]), glm::distance(net[3], net[12])), 1e-300);
    // Not where cap nets are fitted.
    constexpr std::array<double, 6> kPlaces{0.0, 0.125, 0.375, 0.625, 0.875, 1.0};
    for (std::size_t j = 0; j <= 5; ++j) {
        for (std::size_t i = 0; i <= 5; ++i) {
            if (i % 5 == 0 && j % 5 == 0) continue;
            const double s = kPlaces[i], t = kPlaces[j];
            const glm::dvec2 place = box.at(s, t);
            const LimitPoint p = limit.tangentsAt(place.x, place.y);
            const glm::dvec3 normal = unit(glm::cross(p.du, p.dv));
            const auto [ds, dt] = netTangents(net, s, t);
            const glm::dvec3 off = netPoint(net, s, t) - p.position, other = unit(glm::cross(ds, dt));
            worst.distance = std::max(worst.distance, glm::length(off));
            worst.height = std::max(worst.height, normal == glm::dvec3(0.0) ? glm::length(off) : std::abs(glm::dot(off, normal)));
            // What slides along a surface leaves it by the square, over the radius at which it bends: near a tip that of the cell.
            worst.height = std::max(worst.height, glm::dot(off, off) / width);
            // A border may slide along itself only: surfaces may end there, or have a crease.
            if (i % 5 == 0 || j % 5 == 0) {
                const glm::dvec3 along = unit(i % 5 == 0 ? p.dv : p.du);
                worst.height = std::max(worst.height, glm::length(off - glm::dot(off, along) * along));
            }
            if (normal != glm::dvec3(0.0)) {
                worst.angle = std::max(worst.angle, std::atan2(glm::length(glm::cross(normal, other)), glm::dot(normal, other)));
            }
            if (worst.distance > most.distance || worst.height > most.height || worst.angle > most.angle) return worst;
        }
    }
    return worst;
}

bool isLimit(const LimitSurface& limit, const CellBox& box, const BicubicNet& net, double distance) {
    constexpr std::array<std::array<double, 2>, 7> kPlaces{
        {{0.5, 0.5}, {0.25, 0.75}, {0.75, 0.25}, {0.5, 0.0}, {0.0, 0.5}, {1.0, 0.5}, {0.5, 1.0}}};
    return std::all_of(kPlaces.begin(), kPlaces.end(), [&](const std::array<double, 2>& at) {
        const glm::dvec2 place = box.at(at[0], at[1]);
        return glm::distance(netPoint(net, at[0], at[1]), limit.positionAt(place.x, place.y)) <= distance;
    });
}

}  // namespace tessera::subdivision
