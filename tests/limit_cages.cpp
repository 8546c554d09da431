// Cages made by hand.
#include "limit_cages.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <set>
#include <utility>

namespace tessera::test {
namespace {

void addFace(Cage& cage, std::initializer_list<std::uint32_t> corners) {
    cage.faceSizes.push_back(static_cast<std::uint32_t>(corners.size()));
    cage.faceVertices.insert(cage.faceVertices.end(), corners);
}

float angle(std::uint32_t k, std::uint32_t count) { return 6.2831853F * static_cast<float>(k) / static_cast<float>(count); }

Cage creased(Cage cage, std::vector<Crease> creases, std::vector<Corner> corners = {}) {
    cage.creases = std::move(creases);
    cage.corners = std::move(corners);
    return cage;
}

// A grid that is not flat, cut open or not at nothing.
Cage hills(std::uint32_t width, std::uint32_t height) {
    Cage cage = gridCage(width, height);
    for (glm::vec3& p : cage.points) p.z = 0.4F * std::sin(1.7F * p.x + 0.3F) * std::cos(2.1F * p.y);
    return cage;
}

}  // namespace

Cage cubeCage() {
    Cage cage;
    cage.name = "cube";
    for (std::uint32_t k = 0; k < 8; ++k)
        cage.points.emplace_back((k & 1U) != 0 ? 1.0F : -1.0F, (k & 2U) != 0 ? 1.0F : -1.0F, (k & 4U) != 0 ? 1.0F : -1.0F);
    addFace(cage, {0, 2, 3, 1});
    addFace(cage, {4, 5, 7, 6});
    addFace(cage, {0, 1, 5, 4});
    addFace(cage, {2, 6, 7, 3});
    addFace(cage, {0, 4, 6, 2});
    addFace(cage, {1, 3, 7, 5});
    return cage;
}

Cage torusCage(std::uint32_t around, std::uint32_t across) {
    Cage cage;
    cage.name = "torus";
    for (std::uint32_t i = 0; i < around; ++i) {
        for (std::uint32_t j = 0; j < across; ++j) {
            const float a = angle(i, around), b = angle(j, across), r = 2.0F + 0.7F * std::cos(b);
            cage.points.emplace_back(r * std::cos(a), r * std::sin(a), 0.7F * std::sin(b));
        }
    }
    for (std::uint32_t i = 0; i < around; ++i) {
        for (std::uint32_t j = 0; j < across; ++j) {
            const std::uint32_t k = (i + 1) % around, l = (j + 1) % across;
            addFace(cage, {i * across + j, k * across + j, k * across + l, i * across + l});
        }
    }
    return cage;
}

Cage gridCage(std::uint32_t width, std::uint32_t height) {
    Cage cage;
    cage.name = "grid";
    for (std::uint32_t j = 0; j <= height; ++j)
        for (std::uint32_t i = 0; i <= width; ++i) cage.points.emplace_back(static_cast<float>(i), static_cast<float>(j), 0.0F);
    const std::uint32_t row = width + 1;
    for (std::uint32_t j = 0; j < height; ++j)
        for (std::uint32_t i = 0; i < width; ++i) addFace(cage, {j * row + i, j * row + i + 1, (j + 1) * row + i + 1, (j + 1) * row + i});
    return cage;
}

Cage fanCage(std::uint32_t valence) {
    Cage cage;
    cage.name = "fan of " + std::to_string(valence);
    cage.points.emplace_back(0.0F, 0.0F, 0.8F);
    const std::uint32_t n = 2 * valence;
    // Rings of two vertices a face, at radii 1 and 2.
    for (std::uint32_t ring = 1; ring <= 2; ++ring) {
        for (std::uint32_t k = 0; k < n; ++k) {
            const auto r = static_cast<float>(ring);
            cage.points.emplace_back(r * std::cos(angle(k, n)), r * std::sin(angle(k, n)), 0.3F * std::sin(r * static_cast<float>(k)));
        }
    }
    const auto at = [n](std::uint32_t ring, std::uint32_t k) { return 1 + (ring - 1) * n + k % n; };
    for (std::uint32_t k = 0; k < n; k += 2) addFace(cage, {0, at(1, k), at(1, k + 1), at(1, k + 2)});
    for (std::uint32_t k = 0; k < n; ++k) addFace(cage, {at(1, k), at(2, k), at(2, k + 1), at(1, k + 1)});
    return cage;
}

Cage prismCage(std::uint32_t sides) {
    Cage cage;
    cage.name = "prism of " + std::to_string(sides);
    for (const float z : {-1.0F, 1.0F})
        for (std::uint32_t k = 0; k < sides; ++k) cage.points.emplace_back(std::cos(angle(k, sides)), std::sin(angle(k, sides)), z);
    cage.faceSizes = {sides, sides};
    for (std::uint32_t k = 0; k < sides; ++k) cage.faceVertices.push_back(sides - 1 - k);
    for (std::uint32_t k = 0; k < sides; ++k) cage.faceVertices.push_back(sides + k);
    for (std::uint32_t k = 0; k < sides; ++k) {
        const std::uint32_t l = (k + 1) % sides;
        addFace(cage, {k, l, sides + l, sides + k});
    }
    return cage;
}

Cage unfoldedCube() {
    Cage cage = cubeCage();
    // Four faces in a row around z, the lower and the upper one beside the second. Texture points: a row of five below, one of five above.
    cage.faceSizes.clear();
    cage.faceVertices.clear();
    addFace(cage, {0, 1, 5, 4});
    addFace(cage, {1, 3, 7, 5});
    addFace(cage, {3, 2, 6, 7});
    addFace(cage, {2, 0, 4, 6});
    addFace(cage, {0, 2, 3, 1});
    addFace(cage, {4, 5, 7, 6});
    for (const float v : {0.35F, 0.6F})
        for (std::uint32_t k = 0; k <= 4; ++k) cage.texturePoints.emplace_back(0.25F * static_cast<float>(k), v);
    cage.texturePoints.insert(cage.texturePoints.end(), {{0.25F, 0.1F}, {0.5F, 0.1F}, {0.25F, 0.85F}, {0.5F, 0.85F}});
    for (std::uint32_t k = 0; k < 4; ++k)
        for (const std::uint32_t corner : {k, k + 1, k + 6, k + 5}) cage.faceTexturePoints.push_back(corner);
    // Below, 1 to 3 is the edge from texture point 1 to 2; above, 5 to 7 that from 6 to 7.
    for (const std::uint32_t corner : {10U, 11U, 2U, 1U, 12U, 6U, 7U, 13U}) cage.faceTexturePoints.push_back(corner);
    return cage;
}

Cage randomCage(std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto chance = [&](double p) { return std::uniform_real_distribution<double>(0, 1)(random) < p; };
    const auto sharpness = [&] { return chance(0.3) ? 10.0F : std::uniform_real_distribution<float>(0.0F, 10.0F)(random); };
    constexpr std::uint32_t around = 9, across = 7;
    Cage cage = torusCage(around, across);
    cage.name = "random " + std::to_string(seed);
    std::uniform_real_distribution<float> noise(-0.15F, 0.15F);
    for (glm::vec3& p : cage.points) p += glm::vec3(noise(random), noise(random), noise(random));
    // Faces take their neighbour across the third edge now and then; edges between are gone.
    std::set<std::uint32_t> gone;
    const std::vector<std::uint32_t> quads = std::move(cage.faceVertices);
    cage.faceSizes.clear();
    cage.faceVertices.clear();
    for (std::uint32_t i = 0; i < around; ++i) {
        for (std::uint32_t j = 0; j < across; ++j) {
            const std::uint32_t* const q = quads.data() + 4 * (i * across + j);
            if (j % 2 == 0 && j + 1 < across && chance(0.1)) {
                const std::uint32_t* const next = q + 4;
                addFace(cage, {q[0], q[1], next[1], next[2], next[3], q[3]});
                gone.insert(i * across + ++j);
            } else {
                addFace(cage, {q[0], q[1], q[2], q[3]});
            }
        }
    }
    for (std::uint32_t i = 0; i < around; ++i) {
        for (std::uint32_t j = 0; j < across; ++j) {
            if (chance(0.15) && !gone.contains(i * across + j))
                cage.creases.push_back({i * across + j, (i + 1) % around * across + j, sharpness()});
            if (chance(0.08)) cage.corners.push_back({i * across + j, sharpness()});
        }
    }
    for (std::uint32_t face = 0; face < cage.faceSizes.size(); ++face)
        if (chance(0.05)) cage.holes.push_back(face);
    return cage;
}

std::vector<NamedCage> limitCages() {
    std::vector<NamedCage> cages;
    const auto add = [&](const std::string& name, const Cage& cage) { cages.push_back({name, cage}); };
    add("cube", cubeCage());
    add("torus", torusCage(6, 5));
    add("boundaries", hills(4, 3));
    for (std::uint32_t valence = 3; valence <= 12; ++valence) add("fan " + std::to_string(valence), fanCage(valence));
    Cage edgeOnly = hills(3, 3);
    edgeOnly.boundary = BoundaryRule::edgeOnly;
    add("smooth corners", edgeOnly);
    add("crease around", creased(cubeCage(), {{4, 5}, {5, 7}, {7, 6}, {6, 4}}));
    add("dart", creased(cubeCage(), {{4, 5}}));
    add("all edges of a corner", creased(cubeCage(), {{0, 1}, {0, 2}, {0, 4}}));
    add("sharp vertex", creased(fanCage(5), {}, {{0, 10.0F}}));
    add("crease through a fan", creased(fanCage(6), {{0, 1}, {0, 5}}));
    add("crease across a torus", creased(torusCage(6, 5), {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}}));
    for (const float sharpness : {0.5F, 1.0F, 2.3F, 4.0F})
        add("crease of " + std::to_string(sharpness), creased(cubeCage(), {{4, 5, sharpness}, {5, 7, sharpness}, {7, 6, sharpness}}));
    add("semi-sharp vertex", creased(fanCage(5), {}, {{0, 1.5F}}));
    for (const std::uint32_t sides : {3U, 5U, 8U}) add("prism " + std::to_string(sides), prismCage(sides));
    add("creased prism", creased(prismCage(5), {{0, 1}, {1, 2, 1.5F}}));
    Cage hole = hills(4, 4);
    hole.holes = {5};
    add("hole", hole);
    return cages;
}

}  // namespace tessera::test
