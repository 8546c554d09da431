// Surfaces of many bicubic patches that share their borders to the bit, because all are cut from one grid of Bezier points.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

namespace tessera {

// Bezier points of columns x rows patches: 3 columns + 1 points along u, 3 rows + 1 along v.
class Sheet {
public:
    Sheet(std::size_t columns, std::size_t rows);

    [[nodiscard]] glm::dvec3& at(std::size_t i, std::size_t j) { return points_[j * stride_ + i]; }
    [[nodiscard]] std::size_t pointColumns() const { return stride_; }
    [[nodiscard]] std::size_t pointRows() const { return points_.size() / stride_; }

    // Appends the patches, 16 points each, as Mesh::points has them.
    void appendTo(std::vector<glm::vec3>& points) const;

private:
    std::size_t stride_;
    std::vector<glm::dvec3> points_;
};

// A closed outline in the ground's plane (x, z) by its Bezier points, 3 a segment and the first again at the end; from above it runs
// clockwise, so that surfaces turned along it face outward.
struct RingPoint {
    glm::dvec2 place{0.0};
    glm::dvec2 outward{0.0};  // where the point goes when the outline grows by 1
    double inset = 0.0;       // how much of a profile's relief it takes: goes inward by relief x inset
};
using Ring = std::vector<RingPoint>;

// A circle of radius 1, of `segments` cubic arcs, 3 at least.
[[nodiscard]] Ring circleRing(std::size_t segments);

// A circle whose segments are hollow, with edges between them.
[[nodiscard]] Ring flutedRing(std::size_t segments);

// A rectangle of half the sides x and z with corners rounded by `corner`. Its sides have so many bays each, panes that take relief
// between piers; with none, a side is one segment. 4 bays + 1 segments a side, and one a corner.
struct WallPlan {
    double x = 1.0;
    double z = 1.0;
    double corner = 0.1;
    std::size_t xBays = 0;  // along the sides that run in x
    std::size_t zBays = 0;
};
[[nodiscard]] Ring wallRing(const WallPlan& plan);

// The outline's way up, by Bezier points likewise: 3 a segment and one more.
struct ProfilePoint {
    double scale = 1.0;   // of the outline; 0 closes it
    double height = 0.0;  // y
    double grow = 0.0;    // outward, after the scale
    double relief = 0.0;
    glm::dvec2 shift{0.0};  // of the whole outline in x and z
};

// Makes a profile segment by segment.
class Profile {
public:
    explicit Profile(const ProfilePoint& start) : points_{start} {}

    Profile& line(const ProfilePoint& end);
    // Leaves along the first inner point and arrives from the second.
    Profile& curve(const ProfilePoint& first, const ProfilePoint& second, const ProfilePoint& end);
    // Smoothly from one point to the next, flat in scale, grow, relief and shift at both ends; heights evenly.
    Profile& ease(const ProfilePoint& end);

    [[nodiscard]] const ProfilePoint& end() const { return points_.back(); }
    [[nodiscard]] const std::vector<ProfilePoint>& points() const { return points_; }

private:
    std::vector<ProfilePoint> points_;
};

// The outline swept up the profile. Faces outward where the profile rises.
void appendTurned(std::vector<glm::vec3>& points, const Ring& ring, const Profile& profile);

// A round rod, of `sides` patches around and one along, after a cubic Bezier curve; its radius goes evenly from first to last.
struct Rod {
    glm::dvec3 points[4];
    double first = 1.0;
    double last = 1.0;
};
void appendRod(std::vector<glm::vec3>& points, const Rod& rod, std::size_t sides);

// A patch along the cubic Bezier curve `spine`, at each of its points so wide to both sides along `side`, bent up by `fold` at its edges.
struct Blade {
    glm::dvec3 spine[4];
    double half[4] = {1.0, 1.0, 1.0, 1.0};
    glm::dvec3 side{1.0, 0.0, 0.0};
    glm::dvec3 fold{0.0};
};
void appendBlade(std::vector<glm::vec3>& points, const Blade& blade);

}  // namespace tessera
