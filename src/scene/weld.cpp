// weld(): group by group, finds which points and borders are the same, makes them so, and says what was found.
#include "tessera/weld.h"

#include "scene/weld_apply.h"
#include "scene/weld_group.h"
#include "scene/weld_levels.h"
#include "scene/weld_match.h"
#include "scene/weld_misses.h"
#include "tessera/error.h"

#include <algorithm>
#include <string>

namespace tessera {

namespace {

using namespace welding;

constexpr double kMostTolerance = 0.1;

// Counts the borders, and returns those without a neighbour along their whole length, the lowest first.
std::vector<std::uint32_t> countBorders(const Matching& matching, const std::vector<CoarseBorder>& levels, WeldReport& report) {
    std::vector<std::uint8_t> matched(matching.degenerate.size());
    for (const CoarseBorder& coarse : levels) {
        matched[coarse.border] = coarse.covered ? 1 : 0;
        for (const FinePart& part : coarse.parts) matched[part.border] = 1;
    }
    std::vector<std::uint32_t> boundary;
    report.collapsedEdges += matching.collapsed;
    for (std::size_t k = 0; k < matching.classCount(); ++k) {
        const std::span<const std::uint32_t> members = matching.members(k);
        if (matching.degenerate[members.front()] != 0) {
            report.degenerateEdges += members.size();
            continue;
        }
        report.edges += members.size();
        if (members.size() > 2) report.overusedEdges += members.size();
        if (members.size() > 1 || matched[members.front()] != 0) {
            report.matchedEdges += members.size();
        } else {
            boundary.push_back(members.front());
        }
    }
    std::sort(boundary.begin(), boundary.end());
    report.boundaryEdges += boundary.size();
    return boundary;
}

void weldGroup(const Group& group, WeldReport& report) {
    const Labels labels(group);
    const Matching matching = matchBorders(group, labels);
    const std::vector<CoarseBorder> levels = findLevels(group, labels, matching);
    const std::vector<std::uint32_t> boundary = countBorders(matching, levels, report);
    snapPoints(group, labels, matching, levels, report);
    makeRecords(group, matching, levels);
    for (std::size_t m = 0; m < group.meshes().size(); ++m) {
        report.tolerance = std::max(report.tolerance, group.meshTolerance(m));
        report.recordedEdges += group.meshes()[m]->edges.size();
    }
    const double miss = nearestMiss(group, boundary);
    if (miss > 0.0 && (report.nearestMiss == 0.0 || miss < report.nearestMiss)) report.nearestMiss = miss;
}

}  // namespace

WeldReport weld(Scene& scene, double tolerance) {
    if (!(tolerance >= 0.0 && tolerance <= kMostTolerance)) {
        throw Error((scene.name.empty() ? "scene" : scene.name) + ": weld tolerance " + std::to_string(tolerance) +
                    " is outside its range; give 0 to 0.1");
    }
    WeldReport report;
    for (std::vector<Mesh*>& meshes : meshesByTransform(scene)) {
        std::erase_if(meshes, [](const Mesh* mesh) { return mesh->welded; });
        if (!meshes.empty()) weldGroup(Group(std::move(meshes), tolerance), report);
    }
    return report;
}

}  // namespace tessera
