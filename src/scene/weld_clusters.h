// Which points are the same within a tolerance: found on a grid, in time that grows with their number however they lie.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace tessera::welding {

// Items in cells of one size, found again by the places near which they are.
class CellGrid {
public:
    // `cell` above 0, at least twice the greatest radius asked for; `expected` items keep look-ups short.
    CellGrid(double cell, std::size_t expected);

    void insert(const glm::dvec3& place, std::uint32_t item);

    // Calls visit(item) for every item within `radius` of `place`, and for others: the visitor measures. Each comes once.
    // A cell is left when visit returns false.
    template <typename Visit>
    void visitNear(const glm::dvec3& place, double radius, Visit visit) const;

private:
    static constexpr std::uint32_t kEnd = ~std::uint32_t{0};
    struct Entry {
        std::uint64_t cell;  // its hash: others share the bucket
        std::uint32_t item;
        std::uint32_t next;
    };

    // Off the origin, where models have their planes of symmetry: what lies in a wall between cells is sought in both.
    [[nodiscard]] glm::dvec3 cellAt(const glm::dvec3& place) const { return glm::floor(place * perCell_ + 0.37) + 0.0; }
    [[nodiscard]] static std::uint64_t hashOf(const glm::dvec3& cell);
    [[nodiscard]] std::size_t bucketOf(std::uint64_t hash) const { return static_cast<std::size_t>(hash) & (heads_.size() - 1); }
    [[nodiscard]] bool maybeOccupied(std::uint64_t hash) const {
        return (occupied_[(hash >> 6U) & (occupied_.size() - 1)] >> (hash & 63U) & 1U) != 0;
    }

    double perCell_;
    std::vector<std::uint64_t> occupied_;  // a bit for many cells: small enough for a cache, and most look-ups end there
    std::vector<std::uint32_t> heads_;
    std::vector<Entry> entries_;
};

// Points fed one by one, then put into clusters. Equal points (-0 and +0 are equal) are one from the start. Every other point joins the
// first that came before it within tolerance and that itself joined none (its leader). Leaders with a common point within tolerance
// become one cluster, unless that would be wider than four tolerances: then every leader keeps its own. So a pair within tolerance is in
// one cluster except in chains of points; and what comes out depends on the points and their order alone.
class PointClusters {
public:
    explicit PointClusters(std::size_t expected);

    // The number of the point, that of the first equal one. Points within the lesser of their tolerances (0 or more) are the same;
    // equal points take the greatest of theirs.
    [[nodiscard]] std::uint32_t add(const glm::vec3& point, double tolerance);

    void settle();  // once, after the last add

    [[nodiscard]] std::size_t size() const { return points_.size(); }
    // With +0 for -0.
    [[nodiscard]] const glm::vec3& point(std::uint32_t number) const { return points_[number]; }
    // The number of the cluster's first point, which speaks for all.
    [[nodiscard]] std::uint32_t cluster(std::uint32_t number) const { return cluster_[number]; }
    // The cluster of the nearest leader within `radius`, at most the greatest tolerance; of equals the first.
    [[nodiscard]] std::optional<std::uint32_t> nearest(const glm::dvec3& place, double radius) const;

private:
    struct Level {
        int exponent;  // of two, above the tolerances of its points
        CellGrid grid;
    };

    [[nodiscard]] std::optional<std::uint32_t> find(const glm::vec3& point) const;
    void makeLevels();
    template <typename Visit>
    void visitLeaders(std::uint32_t number, Visit visit) const;
    [[nodiscard]] std::vector<std::uint32_t> chooseLeaders();
    [[nodiscard]] std::uint32_t root(std::uint32_t leader);
    void unite(std::uint32_t a, std::uint32_t b);
    void keepNarrowUnions();

    std::vector<glm::vec3> points_;
    std::vector<float> tolerances_;
    std::vector<std::uint32_t> heads_;  // equal points, by hash
    std::vector<std::uint32_t> next_;
    std::vector<Level> levels_;
    std::vector<std::uint32_t> leader_;
    std::vector<std::uint32_t> parent_;  // of leaders
    std::vector<std::uint32_t> cluster_;
    bool united_ = false;
};

template <typename Visit>
void CellGrid::visitNear(const glm::dvec3& place, double radius, Visit visit) const {
    // Far from the origin neighbouring cells may be one number: no counting from low to high.
    const std::array<glm::dvec3, 2> corners{cellAt(place - radius), cellAt(place + radius)};
    std::array<std::uint64_t, 8> seen{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 8; ++k) {
        const std::array<std::size_t, 3> side{k & 1U, (k >> 1U) & 1U, k >> 2U};
        bool again = false;
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            again = again || (side[static_cast<std::size_t>(axis)] == 1 && corners[1][axis] == corners[0][axis]);
        }
        if (again) continue;
        const std::uint64_t hash = hashOf({corners[side[0]].x, corners[side[1]].y, corners[side[2]].z});
        const auto end = seen.begin() + static_cast<std::ptrdiff_t>(count);
        if (!maybeOccupied(hash) || std::find(seen.begin(), end, hash) != end) continue;
        seen[count++] = hash;
        for (std::uint32_t e = heads_[bucketOf(hash)]; e != kEnd; e = entries_[e].next) {
            if (entries_[e].cell == hash && !visit(entries_[e].item)) break;
        }
    }
}

}  // namespace tessera::welding
