// Polygons cut into triangles.
#include "subdivision/triangulate.h"

#include <algorithm>
#include <numeric>

#include "subdivision/clean_cage_parts.h"

namespace tessera::subdivision {

namespace {

constexpr std::size_t kMostEars = 64;  // looking for ears takes the cube of these steps at worst

// One face after the other.
class FaceCutter {
public:
    FaceCutter(const Cage& cage, std::vector<CornerTriangle>& triangles) : cage_(cage), triangles_(triangles) {}

    void cut(std::uint32_t face, std::uint32_t first, std::uint32_t size) {
        face_ = face;
        first_ = first;
        if (size == 3) {
            add(0, 1, 2);
            return;
        }
        flatten(size);
        if (size == 4) {
            cutQuad();
        } else if (isConvex()) {
            halve(0, size - 1);
        } else if (size <= kMostEars) {
            clipEars();
        } else {
            ++folded_;
            halve(0, size - 1);
        }
    }

    // Faces that are too large for their shape.
    [[nodiscard]] std::size_t folded() const { return folded_; }

private:
    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) { triangles_.push_back({face_, {first_ + a, first_ + b, first_ + c}}); }

    // Along the axis that the face looks along most, counter-clockwise.
    void flatten(std::uint32_t size) {
        const glm::dvec3 normal = newellNormal(cage_, first_, size), reach = glm::abs(normal);
        const glm::dvec3 origin(cage_.points[cage_.faceVertices[first_]]);
        flat_.clear();
        for (std::uint32_t k = 0; k < size; ++k) {
            const glm::dvec3 p = glm::dvec3(cage_.points[cage_.faceVertices[first_ + k]]) - origin;
            if (reach.z >= reach.x && reach.z >= reach.y) {
                flat_.emplace_back(normal.z < 0.0 ? -p.x : p.x, p.y);
            } else if (reach.x >= reach.y) {
                flat_.emplace_back(normal.x < 0.0 ? -p.y : p.y, p.z);
            } else {
                flat_.emplace_back(normal.y < 0.0 ? -p.z : p.z, p.x);
            }
        }
    }

    // Twice the triangle's area; below 0 where it runs clockwise.
    [[nodiscard]] double area(std::size_t a, std::size_t b, std::size_t c) const {
        const glm::dvec2 ab = flat_[b] - flat_[a], ac = flat_[c] - flat_[a];
        return ab.x * ac.y - ab.y * ac.x;
    }

    [[nodiscard]] bool isConvex() const {
        for (std::size_t k = 0; k < flat_.size(); ++k) {
            if (area(k, (k + 1) % flat_.size(), (k + 2) % flat_.size()) < 0.0) return false;
        }
        return true;
    }

    [[nodiscard]] double squaredLength(std::uint32_t a, std::uint32_t b) const {
        const glm::dvec3 along =
            glm::dvec3(cage_.points[cage_.faceVertices[first_ + a]]) - glm::dvec3(cage_.points[cage_.faceVertices[first_ + b]]);
        return glm::dot(along, along);
    }

    void cutQuad() {
        const double first = std::min(area(0, 1, 2), area(0, 2, 3)), second = std::min(area(0, 1, 3), area(1, 2, 3));
        const bool either = first > 0.0 && second > 0.0;
        if (either ? squaredLength(0, 2) <= squaredLength(1, 3) : first >= second) {
            add(0, 1, 2);
            add(0, 2, 3);
        } else {
            add(0, 1, 3);
            add(1, 2, 3);
        }
    }

    // The part of corners `low` to `high`; as deep as the size has binary digits.
    void halve(std::uint32_t low, std::uint32_t high) {  // NOLINT(misc-no-recursion)
        if (high - low < 2) return;
        const std::uint32_t middle = (low + high) / 2;
        halve(low, middle);
        add(low, middle, high);
        halve(middle, high);
    }

    [[nodiscard]] bool isEar(std::size_t at) const {
        const std::size_t count = left_.size();
        const std::uint32_t a = left_[(at + count - 1) % count], b = left_[at], c = left_[(at + 1) % count];
        if (!(area(a, b, c) > 0.0)) return false;
        return std::none_of(left_.begin(), left_.end(), [&](std::uint32_t p) {
            return p != a && p != b && p != c && area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0;
        });
    }

    void clipEars() {
        left_.resize(flat_.size());
        std::iota(left_.begin(), left_.end(), 0U);
        std::size_t at = 0;
        while (left_.size() > 3) {
            // A polygon that crosses itself may be without an ear: any corner then goes.
            std::size_t tried = 0;
            while (tried++ < left_.size() && !isEar(at)) at = (at + 1) % left_.size();
            const std::size_t count = left_.size();
            add(left_[(at + count - 1) % count], left_[at], left_[(at + 1) % count]);
            left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
            // Not the next corner but the one after: triangles grow less narrow so.
            at = (at + 1) % left_.size();
        }
        add(left_[0], left_[1], left_[2]);
    }

    const Cage& cage_;
    std::vector<CornerTriangle>& triangles_;
    std::uint32_t face_ = 0, first_ = 0;
    std::vector<glm::dvec2> flat_;
    std::vector<std::uint32_t> left_;
    std::size_t folded_ = 0;
};

}  // namespace

std::vector<CornerTriangle> cornerTriangles(const Cage& cage, CageReport& report) {
    std::vector<CornerTriangle> triangles;
    FaceCutter cutter(cage, triangles);
    std::uint32_t first = 0;
    for (std::uint32_t face = 0; face < cage.faceCount(); first += cage.faceSizes[face++]) cutter.cut(face, first, cage.faceSizes[face]);
    noteCount(report, cutter.folded(), "face", "of more than " + std::to_string(kMostEars) + " corners not convex: cut with folds");
    return triangles;
}

Cage triangulated(const Cage& cage, CageReport& report) {
    Cage cut;
    cut.name = cage.name;
    cut.scheme = cage.scheme;
    cut.boundary = cage.boundary;
    cut.points = cage.points;
    cut.creases = cage.creases;
    cut.corners = cage.corners;
    cut.texturePoints = cage.texturePoints;
    std::vector<bool> isHole(cage.faceCount());
    for (const std::uint32_t hole : cage.holes) isHole[hole] = true;
    for (const CornerTriangle& triangle : cornerTriangles(cage, report)) {
        if (isHole[triangle.face]) cut.holes.push_back(static_cast<std::uint32_t>(cut.faceSizes.size()));
        cut.faceSizes.push_back(3);
        for (const std::uint32_t corner : triangle.corners) {
            cut.faceVertices.push_back(cage.faceVertices[corner]);
            if (!cage.faceTexturePoints.empty()) cut.faceTexturePoints.push_back(cage.faceTexturePoints[corner]);
        }
    }
    return cut;
}

}  // namespace tessera::subdivision
