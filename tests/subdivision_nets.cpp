// Plain nets: points and faces.
#include "subdivision_nets.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace tessera::test {

namespace {

glm::vec3 around(int step, int steps, double radius, double z) {
    const double angle = 2.0 * std::numbers::pi * step / steps;
    return {static_cast<float>(radius * std::cos(angle)), static_cast<float>(radius * std::sin(angle)), static_cast<float>(z)};
}

std::uint32_t number(int k) { return static_cast<std::uint32_t>(k); }

// The faces of a grid whose vertex (x, y) is `at(x, y)`.
template <typename At>
void addQuads(Cage& cage, int columns, int rows, const At& at) {
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) addFace(cage, {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
}

float hills(double x, double y) { return static_cast<float>(0.35 * std::sin(2.3 * x + 0.4) * std::cos(1.7 * y) + 0.1 * x * y); }

// Turns every face so that its outside is away from the origin; of convex nets around it.
void turnOutwards(Cage& cage) {
    std::size_t first = 0;
    for (const std::uint32_t size : cage.faceSizes) {
        const auto at = [&](std::size_t k) { return cage.points[cage.faceVertices[first + k]]; };
        if (glm::dot(glm::cross(at(1) - at(0), at(2) - at(0)), at(0)) < 0.0F) {
            const auto begin = cage.faceVertices.begin() + static_cast<std::ptrdiff_t>(first);
            std::reverse(begin, begin + static_cast<std::ptrdiff_t>(size));
        }
        first += size;
    }
}

}  // namespace

void addFace(Cage& cage, const std::vector<std::uint32_t>& vertices) {
    cage.faceSizes.push_back(static_cast<std::uint32_t>(vertices.size()));
    cage.faceVertices.insert(cage.faceVertices.end(), vertices.begin(), vertices.end());
}

void shake(Cage& cage, float distance, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto amount = [&] { return distance * (static_cast<float>(random() % 2001U) / 1000.0F - 1.0F); };
    for (glm::vec3& point : cage.points) {
        point.x += amount();
        point.y += amount();
        point.z += amount();
    }
}

Cage boxNet() {
    Cage cage;
    for (int k = 0; k < 8; ++k)
        cage.points.emplace_back((k & 1) != 0 ? 1.0F : -1.0F, (k & 2) != 0 ? 0.8F : -0.8F, (k & 4) != 0 ? 0.9F : -0.9F);
    for (const std::vector<std::uint32_t>& face :
         {std::vector<std::uint32_t>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
        addFace(cage, face);
    shake(cage, 0.2F, 1);
    return cage;
}

Cage gridNet(int columns, int rows) {
    Cage cage;
    for (int y = 0; y <= rows; ++y) {
        for (int x = 0; x <= columns; ++x) {
            const double across = 2.0 * x / columns - 1.0, up = 2.0 * y / rows - 1.0;
            cage.points.emplace_back(static_cast<float>(across), static_cast<float>(up), hills(across, up));
        }
    }
    addQuads(cage, columns, rows, [&](int x, int y) { return number(y * (columns + 1) + x); });
    return cage;
}

Cage torusNet(int columns, int rows) {
    Cage cage;
    for (int y = 0; y < rows; ++y) {
        const double angle = 2.0 * std::numbers::pi * y / rows;
        for (int x = 0; x < columns; ++x) cage.points.push_back(around(x, columns, 1.0 + 0.45 * std::cos(angle), 0.45 * std::sin(angle)));
    }
    addQuads(cage, columns, rows, [&](int x, int y) { return number(y % rows * columns + x % columns); });
    shake(cage, 0.04F, 2);
    return cage;
}

Cage fanNet(int sides) {
    Cage cage;
    cage.points.emplace_back(0.05F, -0.1F, 0.4F);
    for (int k = 0; k < 2 * sides; ++k) cage.points.push_back(around(k, 2 * sides, k % 2 == 0 ? 1.0 : 1.3, 0.1 * (k % 3)));
    const auto ring = [&](int k) { return number(1 + k % (2 * sides)); };
    for (int k = 0; k < sides; ++k) addFace(cage, {0, ring(2 * k), ring(2 * k + 1), ring(2 * k + 2)});
    return cage;
}

Cage drumNet(int sides) {
    Cage cage;
    const int n = 2 * sides;
    cage.points.emplace_back(0.05F, 0.0F, 0.8F);
    cage.points.emplace_back(0.0F, 0.04F, -0.7F);
    for (int k = 0; k < n; ++k) cage.points.push_back(around(k, n, 1.0 + 0.1 * (k % 2), 0.4 + 0.05 * (k % 3)));
    for (int k = 0; k < n; ++k) cage.points.push_back(around(k, n, 1.0 - 0.1 * (k % 2), -0.4));
    const auto upper = [&](int k) { return number(2 + k % n); };
    const auto lower = [&](int k) { return number(2 + n + k % n); };
    for (int k = 0; k < sides; ++k) {
        addFace(cage, {0, upper(2 * k), upper(2 * k + 1), upper(2 * k + 2)});
        addFace(cage, {1, lower(2 * k + 2), lower(2 * k + 1), lower(2 * k)});
    }
    for (int k = 0; k < n; ++k) addFace(cage, {lower(k), lower(k + 1), upper(k + 1), upper(k)});
    return cage;
}

Cage prismNet(int sides) {
    Cage cage;
    std::vector<std::uint32_t> top, bottom;
    for (int k = 0; k < sides; ++k) {
        cage.points.push_back(around(k, sides, 1.0, -0.7));
        cage.points.push_back(around(k, sides, 0.8, 0.6));
        bottom.insert(bottom.begin(), number(2 * k));
        top.push_back(number(2 * k + 1));
    }
    addFace(cage, top);
    addFace(cage, bottom);
    for (int k = 0; k < sides; ++k) {
        const int next = (k + 1) % sides;
        addFace(cage, {number(2 * k), number(2 * next), number(2 * next + 1), number(2 * k + 1)});
    }
    shake(cage, 0.05F, 3);
    return cage;
}

Cage pyramidNet(int sides) {
    Cage cage;
    cage.points.emplace_back(0.1F, 0.0F, 1.0F);
    std::vector<std::uint32_t> base;
    for (int k = 0; k < sides; ++k) {
        cage.points.push_back(around(k, sides, 1.0, -0.3));
        base.insert(base.begin(), number(k + 1));
        addFace(cage, {0, number(k + 1), number((k + 1) % sides + 1)});
    }
    addFace(cage, base);
    shake(cage, 0.05F, 4);
    return cage;
}

Cage icosahedronNet() {
    Cage cage;
    const auto golden = static_cast<float>(std::numbers::phi);
    for (const float a : {-1.0F, 1.0F}) {
        for (const float b : {-golden, golden}) {
            cage.points.emplace_back(0.0F, a, b);
            cage.points.emplace_back(a, b, 0.0F);
            cage.points.emplace_back(b, 0.0F, a);
        }
    }
    const auto near = [&](std::uint32_t i, std::uint32_t j) { return glm::distance(cage.points[i], cage.points[j]) < 2.1F; };
    for (std::uint32_t i = 0; i < 12; ++i)
        for (std::uint32_t j = i + 1; j < 12; ++j)
            for (std::uint32_t k = j + 1; k < 12; ++k)
                if (near(i, j) && near(j, k) && near(i, k)) addFace(cage, {i, j, k});
    turnOutwards(cage);
    shake(cage, 0.1F, 5);
    return cage;
}

// The dual: a vertex for each triangle of an icosahedron, a pentagon around each of its vertices.
Cage dodecahedronNet() {
    const Cage dual = icosahedronNet();
    Cage cage;
    for (std::size_t f = 0; f < dual.faceCount(); ++f) {
        glm::vec3 middle(0.0F);
        for (std::size_t k = 0; k < 3; ++k) middle += dual.points[dual.faceVertices[3 * f + k]];
        cage.points.push_back(middle / 3.0F);
    }
    for (std::uint32_t v = 0; v < dual.points.size(); ++v) {
        const glm::vec3 axis = glm::normalize(dual.points[v]);
        const glm::vec3 x = glm::normalize(glm::cross(axis, glm::vec3(0.31F, 0.52F, 0.77F))), y = glm::cross(axis, x);
        std::vector<std::pair<float, std::uint32_t>> ring;
        for (std::uint32_t f = 0; f < dual.faceCount(); ++f) {
            const auto first = dual.faceVertices.begin() + 3 * static_cast<std::ptrdiff_t>(f);
            if (std::find(first, first + 3, v) != first + 3)
                ring.emplace_back(std::atan2(glm::dot(cage.points[f], y), glm::dot(cage.points[f], x)), f);
        }
        std::sort(ring.begin(), ring.end());
        std::vector<std::uint32_t> face;
        face.reserve(ring.size());
        for (const auto& [angle, f] : ring) face.push_back(f);
        addFace(cage, face);
    }
    return cage;
}

Cage cutBoxNet() {
    const Cage box = boxNet();
    Cage cage;
    cage.points = box.points;
    // Vertex 7 becomes three: on its edges to 3, 5 and 6.
    for (const std::size_t other : {3U, 5U, 6U}) cage.points.push_back(0.6F * box.points[7] + 0.4F * box.points[other]);
    cage.points.erase(cage.points.begin() + 7);  // they are 7, 8, 9 now
    for (const std::vector<std::uint32_t>& face :
         {std::vector<std::uint32_t>{0, 2, 3, 1}, {4, 5, 8, 9, 6}, {0, 1, 5, 4}, {2, 6, 9, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 8, 5}, {7, 9, 8}})
        addFace(cage, face);
    return cage;
}

Cage valenceTwoNet() {
    Cage cage = boxNet();
    cage.points.push_back(0.25F * (cage.points[4] + cage.points[5] + cage.points[7] + cage.points[6]) + glm::vec3(0.0F, 0.0F, 0.2F));
    Cage made;
    made.points = cage.points;
    for (const std::vector<std::uint32_t>& face :
         {std::vector<std::uint32_t>{0, 2, 3, 1}, {4, 5, 7, 8}, {4, 8, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
        addFace(made, face);
    return made;
}

Cage cornerNet(int along) {
    const Cage grid = gridNet(2 * along, 2 * along);
    Cage cage;
    std::vector<std::uint32_t> numbers(grid.points.size(), 0xffffffffU);
    for (std::size_t f = 0; f < grid.faceCount(); ++f) {
        const auto x = static_cast<int>(f) % (2 * along), y = static_cast<int>(f) / (2 * along);
        if (x >= along && y >= along) continue;
        std::vector<std::uint32_t> face;
        for (std::size_t k = 0; k < 4; ++k) {
            std::uint32_t& vertex = numbers[grid.faceVertices[4 * f + k]];
            if (vertex == 0xffffffffU) {
                vertex = static_cast<std::uint32_t>(cage.points.size());
                cage.points.push_back(grid.points[grid.faceVertices[4 * f + k]]);
            }
            face.push_back(vertex);
        }
        addFace(cage, face);
    }
    return cage;
}

Cage together(const std::vector<Cage>& cages) {
    Cage all;
    float x = 0.0F;
    for (const Cage& cage : cages) {
        const auto first = static_cast<std::uint32_t>(all.points.size());
        const auto faces = static_cast<std::uint32_t>(all.faceCount());
        for (const glm::vec3& point : cage.points) all.points.push_back(point + glm::vec3(x, 0.0F, 0.0F));
        for (const std::uint32_t vertex : cage.faceVertices) all.faceVertices.push_back(first + vertex);
        all.faceSizes.insert(all.faceSizes.end(), cage.faceSizes.begin(), cage.faceSizes.end());
        for (const Crease& crease : cage.creases) all.creases.push_back({first + crease.a, first + crease.b, crease.sharpness});
        for (const Corner& corner : cage.corners) all.corners.push_back({first + corner.vertex, corner.sharpness});
        for (const std::uint32_t hole : cage.holes) all.holes.push_back(faces + hole);
        x += 3.0F;
    }
    return all;
}

}  // namespace tessera::test
