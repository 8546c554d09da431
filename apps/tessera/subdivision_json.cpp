// What became of a scene's cages, as JSON and as text.
#include "subdivision_json.h"

#include "console.h"

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace tessera::program {

namespace {

using Json = nlohmann::ordered_json;

// What was left out or changed: "2 faces left out, ..."; empty where nothing was.
std::string repairsText(const CageReport& report) {
    const std::array<std::pair<std::size_t, std::array<std::string_view, 2>>, 5> repairs{{
        {report.droppedFaces, {"face left out", "faces left out"}},
        {report.isolatedVertices, {"vertex of no face", "vertices of no face"}},
        {report.turnedFaces, {"face turned", "faces turned"}},
        {report.splitEdges, {"edge cut open", "edges cut open"}},
        {report.splitVertices, {"vertex taken apart", "vertices taken apart"}},
    }};
    std::string text;
    for (const auto& [count, words] : repairs) {
        if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, words[0], words[1]);
    }
    return text;
}

double regularShare(const CageReport& report) {
    return report.patches == 0 ? 0.0 : static_cast<double>(report.regularPatches) / static_cast<double>(report.patches);
}

}  // namespace

Json subdivisionJson(std::span<const CageReport> reports) {
    Json all = Json::array();
    for (const CageReport& report : reports) {
        all.push_back({{"cage", report.cage},
                       {"faces", report.faces},
                       {"vertices", report.vertices},
                       {"irregular_vertices", report.irregularVertices},
                       {"largest_valence", report.largestValence},
                       {"crease_edges", report.creaseEdges},
                       {"creased_by_angle", report.creasedByAngle},
                       {"corner_vertices", report.cornerVertices},
                       {"boundary_edges", report.boundaryEdges},
                       {"holes", report.holes},
                       {"dropped_faces", report.droppedFaces},
                       {"isolated_vertices", report.isolatedVertices},
                       {"turned_faces", report.turnedFaces},
                       {"split_edges", report.splitEdges},
                       {"split_vertices", report.splitVertices},
                       {"patches", report.patches},
                       {"regular_patches", report.regularPatches},
                       {"regular_share", regularShare(report)},
                       {"deepest_level", report.deepestLevel},
                       {"limit_distance", report.limitDistance},
                       {"notes", report.notes}});
    }
    return all;
}

std::string subdivisionText(const CageReport& report) {
    constexpr std::string_view indent = "        ";
    std::string text = "cage    '" + oneLine(report.cage) + "': " + counted(report.faces, "face", "faces") + ", " +
                       counted(report.vertices, "vertex", "vertices") + ", " + std::to_string(report.irregularVertices) +
                       " irregular, largest valence " + std::to_string(report.largestValence) + "\n";
    text += std::string(indent) + counted(report.creaseEdges, "crease", "creases");
    if (report.creasedByAngle > 0) text += " (" + std::to_string(report.creasedByAngle) + " by angle)";
    text += ", " + counted(report.cornerVertices, "corner", "corners") + ", " +
            counted(report.boundaryEdges, "boundary edge", "boundary edges") + ", " + counted(report.holes, "hole", "holes") + "\n";
    if (const std::string repairs = repairsText(report); !repairs.empty()) text += std::string(indent) + "repaired: " + repairs + "\n";
    text += std::string(indent) + counted(report.patches, "patch", "patches") + ", " + fixed(100.0 * regularShare(report), 1) +
            " % regular, deepest level " + std::to_string(report.deepestLevel) + ", within " + about(report.limitDistance) +
            " units of the limit surface\n";
    return text;
}

}  // namespace tessera::program
