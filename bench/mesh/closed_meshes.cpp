// Tubes and balls of triangles.
#include "mesh/closed_meshes.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace tessera::bench {

namespace {

// Rows of quads between ring i and ring i + 1, the last to the first where it closes.
void addRows(TriangleMesh& mesh, std::uint32_t rings, std::uint32_t sides, bool closes) {
    for (std::uint32_t i = 0; i + (closes ? 0 : 1) < rings; ++i) {
        for (std::uint32_t j = 0; j < sides; ++j) {
            const std::uint32_t here = i * sides;
            const std::uint32_t next = (i + 1) % rings * sides;
            const std::uint32_t right = (j + 1) % sides;
            mesh.triangles.push_back({here + j, next + right, next + j});
            mesh.triangles.push_back({here + j, here + right, next + right});
        }
    }
}

void addPoints(TriangleMesh& mesh, std::uint32_t rings, std::uint32_t sides, const TubePoint& point) {
    for (std::uint32_t i = 0; i < rings; ++i) {
        for (std::uint32_t j = 0; j < sides; ++j) mesh.positions.emplace_back(point(i, j));
    }
}

struct Icosahedron {
    std::vector<glm::dvec3> corners;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

Icosahedron icosahedron() {
    const double t = 0.5 * (1.0 + std::sqrt(5.0));
    Icosahedron made;
    made.corners = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                    {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
    for (glm::dvec3& corner : made.corners) corner = glm::normalize(corner);
    made.triangles = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                      {3, 9, 4},  {3, 4, 2}, {3, 2, 6}, {3, 6, 8},  {3, 8, 9},   {4, 9, 5}, {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    return made;
}

void cutInFour(Icosahedron& ball) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [entry, isNew] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(ball.corners.size()));
        if (isNew) {
            const glm::dvec3 between = glm::normalize(ball.corners[a] + ball.corners[b]);
            ball.corners.push_back(between);
        }
        return entry->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : ball.triangles) {
        const std::uint32_t ab = middle(a, b);
        const std::uint32_t bc = middle(b, c);
        const std::uint32_t ca = middle(c, a);
        finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    ball.triangles = std::move(finer);
}

}  // namespace

TriangleMesh ringTube(std::string name, std::uint32_t rings, std::uint32_t sides, const TubePoint& point) {
    TriangleMesh mesh;
    mesh.name = std::move(name);
    addPoints(mesh, rings, sides, point);
    addRows(mesh, rings, sides, true);
    return mesh;
}

TriangleMesh tippedTube(std::string name, std::uint32_t rings, std::uint32_t sides, const TubePoint& point, const glm::dvec3& first,
                        const glm::dvec3& last) {
    TriangleMesh mesh;
    mesh.name = std::move(name);
    addPoints(mesh, rings, sides, point);
    addRows(mesh, rings, sides, false);
    const auto tip = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.emplace_back(first);
    mesh.positions.emplace_back(last);
    const std::uint32_t end = (rings - 1) * sides;
    for (std::uint32_t j = 0; j < sides; ++j) {
        const std::uint32_t right = (j + 1) % sides;
        mesh.triangles.push_back({tip, right, j});
        mesh.triangles.push_back({tip + 1, end + j, end + right});
    }
    return mesh;
}

TriangleMesh ball(std::string name, std::uint32_t cuts, const std::function<glm::dvec3(const glm::dvec3&)>& place) {
    Icosahedron made = icosahedron();
    for (std::uint32_t i = 0; i < cuts; ++i) cutInFour(made);
    TriangleMesh mesh;
    mesh.name = std::move(name);
    for (const glm::dvec3& corner : made.corners) mesh.positions.emplace_back(place(corner));
    mesh.triangles = std::move(made.triangles);
    return mesh;
}

}  // namespace tessera::bench
