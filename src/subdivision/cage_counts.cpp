// What a report tells of a clean cage.
#include <algorithm>
#include <utility>

#include "subdivision/cage_meshes.h"
#include "subdivision/clean_cage_parts.h"

namespace tessera::subdivision {

void countCage(const Cage& cage, CageReport& report) {
    const CageFaces faces = facesOf(cage);
    report.faces = cage.faceCount() - cage.holes.size();
    report.holes = cage.holes.size();
    report.vertices = cage.points.size();
    report.cornerVertices = cage.corners.size();
    std::vector<std::uint32_t> around(cage.points.size(), 0);
    for (const std::uint32_t vertex : cage.faceVertices) ++around[vertex];
    std::vector<bool> onBoundary(cage.points.size());
    const std::vector<CageSide> sides = cageSides(faces);
    forEachCageEdge(sides, [&](std::span<const CageSide> edge) {
        if (edge.size() == 1) {
            ++report.boundaryEdges;
            onBoundary[edge[0].low] = onBoundary[edge[0].high] = true;
            return;
        }
        // The cage's creases are sorted by their edges.
        const auto place = std::pair(edge[0].low, edge[0].high);
        const auto found = std::lower_bound(cage.creases.begin(), cage.creases.end(), place, [](const Crease& crease, const auto& wanted) {
            return std::pair(crease.a, crease.b) < wanted;
        });
        report.creaseEdges += found != cage.creases.end() && std::pair(found->a, found->b) == place ? 1U : 0U;
    });
    const std::uint32_t regular = cage.scheme == SubdivisionScheme::loop ? 6 : 4;
    for (std::size_t v = 0; v < around.size(); ++v) {
        report.irregularVertices += around[v] != (onBoundary[v] ? regular / 2 : regular) ? 1U : 0U;
        report.largestValence = std::max<std::size_t>(report.largestValence, around[v] + (onBoundary[v] ? 1U : 0U));
    }
}

}  // namespace tessera::subdivision
