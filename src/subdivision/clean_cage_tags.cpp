// Creases, corners and holes of repaired cages.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <tuple>
#include <utility>

#include "subdivision/clean_cage_parts.h"

namespace tessera::subdivision {

namespace {

constexpr float kForEver = 10.0F;

// Written so that NaN fails.
bool isSharpness(float sharpness) { return sharpness >= 0.0F; }

bool sameEdge(const Crease& a, const Crease& b) { return a.a == b.a && a.b == b.b; }

// Edge after edge, the greatest sharpness first.
bool before(const Crease& a, const Crease& b) { return std::tie(a.a, a.b, b.sharpness) < std::tie(b.a, b.b, a.sharpness); }

// Each edge once, with its greatest sharpness; returns how many creases fell away.
std::size_t keepGreatest(std::vector<Crease>& creases) {
    std::sort(creases.begin(), creases.end(), before);
    const auto end = std::unique(creases.begin(), creases.end(), sameEdge);
    const auto repeated = static_cast<std::size_t>(creases.end() - end);
    creases.erase(end, creases.end());
    return repeated;
}

void moveCreases(const Cage& given, CleanCage& clean, const CageFaces& faces, CageReport& report) {
    std::vector<Crease> wanted;
    for (const Crease& crease : given.creases) {
        if (!isSharpness(crease.sharpness)) continue;
        wanted.push_back({std::min(crease.a, crease.b), std::max(crease.a, crease.b), std::min(crease.sharpness, kForEver)});
    }
    noteCount(report, given.creases.size() - wanted.size(), "crease", "of no sharpness of 0 or above left out");
    noteCount(report, keepGreatest(wanted), "crease", "of an edge that has a sharper one left out");
    // The new edges, by their old vertices: the order of sides need not be that of `wanted`.
    std::vector<Crease> edges;
    for (std::size_t face = 0; face < faces.count(); ++face) {
        for (std::uint32_t corner = faces.starts[face]; corner < faces.starts[face + 1]; ++corner) {
            const std::uint32_t start = faces.vertices[corner], end = faces.vertices[faces.next(face, corner)];
            const auto [low, high] = std::minmax(clean.vertexOf[start], clean.vertexOf[end]);
            const auto found = std::lower_bound(wanted.begin(), wanted.end(), Crease{low, high, kForEver}, before);
            if (found == wanted.end() || found->a != low || found->b != high) continue;
            edges.push_back({std::min(start, end), std::max(start, end), found->sharpness});
        }
    }
    keepGreatest(edges);
    // Those that no edge took up.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> met;
    met.reserve(edges.size());
    for (const Crease& edge : edges) met.emplace_back(std::minmax(clean.vertexOf[edge.a], clean.vertexOf[edge.b]));
    std::sort(met.begin(), met.end());
    met.erase(std::unique(met.begin(), met.end()), met.end());
    noteCount(report, wanted.size() - met.size(), "crease", "between vertices that no edge joins left out");
    std::copy_if(edges.begin(), edges.end(), std::back_inserter(clean.cage.creases),
                 [](const Crease& edge) { return edge.sharpness > 0.0F; });
}

void moveCorners(const Cage& given, CleanCage& clean, CageReport& report) {
    std::vector<float> sharpness(given.points.size(), -1.0F);
    std::size_t nowhere = 0, bad = 0, repeated = 0;
    for (const Corner& corner : given.corners) {
        if (!isSharpness(corner.sharpness)) {
            ++bad;
        } else if (corner.vertex >= sharpness.size() || !std::binary_search(clean.vertexOf.begin(), clean.vertexOf.end(), corner.vertex)) {
            ++nowhere;
        } else {
            float& greatest = sharpness[corner.vertex];
            repeated += greatest >= 0.0F ? 1U : 0U;
            greatest = std::max(greatest, std::min(corner.sharpness, kForEver));
        }
    }
    noteCount(report, bad, "corner", "of no sharpness of 0 or above left out");
    noteCount(report, nowhere, "corner", "at vertices of no face left out");
    noteCount(report, repeated, "corner", "of a vertex that has a sharper one left out");
    for (std::uint32_t vertex = 0; vertex < clean.vertexOf.size(); ++vertex) {
        const float greatest = sharpness[clean.vertexOf[vertex]];
        if (greatest > 0.0F) clean.cage.corners.push_back({vertex, greatest});
    }
}

void moveHoles(const Cage& given, CleanCage& clean, CageReport& report) {
    std::vector<bool> isHole(given.faceCount());
    std::size_t nowhere = 0;
    for (const std::uint32_t hole : given.holes) {
        if (hole < isHole.size()) {
            isHole[hole] = true;
        } else {
            ++nowhere;
        }
    }
    noteCount(report, nowhere, "hole", "that no face is left out");
    for (std::uint32_t face = 0; face < clean.faceOf.size(); ++face) {
        if (isHole[clean.faceOf[face]]) clean.cage.holes.push_back(face);
    }
}

}  // namespace

void moveTags(const Cage& given, CleanCage& clean, const CageFaces& faces, CageReport& report) {
    moveCreases(given, clean, faces, report);
    moveCorners(given, clean, report);
    moveHoles(given, clean, report);
}

void creaseByAngle(double angle, Cage& cage, const CageFaces& faces, CageReport& report) {
    if (!(angle < 180.0)) return;
    std::vector<glm::dvec3> normals;
    for (std::size_t face = 0; face < faces.count(); ++face) normals.push_back(newellNormal(cage, faces.starts[face], faces.size(face)));
    const std::size_t given = cage.creases.size();
    const double limit = angle * std::numbers::pi / 180.0;
    const std::vector<CageSide> sides = cageSides(faces);
    forEachCageEdge(sides, [&](std::span<const CageSide> edge) {
        if (edge.size() != 2) return;
        const glm::dvec3 &a = normals[edge[0].face], &b = normals[edge[1].face];
        // Faces without area have no direction: the angle is then 0. Not more than the limit for what rounding alone makes of it.
        if (std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) <= limit + 1e-7) return;
        const Crease crease{edge[0].low, edge[0].high, kForEver};
        if (std::binary_search(cage.creases.begin(), cage.creases.begin() + static_cast<std::ptrdiff_t>(given), crease, before)) return;
        ++report.creasedByAngle;
        cage.creases.push_back(crease);
    });
    keepGreatest(cage.creases);
}

void dropRiskyCreases(Cage& cage, const CageFaces& faces, CageReport& report) {
    std::vector<std::uint32_t> around(cage.points.size(), 0);
    for (const std::uint32_t vertex : faces.vertices) ++around[vertex];
    const std::vector<CageSide> sides = cageSides(faces);
    forEachCageEdge(sides, [&](std::span<const CageSide> edge) {
        // Vertices of boundaries are never inside, whatever their number of faces.
        if (edge.size() == 1) around[edge[0].low] = around[edge[0].high] = 0;
    });
    std::vector<bool> touched(cage.points.size());
    for (std::size_t face = 0; face < faces.count(); ++face) {
        const auto first = faces.vertices.begin() + faces.starts[face], end = faces.vertices.begin() + faces.starts[face + 1];
        if (std::none_of(first, end, [&](std::uint32_t vertex) { return around[vertex] == 2; })) continue;
        std::for_each(first, end, [&](std::uint32_t vertex) { touched[vertex] = true; });
    }
    const std::size_t dropped = std::erase_if(cage.creases, [&](const Crease& crease) { return touched[crease.a] || touched[crease.b]; });
    noteCount(report, dropped, "crease", "left out by vertices inside that only two faces surround");
}

}  // namespace tessera::subdivision
