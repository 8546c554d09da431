// Cages made by rule, or by a seed.
#include "table_cages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

namespace tessera::test {
namespace {

void addFace(Cage& cage, std::initializer_list<std::uint32_t> corners) {
    cage.faceSizes.push_back(static_cast<std::uint32_t>(corners.size()));
    cage.faceVertices.insert(cage.faceVertices.end(), corners);
}

glm::vec3 onCircle(double angle, double radius, double height) {
    return {static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle)), static_cast<float>(height)};
}

double turn(std::uint32_t k, std::uint32_t n) { return 2.0 * std::numbers::pi * k / n; }

}  // namespace

Cage cubeCage() {
    Cage cage;
    cage.name = "cube";
    for (int k = 0; k < 8; ++k) cage.points.emplace_back((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
    addFace(cage, {0, 2, 3, 1});
    addFace(cage, {4, 5, 7, 6});
    addFace(cage, {0, 1, 5, 4});
    addFace(cage, {2, 6, 7, 3});
    addFace(cage, {0, 4, 6, 2});
    addFace(cage, {1, 3, 7, 5});
    return cage;
}

Cage torusCage(std::uint32_t columns, std::uint32_t rows) {
    Cage cage;
    cage.name = "torus";
    for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t i = 0; i < columns; ++i)
            cage.points.push_back(onCircle(turn(i, columns), 2.0 + std::cos(turn(j, rows)), std::sin(turn(j, rows))));
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return (j % rows) * columns + i % columns; };
    for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t i = 0; i < columns; ++i) addFace(cage, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    return cage;
}

Cage fanCage(std::uint32_t valence) {
    Cage cage;
    cage.name = "fan";
    const std::uint32_t around = 2 * valence;
    cage.points.emplace_back(0, 0, 1);
    for (std::uint32_t ring = 1; ring <= 2; ++ring)
        for (std::uint32_t k = 0; k < around; ++k) cage.points.push_back(onCircle(turn(k, around), ring, 0.1 * (k % 3)));
    const auto at = [&](std::uint32_t ring, std::uint32_t k) { return 1 + (ring - 1) * around + k % around; };
    for (std::uint32_t k = 0; k < around; k += 2) addFace(cage, {0, at(1, k), at(1, k + 1), at(1, k + 2)});
    for (std::uint32_t k = 0; k < around; ++k) addFace(cage, {at(1, k), at(2, k), at(2, k + 1), at(1, k + 1)});
    return cage;
}

Cage lensCage(std::uint32_t valence) {
    Cage cage;
    cage.name = "lens";
    const std::uint32_t around = 2 * valence;
    cage.points.emplace_back(0, 0, 1);
    cage.points.emplace_back(0, 0, -1);
    for (std::uint32_t k = 0; k < around; ++k) cage.points.push_back(onCircle(turn(k, around), 2, 0.1 * (k % 3)));
    const auto at = [&](std::uint32_t k) { return 2 + k % around; };
    for (std::uint32_t k = 0; k < around; k += 2) {
        addFace(cage, {0, at(k), at(k + 1), at(k + 2)});
        addFace(cage, {1, at(k + 2), at(k + 1), at(k)});
    }
    return cage;
}

Cage prismCage(std::uint32_t sides) {
    Cage cage;
    cage.name = "prism";
    for (std::uint32_t end = 0; end < 2; ++end)
        for (std::uint32_t k = 0; k < sides; ++k) cage.points.push_back(onCircle(turn(k, sides), 1, end));
    for (std::uint32_t k = 0; k < sides; ++k) addFace(cage, {k, (k + 1) % sides, sides + (k + 1) % sides, sides + k});
    cage.faceSizes.insert(cage.faceSizes.end(), {sides, sides});
    for (std::uint32_t k = 0; k < sides; ++k) cage.faceVertices.push_back(sides - 1 - k);
    for (std::uint32_t k = 0; k < sides; ++k) cage.faceVertices.push_back(sides + k);
    return cage;
}

Cage extrudedCage(std::uint32_t steps, std::uint32_t seed) {
    Cage cage = cubeCage();
    cage.name = "extruded";
    std::mt19937 random(seed);
    for (std::uint32_t step = 0; step < steps; ++step) {
        const std::size_t face = random() % cage.faceCount();
        std::array<std::uint32_t, 4> base{}, top{};
        for (std::size_t k = 0; k < 4; ++k) base[k] = cage.faceVertices[4 * face + k];
        const glm::vec3 a = cage.points[base[0]], b = cage.points[base[1]], c = cage.points[base[2]], d = cage.points[base[3]];
        const glm::vec3 across = glm::cross(c - a, d - b), middle = 0.25F * (a + b + c + d);
        const float size = 0.5F * (glm::length(c - a) + glm::length(d - b));
        for (std::size_t k = 0; k < 4; ++k) {
            top[k] = static_cast<std::uint32_t>(cage.points.size());
            const glm::vec3 p = cage.points[base[k]];
            cage.points.push_back(middle + 0.8F * (p - middle) + 0.5F * size * glm::normalize(across));
        }
        for (std::size_t k = 0; k < 4; ++k) cage.faceVertices[4 * face + k] = top[k];
        for (std::size_t k = 0; k < 4; ++k) addFace(cage, {base[k], base[(k + 1) % 4], top[(k + 1) % 4], top[k]});
    }
    return cage;
}

namespace {

using Edge = std::array<std::uint32_t, 2>;

// Takes out faces none of whose vertices has lost one: what stays is manifold.
void openFaces(Cage& cage, std::mt19937& random) {
    std::set<std::uint32_t> touched;
    Cage kept = cage;
    kept.faceSizes.clear();
    kept.faceVertices.clear();
    std::size_t first = 0;
    for (const std::uint32_t size : cage.faceSizes) {
        const auto begin = cage.faceVertices.begin() + static_cast<std::ptrdiff_t>(first), end = begin + size;
        const bool free = std::none_of(begin, end, [&](std::uint32_t v) { return touched.contains(v); });
        if (free && random() % 3 == 0) {
            touched.insert(begin, end);
        } else {
            kept.faceSizes.push_back(size);
            kept.faceVertices.insert(kept.faceVertices.end(), begin, end);
        }
        first += size;
    }
    const std::set<std::uint32_t> used(kept.faceVertices.begin(), kept.faceVertices.end());
    if (used.size() == cage.points.size()) cage = kept;
}

float randomSharpness(std::mt19937& random) {
    switch (random() % 4) {
        case 0:
            return 10.0F;
        case 1:
            return static_cast<float>(1 + random() % 9);
        default:
            return static_cast<float>(1 + random() % 999) / 100.0F;
    }
}

}  // namespace

void tagAtRandom(Cage& cage, std::uint32_t seed, bool open) {
    std::mt19937 random(seed);
    for (glm::vec3& point : cage.points)
        for (int c = 0; c < 3; ++c) point[c] += static_cast<float>(random() % 1000) / 4000.0F;
    if (open) openFaces(cage, random);
    std::set<Edge> edges;
    std::size_t first = 0;
    for (const std::uint32_t size : cage.faceSizes) {
        for (std::uint32_t k = 0; k < size; ++k) {
            const std::uint32_t a = cage.faceVertices[first + k], b = cage.faceVertices[first + (k + 1) % size];
            if (random() % 8 == 0 && edges.insert({std::min(a, b), std::max(a, b)}).second)
                cage.creases.push_back({a, b, randomSharpness(random)});
        }
        first += size;
    }
    for (std::uint32_t v = 0; v < cage.points.size(); ++v)
        if (random() % 16 == 0) cage.corners.push_back({v, randomSharpness(random)});
}

}  // namespace tessera::test
