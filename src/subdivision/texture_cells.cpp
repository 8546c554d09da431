// Texture coordinates of cells.
#include "subdivision/texture_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "subdivision/limit_evaluator.h"

namespace tessera::subdivision {

namespace {

// A cell of this level is a millionth of its face.
constexpr std::uint32_t kDeepest = 10;

using TextureNet = std::array<glm::dvec2, 16>;

// Where a parameter across a cell lies in its domain. Ends are exact, so that both cells at a border ask for the same place.
double inDomain(std::uint32_t index, std::uint32_t level, double t) {
    return std::ldexp(static_cast<double>(index) + t, -static_cast<int>(level));
}

// Values at 0, 1/3, 2/3 and 1 to the cubic's control values, along one direction of a net.
void interpolate(TextureNet& net, std::size_t first, std::size_t step) {
    const glm::dvec2 a = net[first], b = net[first + step], c = net[first + 2 * step], d = net[first + 3 * step];
    net[first + step] = (-5.0 * a + 18.0 * b - 9.0 * c + 2.0 * d) / 6.0;
    net[first + 2 * step] = (2.0 * a - 9.0 * b + 18.0 * c - 5.0 * d) / 6.0;
}

glm::dvec2 netAt(const TextureNet& net, double u, double v) {
    const auto basis = [](double t) {
        const double s = 1.0 - t;
        return std::array<double, 4>{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    };
    const std::array<double, 4> across = basis(u), up = basis(v);
    glm::dvec2 sum(0.0);
    for (std::size_t k = 0; k < net.size(); ++k) sum += across[k % 4] * up[k / 4] * net[k];
    return sum;
}

// The halves of a net along one direction, in place and in `second` (de Casteljau).
void halve(std::array<glm::dvec3, 20>& net, std::array<glm::dvec3, 20>& second, std::size_t first, std::size_t step) {
    const glm::dvec3 a = net[first], b = net[first + step], c = net[first + 2 * step], d = net[first + 3 * step];
    const glm::dvec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), cd = 0.5 * (c + d);
    const glm::dvec3 abc = 0.5 * (ab + bc), bcd = 0.5 * (bc + cd), middle = 0.5 * (abc + bcd);
    const std::array<glm::dvec3, 4> low{a, ab, abc, middle}, high{middle, bcd, cd, d};
    for (std::size_t k = 0; k < 4; ++k) {
        net[first + k * step] = low[k];
        second[first + k * step] = high[k];
    }
}

std::pair<Cell, Cell> halvesAlongU(Cell low) {
    ++low.levelU;
    low.u *= 2;
    Cell high = low;
    ++high.u;
    for (std::size_t row = 0; row < 4; ++row) halve(low.points, high.points, 4 * row, 1);
    return {low, high};
}

std::pair<Cell, Cell> halvesAlongV(Cell low) {
    ++low.levelV;
    low.v *= 2;
    Cell high = low;
    ++high.v;
    for (std::size_t column = 0; column < 4; ++column) halve(low.points, high.points, column, 4);
    return {low, high};
}

class TextureMaker {
public:
    TextureMaker(const Refiner& refiner, std::span<const glm::vec2> values, const QuadDomains& domains, double tolerance)
        : limit_(refiner, values), domains_(domains) {
        glm::dvec2 lower(std::numeric_limits<double>::infinity()), upper(-lower);
        for (const glm::vec2& value : values) {
            lower = glm::min(lower, glm::dvec2(value));
            upper = glm::max(upper, glm::dvec2(value));
        }
        if (values.empty()) return;
        // What single precision cannot hold is no reason to cut: all values may be one, and sums of weights are nearly 1.
        const glm::dvec2 largest = glm::max(glm::abs(lower), glm::abs(upper));
        allowed_ = std::max(tolerance * glm::length(upper - lower), std::numeric_limits<float>::epsilon() * std::max(largest.x, largest.y));
    }

    void add(Cell cell) {
        if (!limit_.select(domains_.domains[cell.domain])) {
            made_.push_back(cell);
            return;
        }
        setNet(cell);
        if (!mustCut(cell)) {
            made_.push_back(cell);
            return;
        }
        for (const Cell& row : pairOf(halvesAlongV(cell)))
            for (const Cell& quarter : pairOf(halvesAlongU(row))) add(quarter);
    }

    std::vector<Cell> take() { return std::move(made_); }

private:
    static std::array<Cell, 2> pairOf(const std::pair<Cell, Cell>& halves) { return {halves.first, halves.second}; }

    [[nodiscard]] glm::dvec2 limitAt(const Cell& cell, double u, double v) const {
        return {limit_.position(inDomain(cell.u, cell.levelU, u), inDomain(cell.v, cell.levelV, v))};
    }

    void setNet(Cell& cell) const {
        constexpr std::array<double, 4> thirds{0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0};
        for (std::size_t k = 0; k < 16; ++k) cell.texture[k] = limitAt(cell, thirds[k % 4], thirds[k / 4]);
        for (std::size_t row = 0; row < 4; ++row) interpolate(cell.texture, 4 * row, 1);
        for (std::size_t column = 0; column < 4; ++column) interpolate(cell.texture, column, 4);
    }

    [[nodiscard]] bool mustCut(const Cell& cell) const {
        if (cell.kind != PatchKind::bezier || limit_.polynomial()) return false;
        if (std::isinf(allowed_) || std::max(cell.levelU, cell.levelV) >= kDeepest) return false;
        // Ends, and where a quartic is farthest from the cubic that meets it at the thirds.
        constexpr std::array<double, 5> places{0.0, 0.127, 0.5, 0.873, 1.0};
        for (const double v : places)
            for (const double u : places)
                if (glm::distance(netAt(cell.texture, u, v), limitAt(cell, u, v)) > allowed_) return true;
        return false;
    }

    LimitEvaluator limit_;
    const QuadDomains& domains_;
    double allowed_ = 0.0;
    std::vector<Cell> made_;
};

}  // namespace

void addTexture(const Refiner& refiner, std::span<const glm::vec2> values, const QuadDomains& domains, std::vector<Cell>& cells,
                double tolerance) {
    TextureMaker maker(refiner, values, domains, tolerance);
    for (const Cell& cell : cells) maker.add(cell);
    cells = maker.take();
}

}  // namespace tessera::subdivision
