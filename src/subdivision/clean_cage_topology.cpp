// Faces turned the same way, and cages cut open where they are no surface.
#include <algorithm>
#include <limits>
#include <utility>

#include "subdivision/clean_cage_parts.h"
#include "subdivision/corner_sets.h"

namespace tessera::subdivision {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// What lies across the side that begins at a corner.
struct Across {
    std::uint32_t face = kNone;
    bool disagrees = false;  // both faces go along the edge the same way
};

std::vector<Across> findNeighbours(const CageFaces& faces) {
    std::vector<Across> across(faces.vertices.size());
    const std::vector<CageSide> sides = cageSides(faces);
    forEachCageEdge(sides, [&](std::span<const CageSide> edge) {
        if (edge.size() != 2) return;
        const bool disagrees = !isJoined(faces, edge);
        across[edge[0].corner] = {edge[1].face, disagrees};
        across[edge[1].corner] = {edge[0].face, disagrees};
    });
    return across;
}

// Which faces to turn, found by a flood over edges of two faces.
std::vector<bool> chooseTurned(const CageFaces& faces) {
    const std::vector<Across> across = findNeighbours(faces);
    std::vector<bool> turned(faces.count()), reached(faces.count());
    std::vector<std::uint32_t> piece;  // the connected piece, and the flood's queue
    for (std::size_t seed = 0; seed < faces.count(); ++seed) {
        if (reached[seed]) continue;
        reached[seed] = true;
        piece.assign(1, static_cast<std::uint32_t>(seed));
        std::size_t turnedHere = 0;
        for (std::size_t next = 0; next < piece.size(); ++next) {
            const std::uint32_t here = piece[next];
            turnedHere += turned[here] ? 1U : 0U;
            for (std::uint32_t corner = faces.starts[here]; corner < faces.starts[here + 1]; ++corner) {
                const Across& neighbour = across[corner];
                if (neighbour.face == kNone || reached[neighbour.face]) continue;
                reached[neighbour.face] = true;
                turned[neighbour.face] = turned[here] != neighbour.disagrees;
                piece.push_back(neighbour.face);
            }
        }
        if (turnedHere <= piece.size() / 2) continue;
        for (const std::uint32_t face : piece) turned[face] = !turned[face];
    }
    return turned;
}

// The sets of corners that are one vertex.
CornerSets findFans(const CageFaces& faces, std::vector<bool>& cutOpen, CageReport& report) {
    CornerSets fans(faces.vertices.size());
    const std::vector<CageSide> sides = cageSides(faces);
    forEachCageEdge(sides, [&](std::span<const CageSide> edge) {
        if (isJoined(faces, edge)) {
            // The one's start is the other's end.
            fans.join(edge[0].corner, faces.next(edge[1].face, edge[1].corner));
            fans.join(edge[1].corner, faces.next(edge[0].face, edge[0].corner));
        } else if (edge.size() > 1) {
            ++report.splitEdges;
            cutOpen[edge[0].low] = cutOpen[edge[0].high] = true;
        }
    });
    return fans;
}

}  // namespace

void orientFaces(CageFaces& faces, CageReport& report) {
    const std::vector<bool> turned = chooseTurned(faces);
    for (std::size_t face = 0; face < faces.count(); ++face) {
        if (!turned[face]) continue;
        ++report.turnedFaces;
        // The first corner stays the first.
        const auto first = faces.starts[face] + 1, end = faces.starts[face + 1];
        std::reverse(faces.vertices.begin() + first, faces.vertices.begin() + end);
        if (!faces.textures.empty()) std::reverse(faces.textures.begin() + first, faces.textures.begin() + end);
    }
}

// No edge comes out with more than two faces, or two that disagree: at each end, the faces of an edge that was cut lie at the ends of their
// fans, of which a fan has two, and within a fan neighbours agree. Two that meet again at both ends agree, and are joined again.
std::vector<std::uint32_t> cutVertices(CageFaces& faces, CageReport& report) {
    const std::uint32_t vertices = faces.vertices.empty() ? 0 : 1 + *std::max_element(faces.vertices.begin(), faces.vertices.end());
    std::vector<bool> cutOpen(vertices);
    CornerSets fans = findFans(faces, cutOpen, report);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> made;  // old vertex, and the fan's first corner
    for (std::uint32_t corner = 0; corner < faces.vertices.size(); ++corner) {
        if (fans.find(corner) == corner) made.emplace_back(faces.vertices[corner], corner);
    }
    std::sort(made.begin(), made.end());
    std::vector<std::uint32_t> vertexOf, numbers(faces.vertices.size());
    for (std::size_t v = 0; v < made.size(); ++v) {
        vertexOf.push_back(made[v].first);
        numbers[made[v].second] = static_cast<std::uint32_t>(v);
        const bool second = v > 0 && made[v - 1].first == made[v].first && (v == 1 || made[v - 2].first != made[v].first);
        report.splitVertices += second && !cutOpen[made[v].first] ? 1U : 0U;
    }
    for (std::uint32_t corner = 0; corner < faces.vertices.size(); ++corner) faces.vertices[corner] = numbers[fans.find(corner)];
    return vertexOf;
}

}  // namespace tessera::subdivision
