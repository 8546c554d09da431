// All kinds of patches in double precision; the definitions stand in the header.
#include "patch_eval.h"

#include <algorithm>
#include <cmath>

namespace tessera::reference {

namespace {

// Net position of the points p0..p3, e+0..e+3, e-0..e-3.
constexpr std::array<std::size_t, 12> borderSlot{0, 3, 15, 12, 1, 7, 14, 8, 4, 2, 11, 13};

constexpr std::size_t faceFirst = 12;  // f+0; f-0 follows four later

// Where the rows of a pn triangle's points begin, and those of its normals.
constexpr std::array<std::size_t, 4> pnRow{0, 4, 7, 9};
constexpr std::array<std::size_t, 3> pnNormalRow{10, 13, 15};
constexpr std::array<double, 4> factorial{1, 1, 2, 6};

// The two weights whose shares blend f+ and f-, and their constant derivatives.
struct Shares {
    double plus, minus;
    glm::dvec2 plusSlope, minusSlope;
};

Shares shares(std::size_t corner, double u, double v) {
    const double ru = 1.0 - u;
    const double rv = 1.0 - v;
    switch (corner) {
        case 0:
            return {u, v, {1, 0}, {0, 1}};
        case 1:
            return {v, ru, {0, 1}, {-1, 0}};
        case 2:
            return {ru, rv, {-1, 0}, {0, -1}};
        default:
            return {rv, u, {0, -1}, {1, 0}};
    }
}

SurfacePoint evaluateNet(const Net& net, const Bernstein& bu, const Bernstein& bv) {
    SurfacePoint result;
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::dvec3& point = net[4 * j + i];
            result.position += bu.value[i] * bv.value[j] * point;
            result.du += bu.slope[i] * bv.value[j] * point;
            result.dv += bu.value[i] * bv.slope[j] * point;
        }
    }
    return result;
}

SurfacePoint evaluateGregory(Points points, double u, double v) {
    std::array<Blend, 4> blends;
    std::array<glm::dvec3, 4> blended;
    for (std::size_t k = 0; k < 4; ++k) {
        blends[k] = blend(k, u, v);
        blended[k] = blends[k].plus * points[faceFirst + k] + blends[k].minus * points[faceFirst + 4 + k];
    }
    const Bernstein bu = bernstein(u);
    const Bernstein bv = bernstein(v);
    SurfacePoint result = evaluateNet(gregoryNet(points, blended), bu, bv);
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::dvec3 apart = points[faceFirst + k] - points[faceFirst + 4 + k];
        const double weight = bu.value[blendSlot[k] % 4] * bv.value[blendSlot[k] / 4];
        result.du += weight * blends[k].plusDu * apart;
        result.dv += weight * blends[k].plusDv * apart;
    }
    return result;
}

Net bicubicNet(Points points) {
    Net net;
    std::copy_n(points.begin(), net.size(), net.begin());
    return net;
}

SurfacePoint evaluateRational(Points points, Weights weights, double u, double v) {
    Net weighted;
    Net weightAlone;  // as x coordinates
    for (std::size_t i = 0; i < weighted.size(); ++i) {
        weighted[i] = weights[i] * points[i];
        weightAlone[i] = glm::dvec3(weights[i], 0, 0);
    }
    const SurfacePoint above = evaluateNet(weighted, bernstein(u), bernstein(v));
    const SurfacePoint below = evaluateNet(weightAlone, bernstein(u), bernstein(v));
    const double weight = below.position.x;
    const glm::dvec3 position = above.position / weight;
    return {position, (above.du - below.du.x * position) / weight, (above.dv - below.dv.x * position) / weight};
}

const glm::dvec3& pnPoint(Points points, std::size_t i, std::size_t j) { return points[pnRow[j] + i]; }

SurfacePoint evaluatePn(Points points, double u, double v) {
    const double w = 1.0 - u - v;
    const std::array<double, 4> powersU{1, u, u * u, u * u * u};
    const std::array<double, 4> powersV{1, v, v * v, v * v * v};
    const std::array<double, 4> powersW{1, w, w * w, w * w * w};
    const auto weight = [&](std::size_t i, std::size_t j, std::size_t degree) {
        const std::size_t k = degree - i - j;
        return factorial[degree] / (factorial[i] * factorial[j] * factorial[k]) * powersU[i] * powersV[j] * powersW[k];
    };
    SurfacePoint result;
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i + j < 4; ++i) {
            result.position += weight(i, j, 3) * pnPoint(points, i, j);
            if (i + j == 3) continue;
            result.du += 3.0 * weight(i, j, 2) * (pnPoint(points, i + 1, j) - pnPoint(points, i, j));
            result.dv += 3.0 * weight(i, j, 2) * (pnPoint(points, i, j + 1) - pnPoint(points, i, j));
        }
    }
    return result;
}

// The patch's (u, v) that limits of normals are approached from.
glm::dvec2 middleOf(PatchKind kind) { return glm::dvec2(kind == PatchKind::pn ? 1.0 / 3.0 : 0.5); }

// du x dv, or zero where it is too small beside the patch to have a direction.
glm::dvec3 crossOrZero(PatchKind kind, Points points, Weights weights, const glm::dvec2& at, double threshold) {
    const SurfacePoint s = evaluate(kind, points, at.x, at.y, weights);
    const glm::dvec3 cross = glm::cross(s.du, s.dv);
    return glm::length(cross) > threshold ? glm::normalize(cross) : glm::dvec3(0.0);
}

}  // namespace

Bernstein bernstein(double t) {
    const double s = 1.0 - t;
    return {{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t}, {-3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t}};
}

Blend blend(std::size_t corner, double u, double v) {
    const Shares s = shares(corner, u, v);
    const double sum = s.plus + s.minus;
    if (sum == 0.0) return {};
    const glm::dvec2 slope = (s.minus * s.plusSlope - s.plus * s.minusSlope) / (sum * sum);
    return {s.plus / sum, s.minus / sum, slope.x, slope.y};
}

Net gregoryNet(Points gregory, const std::array<glm::dvec3, 4>& blended) {
    Net net;
    for (std::size_t i = 0; i < borderSlot.size(); ++i) net[borderSlot[i]] = gregory[i];
    for (std::size_t k = 0; k < 4; ++k) net[blendSlot[k]] = blended[k];
    return net;
}

Net pnNet(Points pn) {
    // Forward differences at corner A are the coefficients of u^i v^j, but for their binomial factors.
    std::array<std::array<glm::dvec3, 4>, 4> power{};
    for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i + j < 4; ++i) power[j][i] = pnPoint(pn, i, j);
    for (std::size_t step = 1; step < 4; ++step) {
        for (std::size_t j = 0; j < 4; ++j)
            for (std::size_t i = 3 - j; i >= step; --i) power[j][i] -= power[j][i - 1];
    }
    for (std::size_t step = 1; step < 4; ++step) {
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 3 - i; j >= step; --j) power[j][i] -= power[j - 1][i];
    }
    const auto choose = [](std::size_t n, std::size_t k) { return k > n ? 0.0 : factorial[n] / (factorial[k] * factorial[n - k]); };
    Net net{};
    for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t i = 0; i + j < 4; ++i) {
            const glm::dvec3 coefficient = factorial[3] / (factorial[i] * factorial[j] * factorial[3 - i - j]) * power[j][i];
            // The control values of u^i are choose(column, i) / choose(3, i).
            for (std::size_t p = 0; p < 16; ++p)
                net[p] += choose(p % 4, i) / choose(3, i) * (choose(p / 4, j) / choose(3, j)) * coefficient;
        }
    }
    return net;
}

SurfacePoint evaluate(PatchKind kind, Points points, double u, double v, Weights weights) {
    if (kind == PatchKind::gregory) return evaluateGregory(points, u, v);
    if (kind == PatchKind::pn) return evaluatePn(points, u, v);
    if (!weights.empty()) return evaluateRational(points, weights, u, v);
    return evaluateNet(bicubicNet(points), bernstein(u), bernstein(v));
}

glm::dvec3 unitNormal(PatchKind kind, Points points, double u, double v, Weights weights) {
    points = points.first(positionsPerPatch(kind));
    // A patch smaller beside its distance from the origin than single precision can say is a point.
    const double size = std::max(patchSize(points), 1e-7 * glm::length(points[0]));
    // Below the first threshold rounding is 1e-6 of the product; below the second nothing but rounding is left.
    const double unsure = 1e-10 * size * size;
    const double lost = 1e-14 * size * size;
    const glm::dvec3 here = crossOrZero(kind, points, weights, {u, v}, unsure);
    if (here != glm::dvec3(0.0)) return here;
    // Two steps inward extrapolate to the limit: the error falls from first to second order in the step.
    const double step = 1e-5;
    const glm::dvec2 start(u, v);
    glm::dvec2 inward = middleOf(kind) - start;
    if (glm::length(inward) < 1e-3) inward = glm::dvec2(0.3, 0.4);
    const glm::dvec3 farNormal = crossOrZero(kind, points, weights, start + step * inward, lost);
    const glm::dvec3 closeNormal = crossOrZero(kind, points, weights, start + 0.5 * step * inward, lost);
    const glm::dvec3 limit = 2.0 * closeNormal - farNormal;
    return glm::length(limit) > 0.5 ? glm::normalize(limit) : glm::dvec3(0.0);
}

glm::dvec3 shadingNormal(PatchKind kind, Points points, double u, double v, Weights weights) {
    if (kind == PatchKind::pn) {
        const std::array<double, 3> bary{u, v, 1.0 - u - v};
        glm::dvec3 sum(0.0);
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t i = 0; i + j < 3; ++i) {
                const auto power = [](double value, std::size_t exponent) { return std::pow(value, static_cast<double>(exponent)); };
                sum += power(bary[0], i) * power(bary[1], j) * power(bary[2], 2 - i - j) * points[pnNormalRow[j] + i];
            }
        }
        if (glm::length(sum) > 0.0) return glm::normalize(sum);
    }
    return unitNormal(kind, points, u, v, weights);
}

std::array<glm::dvec3, 20> gregoryFromBezier(Points bezier) {
    std::array<glm::dvec3, 20> result;
    for (std::size_t i = 0; i < borderSlot.size(); ++i) result[i] = bezier[borderSlot[i]];
    for (std::size_t k = 0; k < 4; ++k) result[faceFirst + k] = result[faceFirst + 4 + k] = bezier[blendSlot[k]];
    return result;
}

std::vector<glm::dvec3> patchPoints(const Mesh& mesh, std::size_t patch) {
    const std::size_t count = pointsPerPatch(mesh.kind);
    std::vector<glm::dvec3> result(count);
    for (std::size_t i = 0; i < count; ++i) result[i] = glm::dvec3(mesh.points.at(patch * count + i));
    return result;
}

std::vector<double> patchWeights(const Mesh& mesh, std::size_t patch) {
    if (mesh.kind != PatchKind::rational) return {};
    const auto first = mesh.weights.begin() + static_cast<std::ptrdiff_t>(16 * patch);
    return {first, first + 16};
}

double patchSize(Points points) {
    glm::dvec3 lower(points.front());
    glm::dvec3 upper(points.front());
    for (const glm::dvec3& point : points) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
    return glm::length(upper - lower);
}

}  // namespace tessera::reference
