// The sheet that speed is compared on: one smooth bicubic surface, which every program takes in its own form. Needs GLM alone.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace tessera::bench {

// Uniform bicubic B-spline: `along` x `along` patches of about a unit, in waves of some seven of them, high enough that a patch takes
// 64 segments a side before 32-bit positions are too coarse. Points lie row by row, `along` + 3 each way.
struct Sheet {
    int along = 1;
    std::vector<glm::vec3> points;

    [[nodiscard]] int pointsAlong() const { return along + 3; }
    [[nodiscard]] std::size_t indexOf(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(pointsAlong()) + static_cast<std::size_t>(column);
    }
};

[[nodiscard]] Sheet makeSheet(int along);

// The same surface as Bezier patches, 16 points each in the order of PatchKind::bezier; neighbours' borders are equal to the bit.
[[nodiscard]] std::vector<glm::vec3> bezierPoints(const Sheet& sheet);

// A point of the Bezier patch whose control points begin at `patch`.
[[nodiscard]] glm::dvec3 bezierPoint(const glm::vec3* patch, double u, double v);

}  // namespace tessera::bench
