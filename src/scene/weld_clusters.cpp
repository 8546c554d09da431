// Which points are the same within a tolerance: leaders on grids, a grid for each size of tolerance, then unions of leaders.
#include "scene/weld_clusters.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace tessera::welding {

namespace {

constexpr std::uint32_t kNobody = ~std::uint32_t{0};
constexpr double kWidestCluster = 4.0;  // tolerances
// Large cells need few look-ups (most points are far from their cell's walls), but hold more leaders where these are crowded.
constexpr double kCellSize = 2.0;  // tolerances
constexpr std::size_t kBucketsPerWord = 4;

std::uint64_t mix(std::uint64_t bits) {
    bits = (bits ^ (bits >> 31U)) * 0x9E3779B97F4A7C15U;
    return bits ^ (bits >> 29U);
}

std::uint64_t hashOfBits(const glm::dvec3& v) {
    std::uint64_t hash = mix(std::bit_cast<std::uint64_t>(v.x));
    hash = mix(hash + std::bit_cast<std::uint64_t>(v.y));
    return mix(hash + std::bit_cast<std::uint64_t>(v.z));
}

std::size_t bucketCount(std::size_t expected) { return std::bit_ceil(std::max<std::size_t>(expected, 1)); }

int exponentAbove(float tolerance) { return std::ilogb(tolerance) + 1; }

}  // namespace

CellGrid::CellGrid(double cell, std::size_t expected)
    : perCell_(1.0 / cell),
      occupied_(std::max<std::size_t>(bucketCount(expected) / kBucketsPerWord, 1)),
      heads_(bucketCount(expected), kEnd) {}

std::uint64_t CellGrid::hashOf(const glm::dvec3& cell) { return hashOfBits(cell); }

void CellGrid::insert(const glm::dvec3& place, std::uint32_t item) {
    const std::uint64_t hash = hashOf(cellAt(place));
    occupied_[(hash >> 6U) & (occupied_.size() - 1)] |= std::uint64_t{1} << (hash & 63U);
    std::uint32_t& head = heads_[bucketOf(hash)];
    entries_.push_back({hash, item, head});
    head = static_cast<std::uint32_t>(entries_.size() - 1);
}

PointClusters::PointClusters(std::size_t expected) : heads_(bucketCount(expected), kNobody) {}

std::optional<std::uint32_t> PointClusters::find(const glm::vec3& point) const {
    std::uint32_t k = heads_[static_cast<std::size_t>(hashOfBits(point)) & (heads_.size() - 1)];
    while (k != kNobody && points_[k] != point) k = next_[k];
    return k == kNobody ? std::nullopt : std::optional(k);
}

std::uint32_t PointClusters::add(const glm::vec3& point, double tolerance) {
    const glm::vec3 positive = point + 0.0F;
    const auto reach = static_cast<float>(tolerance);
    if (const auto known = find(positive)) {
        tolerances_[*known] = std::max(tolerances_[*known], reach);
        return *known;
    }
    const auto number = static_cast<std::uint32_t>(points_.size());
    std::uint32_t& head = heads_[static_cast<std::size_t>(hashOfBits(positive)) & (heads_.size() - 1)];
    points_.push_back(positive);
    tolerances_.push_back(reach);
    next_.push_back(head);
    head = number;
    return number;
}

void PointClusters::makeLevels() {
    std::unordered_map<int, std::size_t> counts;
    std::vector<int> order;
    for (const float tolerance : tolerances_) {
        if (tolerance > 0.0F && counts[exponentAbove(tolerance)]++ == 0) order.push_back(exponentAbove(tolerance));
    }
    for (const int exponent : order) levels_.push_back({exponent, CellGrid(std::ldexp(kCellSize, exponent), counts[exponent])});
}

// Calls visit(leader) for every leader so far within tolerance of the point.
template <typename Visit>
void PointClusters::visitLeaders(std::uint32_t number, Visit visit) const {
    const glm::dvec3 place = points_[number];
    const auto own = static_cast<double>(tolerances_[number]);
    for (const Level& level : levels_) {
        level.grid.visitNear(place, std::min(own, std::ldexp(1.0, level.exponent)), [&](std::uint32_t other) {
            const double reach = std::min(own, static_cast<double>(tolerances_[other]));
            const glm::dvec3 apart = glm::dvec3(points_[other]) - place;
            if (glm::dot(apart, apart) <= reach * reach) visit(other);
            return true;
        });
    }
}

// Returns the points that follow another.
std::vector<std::uint32_t> PointClusters::chooseLeaders() {
    std::vector<std::uint32_t> followers;
    for (std::uint32_t k = 0; k < points_.size(); ++k) {
        if (!(tolerances_[k] > 0.0F)) continue;
        std::uint32_t first = k;
        visitLeaders(k, [&](std::uint32_t other) { first = std::min(first, other); });
        leader_[k] = first;
        if (first != k) {
            followers.push_back(k);
            continue;
        }
        const int exponent = exponentAbove(tolerances_[k]);
        const auto level = std::find_if(levels_.begin(), levels_.end(), [&](const Level& one) { return one.exponent == exponent; });
        level->grid.insert(points_[k], k);
    }
    return followers;
}

std::uint32_t PointClusters::root(std::uint32_t leader) {
    while (parent_[leader] != leader) leader = parent_[leader] = parent_[parent_[leader]];
    return leader;
}

void PointClusters::unite(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    parent_[std::max(a, b)] = std::min(a, b);
    united_ = true;
}

// Chains of points would draw together what is far apart.
void PointClusters::keepNarrowUnions() {
    struct Extent {
        glm::dvec3 lower{std::numeric_limits<double>::infinity()};
        glm::dvec3 upper{-std::numeric_limits<double>::infinity()};
        double tolerance = 0.0;
        bool many = false;
    };
    std::unordered_map<std::uint32_t, Extent> extents;
    for (std::uint32_t k = 0; k < points_.size(); ++k) {
        if (leader_[k] == k && root(k) != k) extents[root(k)].many = true;
    }
    const auto extentOf = [&](std::uint32_t k) { return extents.find(root(leader_[k])); };
    for (std::uint32_t k = 0; k < points_.size(); ++k) {
        const auto extent = extentOf(k);
        if (extent == extents.end()) continue;
        extent->second.lower = glm::min(extent->second.lower, glm::dvec3(points_[k]));
        extent->second.upper = glm::max(extent->second.upper, glm::dvec3(points_[k]));
        extent->second.tolerance = std::max(extent->second.tolerance, static_cast<double>(tolerances_[k]));
    }
    for (std::uint32_t k = 0; k < points_.size(); ++k) {
        const auto extent = extentOf(k);
        if (extent == extents.end()) continue;
        const Extent& box = extent->second;
        if (glm::distance(box.lower, box.upper) <= kWidestCluster * box.tolerance) cluster_[k] = extent->first;
    }
}

void PointClusters::settle() {
    makeLevels();
    leader_.resize(points_.size());
    std::iota(leader_.begin(), leader_.end(), 0U);
    parent_ = leader_;
    // A follower may lie near leaders that came after it.
    for (const std::uint32_t follower : chooseLeaders()) {
        visitLeaders(follower, [&](std::uint32_t other) { unite(leader_[follower], other); });
    }
    cluster_ = leader_;
    if (united_) keepNarrowUnions();
}

std::optional<std::uint32_t> PointClusters::nearest(const glm::dvec3& place, double radius) const {
    if (const glm::vec3 rounded(place); glm::dvec3(rounded) == place) {
        if (const auto known = find(rounded + 0.0F)) return cluster_[*known];
    }
    std::uint32_t best = kNobody;
    double least = radius * radius;
    for (const Level& level : levels_) {
        level.grid.visitNear(place, std::min(radius, std::ldexp(1.0, level.exponent)), [&](std::uint32_t other) {
            const glm::dvec3 apart = glm::dvec3(points_[other]) - place;
            const double squared = glm::dot(apart, apart);
            if (squared < least || (squared == least && other < best)) {
                least = squared;
                best = other;
            }
            return true;
        });
    }
    return best == kNobody ? std::nullopt : std::optional(cluster_[best]);
}

}  // namespace tessera::welding
