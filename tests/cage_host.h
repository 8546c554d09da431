// Cages for tests, and what to ask of clean ones.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "tessera/cage.h"

namespace tessera::test {

inline void addFace(Cage& cage, const std::vector<std::uint32_t>& corners) {
    cage.faceSizes.push_back(static_cast<std::uint32_t>(corners.size()));
    cage.faceVertices.insert(cage.faceVertices.end(), corners.begin(), corners.end());
}

inline Cage cageOf(std::vector<glm::vec3> points, std::initializer_list<std::vector<std::uint32_t>> faces) {
    Cage cage;
    cage.name = "cage";
    cage.points = std::move(points);
    for (const std::vector<std::uint32_t>& face : faces) addFace(cage, face);
    return cage;
}

// Corner (x, y, z) is number x + 2 y + 4 z.
inline Cage cubeCage() {
    std::vector<glm::vec3> points;
    points.reserve(8);
    for (int k = 0; k < 8; ++k) points.emplace_back(k % 2, k / 2 % 2, k / 4);
    return cageOf(std::move(points), {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
}

// Places no two of which are the same, on a sphere.
inline std::vector<glm::vec3> scatteredPoints(std::size_t count) {
    std::vector<glm::vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const float z = 1.0F - 2.0F * (static_cast<float>(i) + 0.5F) / static_cast<float>(count), turn = 2.4F * static_cast<float>(i);
        points.emplace_back(std::sqrt(1.0F - z * z) * glm::vec2(std::cos(turn), std::sin(turn)), z);
    }
    return points;
}

// A closed fan of `count` triangles around vertex 0.
inline Cage wheelCage(std::uint32_t count) {
    Cage cage = cageOf({glm::vec3(0.0F, 0.0F, 1.0F)}, {});
    for (std::uint32_t k = 0; k < count; ++k) {
        const float angle = 6.2831853F * static_cast<float>(k) / static_cast<float>(count);
        cage.points.emplace_back(std::cos(angle), std::sin(angle), 0.0F);
        addFace(cage, {0, 1 + k, 1 + (k + 1) % count});
    }
    return cage;
}

// A strip of `count` quadrilaterals, twisted once where it closes.
inline Cage moebiusCage(std::uint32_t count) {
    Cage cage = cageOf(scatteredPoints(2 * static_cast<std::size_t>(count)), {});
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t a = 2 * k, b = a + 1;
        if (k + 1 < count) {
            addFace(cage, {a, a + 2, b + 2, b});
        } else {
            addFace(cage, {a, 1, 0, b});
        }
    }
    return cage;
}

// Few vertices make for much that is wrong.
inline Cage randomCage(std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::uint32_t count) { return static_cast<std::uint32_t>(random() % count); };
    const std::uint32_t vertices = 3 + below(seed % 3 == 0 ? 6 : 40);
    Cage cage = cageOf(scatteredPoints(vertices), {});
    cage.scheme = seed % 4 == 0 ? SubdivisionScheme::bilinear : SubdivisionScheme::catmullClark;
    cage.boundary = BoundaryRule{seed % 3};
    if (seed % 7 == 0) cage.points[below(vertices)].y = std::numeric_limits<float>::infinity();
    for (std::uint32_t faces = below(60); faces > 0; --faces) {
        std::vector<std::uint32_t> corners(seed % 2 == 0 ? 3 + below(2) : below(8));
        for (std::uint32_t& corner : corners) corner = below(vertices + (below(40) == 0 ? 2 : 0));
        addFace(cage, corners);
    }
    for (std::uint32_t tags = below(30); tags > 0; --tags) {
        cage.creases.push_back({below(vertices), below(vertices + 1), static_cast<float>(below(13)) - 1.0F});
        cage.corners.push_back({below(vertices + 1), static_cast<float>(below(13)) * 0.9F});
        cage.holes.push_back(below(70));
    }
    if (seed % 5 == 0) {
        cage.texturePoints.resize(1 + below(50));
        for (glm::vec2& value : cage.texturePoints) value = glm::vec2(static_cast<float>(below(9)), static_cast<float>(below(9)));
        for (std::size_t k = 0; k < cage.faceVertices.size(); ++k)
            cage.faceTexturePoints.push_back(below(static_cast<std::uint32_t>(cage.texturePoints.size())));
    }
    return cage;
}

// How often each edge is walked from its first to its second vertex.
using Walks = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

inline Walks walksOf(const Cage& cage) {
    Walks walks;
    std::size_t first = 0;
    for (const std::uint32_t size : cage.faceSizes) {
        for (std::size_t k = 0; k < size; ++k) ++walks[{cage.faceVertices[first + k], cage.faceVertices[first + (k + 1) % size]}];
        first += size;
    }
    return walks;
}

// No edge walked twice the same way, so of two faces at most, that agree; faces of three corners or more, no corner twice.
inline bool isOrientedSurface(const Cage& cage) {
    std::size_t first = 0;
    for (const std::uint32_t size : cage.faceSizes) {
        const auto begin = cage.faceVertices.begin() + static_cast<std::ptrdiff_t>(first);
        if (size < 3 || std::set<std::uint32_t>(begin, begin + size).size() != size) return false;
        first += size;
    }
    const Walks walks = walksOf(cage);
    return std::all_of(walks.begin(), walks.end(), [](const auto& walk) { return walk.second == 1; });
}

inline std::size_t boundaryEdges(const Cage& cage) {
    const Walks walks = walksOf(cage);
    return static_cast<std::size_t>(std::count_if(walks.begin(), walks.end(), [&](const auto& walk) {
        return !walks.contains({walk.first.second, walk.first.first});
    }));
}

// The faces around each vertex form one fan: reached from one another over edges that end there.
inline bool hasOneFanAVertex(const Cage& cage) {
    // At each vertex, from the vertex before it in a face to the vertex after it.
    std::vector<std::map<std::uint32_t, std::uint32_t>> around(cage.points.size());
    std::size_t first = 0;
    for (const std::uint32_t size : cage.faceSizes) {
        for (std::size_t k = 0; k < size; ++k) {
            const auto at = [&](std::size_t corner) { return cage.faceVertices[first + corner % size]; };
            around[at(k)][at(k + 1)] = at(k + size - 1);
        }
        first += size;
    }
    return std::all_of(around.begin(), around.end(), [](const auto& fan) {
        if (fan.empty()) return false;
        // Begin where nothing leads to, if anywhere.
        std::set<std::uint32_t> targets;
        for (const auto& [from, to] : fan) targets.insert(to);
        std::uint32_t at = fan.begin()->first;
        for (const auto& [from, to] : fan) at = targets.contains(from) ? at : from;
        std::size_t walked = 0;
        for (auto found = fan.find(at); found != fan.end() && walked < fan.size(); found = fan.find(found->second)) ++walked;
        return walked == fan.size();
    });
}

}  // namespace tessera::test
