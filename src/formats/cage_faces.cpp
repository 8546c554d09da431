// What readers of cages have in common.
#include "formats/cage_faces.h"

#include "scene/text.h"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>

namespace tessera {

namespace {

// Written so that NaN fails.
bool isPlaced(const glm::vec3& p) { return std::abs(p.x) <= 1e9F && std::abs(p.y) <= 1e9F && std::abs(p.z) <= 1e9F; }

// Which faces stay.
std::vector<bool> placedFaces(const Cage& cage) {
    std::vector<bool> stays(cage.faceCount(), true);
    std::size_t corner = 0;
    for (std::size_t face = 0; face < cage.faceCount(); ++face) {
        for (std::uint32_t k = 0; k < cage.faceSizes[face]; ++k, ++corner) {
            if (!isPlaced(cage.points[cage.faceVertices[corner]])) stays[face] = false;
        }
    }
    return stays;
}

void keepFaces(Cage& cage, const std::vector<bool>& stays) {
    std::size_t from = 0, to = 0;
    std::uint32_t faces = 0;
    std::vector<std::uint32_t> numbers(cage.faceCount());
    for (std::size_t face = 0; face < stays.size(); ++face) {
        const std::uint32_t size = cage.faceSizes[face];
        numbers[face] = faces;
        if (stays[face]) {
            cage.faceSizes[faces++] = size;
            for (std::uint32_t k = 0; k < size; ++k, ++to) {
                cage.faceVertices[to] = cage.faceVertices[from + k];
                if (!cage.faceTexturePoints.empty()) cage.faceTexturePoints[to] = cage.faceTexturePoints[from + k];
            }
        }
        from += size;
    }
    std::erase_if(cage.holes, [&](std::uint32_t hole) { return hole < stays.size() && !stays[hole]; });
    for (std::uint32_t& hole : cage.holes) hole = hole < numbers.size() ? numbers[hole] : hole;
    cage.faceSizes.resize(faces);
    cage.faceVertices.resize(to);
    if (!cage.faceTexturePoints.empty()) cage.faceTexturePoints.resize(to);
}

}  // namespace

std::vector<std::uint32_t> numberEqual(std::span<const std::array<std::uint32_t, 3>> keys) {
    std::vector<std::uint32_t> order(keys.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
    // The first of each run stands for all of it.
    std::vector<std::uint32_t> numbers(keys.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && keys[order[i]] == keys[order[i - 1]];
        numbers[order[i]] = same ? numbers[order[i - 1]] : order[i];
    }
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = numbers[i] == i ? next++ : numbers[numbers[i]];
    return numbers;
}

std::vector<std::uint32_t> renumber(std::vector<std::uint32_t>& used) {
    std::vector<std::uint32_t> numbers = used;
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    for (std::uint32_t& one : used) {
        one = static_cast<std::uint32_t>(std::lower_bound(numbers.begin(), numbers.end(), one) - numbers.begin());
    }
    return numbers;
}

void turnFaces(Cage& cage) {
    std::size_t first = 0;
    for (const std::uint32_t size : cage.faceSizes) {
        for (std::vector<std::uint32_t>* const list : {&cage.faceVertices, &cage.faceTexturePoints}) {
            if (size < 2 || list->empty()) continue;
            const auto begin = list->begin() + static_cast<std::ptrdiff_t>(first);
            std::reverse(begin + 1, begin + static_cast<std::ptrdiff_t>(size));
        }
        first += size;
    }
}

void dropUnplacedFaces(Cage& cage, const MeshNotes& notes) {
    const std::vector<bool> stays = placedFaces(cage);
    const auto dropped = std::count(stays.begin(), stays.end(), false);
    if (dropped > 0) {
        keepFaces(cage, stays);
        notes.warn("mesh " + quotedName(cage.name) +
                   ": faces left out for corners that are not finite or beyond 1e9: " + std::to_string(dropped));
    }
    for (glm::vec3& point : cage.points) {
        if (!isPlaced(point)) point = glm::vec3(0.0F);
    }
    for (glm::vec2& point : cage.texturePoints) {
        if (!std::isfinite(point.x) || !std::isfinite(point.y)) point = glm::vec2(0.0F);
    }
}

}  // namespace tessera
