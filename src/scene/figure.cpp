// A figure of boxes on a lattice, whose faces are drawn out to limbs; smoothed by Catmull and Clark's own rule until it is fine.
#include "scene/figure.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace tessera {

namespace {

using Cell = std::array<int, 3>;

// Lattice cells from `low` to `high`, without the latter; those of the right side (x >= 0) are mirrored to the left.
struct Box {
    Cell low, high;
};

// A cell is 0.5 wide. All of a limb is as thick as its first cells: each grows out of a face of what is before it in this list.
constexpr std::array<Box, 17> kBoxes{{
    {{0, 6, -1}, {2, 11, 1}},     // trunk
    {{0, 11, -1}, {1, 12, 1}},    // neck
    {{0, 12, -1}, {2, 15, 2}},    // head
    {{1, 15, -1}, {2, 16, 0}},    // ear
    {{2, 9, -1}, {6, 11, 1}},     // arm
    {{6, 8, -2}, {8, 11, 2}},     // hand
    {{8, 10, -2}, {12, 11, -1}},  // fingers
    {{8, 10, 0}, {12, 11, 1}},
    {{8, 8, -2}, {12, 9, -1}},
    {{8, 8, 0}, {12, 9, 1}},
    {{6, 11, 1}, {7, 13, 2}},  // thumb
    {{1, 2, -1}, {3, 6, 1}},   // leg
    {{1, 0, -1}, {3, 2, 1}},   // ankle
    {{1, 0, 1}, {3, 1, 3}},    // foot
    {{1, 0, 3}, {2, 1, 4}},    // toe
    {{0, 13, 2}, {1, 14, 3}},  // nose
    {{0, 7, -7}, {1, 8, -1}},  // tail
}};

std::set<Cell> cellsOf() {
    std::set<Cell> cells;
    for (const Box& box : kBoxes) {
        for (int x = box.low[0]; x < box.high[0]; ++x) {
            for (int y = box.low[1]; y < box.high[1]; ++y) {
                for (int z = box.low[2]; z < box.high[2]; ++z) cells.insert({{x, y, z}, {-1 - x, y, z}});
            }
        }
    }
    return cells;
}

// The faces between cells and what is around them, seen from outside.
Cage surfaceOf(const std::set<Cell>& cells) {
    Cage cage;
    std::map<Cell, std::uint32_t> numbers;
    for (const Cell& cell : cells) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const int side : {0, 1}) {
                Cell beyond = cell;
                beyond[axis] += 2 * side - 1;
                if (cells.contains(beyond)) continue;
                const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
                std::array<std::array<int, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
                if (side == 0) std::swap(corners[1], corners[3]);
                cage.faceSizes.push_back(4);
                for (const auto& [du, dv] : corners) {
                    Cell at = cell;
                    at[axis] += side;
                    at[u] += du;
                    at[v] += dv;
                    const auto [found, isNew] = numbers.try_emplace(at, static_cast<std::uint32_t>(cage.points.size()));
                    if (isNew) cage.points.emplace_back(0.5 * at[0], 0.5 * at[1], 0.5 * at[2]);
                    cage.faceVertices.push_back(found->second);
                }
            }
        }
    }
    return cage;
}

// A step of Catmull-Clark subdivision (Catmull, Clark: "Recursively generated B-spline surfaces on arbitrary topological meshes", 1978) of
// a closed cage of quadrilaterals.
class Step {
public:
    explicit Step(const Cage& coarse) : coarse_(coarse), sums_(coarse.points.size(), glm::dvec3(0.0)), valences_(coarse.points.size(), 0) {}

    Cage fine() {
        fine_.points.resize(coarse_.points.size());
        addFacePoints();
        addEdgePoints();
        moveVertices();
        return std::move(fine_);
    }

private:
    [[nodiscard]] std::uint32_t vertex(std::size_t face, std::size_t corner) const { return coarse_.faceVertices[4 * face + corner % 4]; }
    [[nodiscard]] glm::dvec3 point(std::uint32_t number) const { return {coarse_.points[number]}; }

    void addFacePoints() {
        for (std::size_t face = 0; face < coarse_.faceCount(); ++face) {
            glm::dvec3 middle(0.0);
            for (std::size_t k = 0; k < 4; ++k) middle += 0.25 * point(vertex(face, k));
            middles_.push_back(middle);
            fine_.points.emplace_back(middle);
            for (std::size_t k = 0; k < 4; ++k) {
                edges_[std::minmax(vertex(face, k), vertex(face, k + 1))].push_back(static_cast<std::uint32_t>(face));
                // Of each vertex: its faces' middles and, each of its edges being met once going out, its neighbours.
                sums_[vertex(face, k)] += middle + point(vertex(face, k + 1));
                ++valences_[vertex(face, k)];
            }
        }
    }

    void addEdgePoints() {
        for (const auto& [ends, faces] : edges_) {
            edgeNumbers_[ends] = static_cast<std::uint32_t>(fine_.points.size());
            fine_.points.emplace_back(0.25 * (point(ends.first) + point(ends.second) + middles_[faces[0]] + middles_[faces[1]]));
        }
        const auto firstMiddle = static_cast<std::uint32_t>(coarse_.points.size());
        for (std::size_t face = 0; face < coarse_.faceCount(); ++face) {
            for (std::size_t k = 0; k < 4; ++k) {
                const std::uint32_t after = edgeNumbers_.at(std::minmax(vertex(face, k), vertex(face, k + 1)));
                const std::uint32_t before = edgeNumbers_.at(std::minmax(vertex(face, k + 3), vertex(face, k)));
                fine_.faceSizes.push_back(4);
                fine_.faceVertices.insert(fine_.faceVertices.end(),
                                          {vertex(face, k), after, firstMiddle + static_cast<std::uint32_t>(face), before});
            }
        }
    }

    void moveVertices() {
        for (std::size_t i = 0; i < coarse_.points.size(); ++i) {
            const double n = valences_[i];
            fine_.points[i] = glm::vec3(((n - 2.0) * glm::dvec3(coarse_.points[i]) + sums_[i] / n) / n);
        }
    }

    using Ends = std::pair<std::uint32_t, std::uint32_t>;
    const Cage& coarse_;
    Cage fine_;
    std::vector<glm::dvec3> sums_, middles_;
    std::vector<int> valences_;
    std::map<Ends, std::vector<std::uint32_t>> edges_;
    std::map<Ends, std::uint32_t> edgeNumbers_;
};

}  // namespace

Cage figureCage() {
    Cage cage = surfaceOf(cellsOf());
    for (int step = 0; step < 2; ++step) cage = Step(cage).fine();
    return cage;
}

}  // namespace tessera
