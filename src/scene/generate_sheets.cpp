// Surfaces of many bicubic patches cut from one grid of Bezier points.
#include "scene/generate_sheets.h"

#include <cmath>

#include "scene/generate_numbers.h"

namespace tessera {

namespace {

// How far the inner points of a cubic arc of so many turns lie along its tangents, in radii: 4/3 of the tangent of a quarter of it.
double arcReach(double turns) {
    const glm::dvec2 quarter = onCircle(0.25 * turns);
    return 4.0 / 3.0 * quarter.y / quarter.x;
}

// Clockwise from above: x to -z.
glm::dvec2 around(double turns) {
    const glm::dvec2 point = onCircle(turns);
    return {point.x, -point.y};
}

glm::dvec2 tangentOf(const glm::dvec2& outward) { return {outward.y, -outward.x}; }

// Three points of an arc of radius 1 and its first end left out, as `circleRing` and corners need them.
void appendArc(Ring& ring, const glm::dvec2& centre, double radius, double from, double to) {
    const double reach = arcReach(to - from);
    const glm::dvec2 start = around(from);
    const glm::dvec2 end = around(to);
    for (const glm::dvec2& outward : {start + reach * tangentOf(start), end - reach * tangentOf(end), end}) {
        ring.push_back({centre + radius * outward, outward, 0.0});
    }
}

void appendStraight(Ring& ring, const glm::dvec2& end, const glm::dvec2& outward, double insetFirst, double insetLast) {
    const glm::dvec2 start = ring.back().place;
    ring.push_back({start + (end - start) / 3.0, outward, insetFirst});
    ring.push_back({end - (end - start) / 3.0, outward, insetLast});
    ring.push_back({end, outward, insetLast});
}

// A pier, then for each bay the way in, the pane, the way out and a pier.
void appendSide(Ring& ring, const glm::dvec2& end, const glm::dvec2& outward, std::size_t bays) {
    const glm::dvec2 start = ring.back().place;
    // In the panes' and piers' own measure: pane 4, reveal 1, pier 3 wide.
    const double whole = static_cast<double>(bays) * 9.0 + 3.0;
    double done = 3.0;
    const auto segment = [&](double width, double insetFirst, double insetLast) {
        done += width;
        appendStraight(ring, start + (end - start) * (done / whole), outward, insetFirst, insetLast);
    };
    appendStraight(ring, bays == 0 ? end : start + (end - start) * (done / whole), outward, 0.0, 0.0);
    for (std::size_t bay = 0; bay < bays; ++bay) {
        segment(1.0, 0.0, 1.0);
        segment(4.0, 1.0, 1.0);
        segment(1.0, 1.0, 0.0);
        segment(3.0, 0.0, 0.0);
    }
}

void close(Ring& ring) { ring.back() = ring.front(); }

ProfilePoint blend(const ProfilePoint& a, const ProfilePoint& b, double t) {
    const auto mix = [t](auto from, auto to) { return from + (to - from) * t; };
    return {mix(a.scale, b.scale), mix(a.height, b.height), mix(a.grow, b.grow), mix(a.relief, b.relief), mix(a.shift, b.shift)};
}

glm::dvec3 acrossOf(const glm::dvec3& direction) {
    const glm::dvec3 hint = std::abs(direction.y) < 0.9 * glm::length(direction) ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    return glm::normalize(glm::cross(direction, hint));
}

}  // namespace

Sheet::Sheet(std::size_t columns, std::size_t rows) : stride_(3 * columns + 1), points_(stride_ * (3 * rows + 1)) {}

void Sheet::appendTo(std::vector<glm::vec3>& points) const {
    for (std::size_t j = 0; j + 3 < pointRows(); j += 3) {
        for (std::size_t i = 0; i + 3 < stride_; i += 3) {
            for (std::size_t k = 0; k < 16; ++k) points.emplace_back(points_[(j + k / 4) * stride_ + i + k % 4]);
        }
    }
}

Ring circleRing(std::size_t segments) {
    const auto count = static_cast<double>(segments);
    const glm::dvec2 start = around(0.0);
    Ring ring{{start, start, 0.0}};
    for (std::size_t i = 0; i < segments; ++i)
        appendArc(ring, glm::dvec2(0.0), 1.0, static_cast<double>(i) / count, static_cast<double>(i + 1) / count);
    close(ring);
    return ring;
}

Ring flutedRing(std::size_t segments) {
    Ring ring = circleRing(segments);
    for (std::size_t i = 0; i < ring.size(); ++i) ring[i].inset = i % 3 == 0 ? 0.0 : 1.0;
    return ring;
}

Ring wallRing(const WallPlan& plan) {
    const double x = plan.x - plan.corner;
    const double z = plan.z - plan.corner;
    Ring ring{{{plan.x, z}, {1.0, 0.0}, 0.0}};
    appendSide(ring, {plan.x, -z}, {1.0, 0.0}, plan.zBays);
    appendArc(ring, {x, -z}, plan.corner, 0.0, 0.25);
    appendSide(ring, {-x, -plan.z}, {0.0, -1.0}, plan.xBays);
    appendArc(ring, {-x, -z}, plan.corner, 0.25, 0.5);
    appendSide(ring, {-plan.x, z}, {-1.0, 0.0}, plan.zBays);
    appendArc(ring, {-x, z}, plan.corner, 0.5, 0.75);
    appendSide(ring, {x, plan.z}, {0.0, 1.0}, plan.xBays);
    appendArc(ring, {x, z}, plan.corner, 0.75, 1.0);
    close(ring);
    return ring;
}

Profile& Profile::line(const ProfilePoint& end) {
    const ProfilePoint start = points_.back();
    return curve(blend(start, end, 1.0 / 3.0), blend(start, end, 2.0 / 3.0), end);
}

Profile& Profile::curve(const ProfilePoint& first, const ProfilePoint& second, const ProfilePoint& end) {
    points_.insert(points_.end(), {first, second, end});
    return *this;
}

Profile& Profile::ease(const ProfilePoint& end) {
    const ProfilePoint start = points_.back();
    ProfilePoint first = start;
    ProfilePoint second = end;
    first.height = start.height + (end.height - start.height) / 3.0;
    second.height = end.height - (end.height - start.height) / 3.0;
    return curve(first, second, end);
}

void appendTurned(std::vector<glm::vec3>& points, const Ring& ring, const Profile& profile) {
    const std::vector<ProfilePoint>& way = profile.points();
    Sheet sheet((ring.size() - 1) / 3, (way.size() - 1) / 3);
    for (std::size_t j = 0; j < way.size(); ++j) {
        const ProfilePoint& up = way[j];
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const RingPoint& at = ring[i];
            const glm::dvec2 place = at.place * up.scale + at.outward * (up.grow - at.inset * up.relief) + up.shift;
            sheet.at(i, j) = {place.x, up.height, place.y};
        }
    }
    sheet.appendTo(points);
}

void appendRod(std::vector<glm::vec3>& points, const Rod& rod, std::size_t sides) {
    const Ring ring = circleRing(sides);
    const glm::dvec3 direction = glm::normalize(rod.points[3] - rod.points[0]);
    const glm::dvec3 x = acrossOf(direction);
    const glm::dvec3 z = glm::cross(x, direction);
    Sheet sheet(sides, 1);
    for (std::size_t j = 0; j < 4; ++j) {
        const double radius = rod.first + (rod.last - rod.first) * static_cast<double>(j) / 3.0;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            sheet.at(i, j) = rod.points[j] + radius * (ring[i].place.x * x + ring[i].place.y * z);
        }
    }
    sheet.appendTo(points);
}

void appendBlade(std::vector<glm::vec3>& points, const Blade& blade) {
    for (std::size_t j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            const double across = (i - 1.5) / 1.5;
            const glm::dvec3 up = i == 0 || i == 3 ? blade.fold : glm::dvec3(0.0);
            points.emplace_back(blade.spine[j] + blade.side * (across * blade.half[j]) + up);
        }
    }
}

}  // namespace tessera
