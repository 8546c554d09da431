// The benchmark's cage: the same for the same number of faces.
#include <algorithm>
#include <array>
#include <random>

#include "table_bench.h"

namespace tessera::bench {
namespace {

constexpr std::uint32_t mostValence = 6;

Cage cube() {
    Cage cage;
    cage.name = "extruded boxes";
    for (int k = 0; k < 8; ++k) cage.points.emplace_back((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
    cage.faceSizes.assign(6, 4);
    cage.faceVertices = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    return cage;
}

}  // namespace

Cage extrudedBoxes(std::size_t faces) {
    Cage cage = cube();
    std::mt19937 random(1);
    std::vector<std::uint32_t> valence(8, 3);
    while (cage.faceCount() < faces) {
        const std::size_t face = random() % cage.faceCount();
        std::array<std::uint32_t, 4> base{}, top{};
        std::copy_n(cage.faceVertices.begin() + static_cast<std::ptrdiff_t>(4 * face), 4, base.begin());
        if (std::any_of(base.begin(), base.end(), [&](std::uint32_t v) { return valence[v] >= mostValence; })) continue;
        const auto at = [&](std::size_t k) { return cage.points[base[k]]; };
        const glm::vec3 middle = 0.25F * (at(0) + at(1) + at(2) + at(3)), across = glm::cross(at(2) - at(0), at(3) - at(1));
        const float size = 0.5F * (glm::length(at(2) - at(0)) + glm::length(at(3) - at(1)));
        for (std::size_t k = 0; k < 4; ++k) {
            top[k] = static_cast<std::uint32_t>(cage.points.size());
            cage.points.push_back(middle + 0.8F * (at(k) - middle) + 0.5F * size * glm::normalize(across));
            valence.push_back(3);
            ++valence[base[k]];
        }
        std::copy(top.begin(), top.end(), cage.faceVertices.begin() + static_cast<std::ptrdiff_t>(4 * face));
        for (std::size_t k = 0; k < 4; ++k) {
            cage.faceSizes.push_back(4);
            cage.faceVertices.insert(cage.faceVertices.end(), {base[k], base[(k + 1) % 4], top[(k + 1) % 4], top[k]});
        }
    }
    return cage;
}

}  // namespace tessera::bench
