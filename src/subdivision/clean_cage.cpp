// Cages repaired: the steps in their order, and what comes of them.
#include "subdivision/clean_cage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "subdivision/clean_cage_parts.h"

namespace tessera::subdivision {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Texture points that some corner has; OpenSubdiv is not shown the rest.
void moveTextures(const Cage& given, CageFaces& faces, Cage& cage, CageReport& report) {
    std::vector<std::uint32_t> renumbered(given.texturePoints.size(), kNone);
    std::size_t bad = 0;
    for (std::uint32_t& number : faces.textures) {
        std::uint32_t& moved = renumbered[number];
        if (moved == kNone) {
            moved = static_cast<std::uint32_t>(cage.texturePoints.size());
            const glm::vec2& value = given.texturePoints[number];
            const bool finite = std::isfinite(value.x) && std::isfinite(value.y);
            bad += finite ? 0U : 1U;
            cage.texturePoints.push_back(finite ? value : glm::vec2(0.0F));
        }
        number = moved;
    }
    noteCount(report, bad, "texture point", "not finite: 0 stands for each");
}

}  // namespace

void noteCount(CageReport& report, std::size_t count, std::string_view thing, const std::string& rest) {
    if (count == 0) return;
    report.notes.push_back(std::to_string(count) + " " + std::string(thing) + (count == 1 ? " " : "s ") + rest);
}

std::vector<CageSide> cageSides(const CageFaces& faces) {
    std::vector<CageSide> sides;
    sides.reserve(faces.vertices.size());
    for (std::size_t face = 0; face < faces.count(); ++face) {
        for (std::uint32_t corner = faces.starts[face]; corner < faces.starts[face + 1]; ++corner) {
            const auto [low, high] = std::minmax(faces.vertices[corner], faces.vertices[faces.next(face, corner)]);
            sides.push_back({low, high, static_cast<std::uint32_t>(face), corner});
        }
    }
    std::sort(sides.begin(), sides.end(),
              [](const CageSide& a, const CageSide& b) { return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner); });
    return sides;
}

CageFaces facesOf(const Cage& cage) {
    CageFaces faces;
    faces.vertices = cage.faceVertices;
    faces.textures = cage.faceTexturePoints;
    for (std::size_t face = 0; face < cage.faceCount(); ++face) {
        faces.starts.push_back(faces.starts.back() + cage.faceSizes[face]);
        faces.faceOf.push_back(static_cast<std::uint32_t>(face));
    }
    return faces;
}

glm::dvec3 newellNormal(const Cage& cage, std::size_t first, std::size_t size) {
    // Relative to a corner, so that places far from the origin cost no digits.
    const glm::dvec3 origin(cage.points[cage.faceVertices[first]]);
    glm::dvec3 sum(0.0);
    for (std::size_t k = 1; k + 1 < size; ++k) {
        sum += glm::cross(glm::dvec3(cage.points[cage.faceVertices[first + k]]) - origin,
                          glm::dvec3(cage.points[cage.faceVertices[first + k + 1]]) - origin);
    }
    return sum;
}

CleanCage cleanCage(const Cage& cage, double creaseAngle, CageReport& report) {
    checkCageLists(cage);
    CageFaces faces = usableFaces(cage, report);
    orientFaces(faces, report);
    CleanCage clean;
    clean.vertexOf = cutVertices(faces, report);
    clean.cage.name = cage.name;
    clean.cage.scheme = cage.scheme;
    clean.cage.boundary = cage.boundary;
    clean.cage.points.reserve(clean.vertexOf.size());
    std::size_t used = 0;
    for (std::size_t v = 0; v < clean.vertexOf.size(); ++v) {
        used += v == 0 || clean.vertexOf[v] != clean.vertexOf[v - 1] ? 1U : 0U;
        clean.cage.points.push_back(cage.points[clean.vertexOf[v]]);
    }
    report.isolatedVertices += cage.points.size() - used;
    moveTextures(cage, faces, clean.cage, report);
    for (std::size_t face = 0; face < faces.count(); ++face) clean.cage.faceSizes.push_back(faces.size(face));
    clean.cage.faceVertices = faces.vertices;
    clean.cage.faceTexturePoints = faces.textures;
    clean.faceOf = faces.faceOf;
    moveTags(cage, clean, faces, report);
    creaseByAngle(creaseAngle, clean.cage, faces, report);
    dropRiskyCreases(clean.cage, faces, report);
    return clean;
}

}  // namespace tessera::subdivision
