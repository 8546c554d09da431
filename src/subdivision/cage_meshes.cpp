// One cage made meshes, by its scheme.
#include "subdivision/cage_meshes.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "scene/text.h"
#include "subdivision/cells.h"
#include "subdivision/clean_cage.h"
#include "subdivision/clean_cage_parts.h"
#include "subdivision/flat_schemes.h"
#include "subdivision/gregory_cells.h"
#include "subdivision/limit_cells.h"
#include "subdivision/limit_distance.h"
#include "subdivision/loop_surface.h"
#include "subdivision/pn_cage.h"
#include "subdivision/quad_domains.h"
#include "subdivision/refiner.h"
#include "subdivision/texture_cells.h"
#include "subdivision/triangulate.h"
#include "tessera/error.h"

namespace tessera::subdivision {

namespace {

constexpr int kDistanceSamples = 5;
// Each face has at most as many domains, and each domain as many lines and points of its own, as OpenSubdiv's numbers can tell.
constexpr std::size_t kMostCorners = std::numeric_limits<std::int32_t>::max() / 4;

// Smooth patches at a vertex, or at a face's middle, cost OpenSubdiv's Bfr time by the cube of its number of faces and memory by the
// square: 3 to 5 seconds at 300, minutes and gigabytes at 3000.
constexpr std::size_t kMostSmoothFaces = 300;

// The diagonal of the cage's bounds; not 0 where it is all in one place, so that tolerances stay above 0.
double sizeOf(const Cage& cage) {
    Bounds bounds;
    for (const glm::vec3& point : cage.points) bounds.include(point);
    return bounds.empty() ? 0.0 : std::max(1e-30, glm::length(glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower)));
}

// Boundary rules may take faces away.
std::size_t drawnFaces(const Refiner& refiner) {
    std::size_t drawn = 0;
    for (int face = 0; face < refiner.GetLevel(0).GetNumFaces(); ++face) drawn += refiner.GetLevel(0).IsFaceHole(face) ? 0U : 1U;
    return drawn;
}

std::vector<Cell> smoothCells(const Cage& cage, const Refiner& refiner, const QuadDomains& domains, const SubdivisionOptions& options,
                              CageReport& report, std::size_t& capped) {
    std::vector<Cell> cells;
    if (options.surface == SubdivisionSurface::gregory) {
        cells = gregoryCells(refiner, cage.points, domains);
    } else {
        LimitCounts counts;
        cells = limitCells(refiner, cage.points, domains, {options.tolerance * sizeOf(cage), options.progress}, &counts);
        capped = counts.cappedCorners;
    }
    report.limitDistance = limitDistance(refiner, cage.points, domains, cells, kDistanceSamples).greatest;
    if (!cage.texturePoints.empty()) addTexture(refiner, cage.texturePoints, domains, cells);
    return cells;
}

std::vector<Mesh> quadMeshes(const Cage& cage, const SubdivisionOptions& options, CageReport& report) {
    const std::unique_ptr<Refiner> refiner = makeRefiner(cage);
    report.faces = drawnFaces(*refiner);
    const QuadDomains domains = makeDomains(*refiner);
    if (domains.domains.empty()) return {};
    std::size_t capped = 0;
    std::vector<Cell> cells = cage.scheme == SubdivisionScheme::bilinear ? bilinearCells(*refiner, cage.points, cage.texturePoints, domains)
                                                                         : smoothCells(cage, *refiner, domains, options, report, capped);
    for (const Cell& cell : cells) report.deepestLevel = std::max<std::size_t>({report.deepestLevel, cell.levelU, cell.levelV});
    StitchedMeshes stitched = stitch(domains, std::move(cells), !cage.texturePoints.empty());
    report.patches = stitched.bezier.patchCount() + stitched.gregory.patchCount();
    report.regularPatches = stitched.bezier.patchCount() - std::min(capped, stitched.bezier.patchCount());
    stitched.bezier.name = cage.name;
    stitched.gregory.name = cage.name + " gregory";
    std::vector<Mesh> meshes;
    for (Mesh* mesh : {&stitched.bezier, &stitched.gregory}) {
        if (mesh->points.empty()) continue;
        mesh->welded = true;
        meshes.push_back(std::move(*mesh));
    }
    return meshes;
}

// Makes a clean cage bilinear where that is all that can be had in reasonable time.
void flattenCrowded(Cage& cage, CageReport& report) {
    std::vector<std::uint32_t> faces(cage.points.size(), 0);
    for (const std::uint32_t vertex : cage.faceVertices) ++faces[vertex];
    const std::size_t mostFaces = faces.empty() ? 0 : *std::max_element(faces.begin(), faces.end());
    const std::size_t mostCorners = cage.faceSizes.empty() ? 0 : *std::max_element(cage.faceSizes.begin(), cage.faceSizes.end());
    if (std::max(mostFaces, mostCorners) <= kMostSmoothFaces) return;
    cage.scheme = SubdivisionScheme::bilinear;
    const std::string what = mostFaces > kMostSmoothFaces ? "a vertex of " + std::to_string(mostFaces) + " faces"
                                                          : "a face of " + std::to_string(mostCorners) + " corners";
    report.notes.push_back(what + ": drawn bilinear, not smooth; give vertices and faces at most " + std::to_string(kMostSmoothFaces) +
                           ", or take tables");
}

// Triangles only, as clean as the cage was.
Cage loopCage(Cage cage, CageReport& report) {
    const auto others = std::count_if(cage.faceSizes.begin(), cage.faceSizes.end(), [](std::uint32_t size) { return size != 3; });
    if (others == 0) return cage;
    noteCount(report, static_cast<std::size_t>(others), "face", "of more than three corners cut into triangles, as scheme loop wants");
    return cleanCage(triangulated(cage, report), 180.0, report).cage;
}

std::vector<Mesh> loopMeshes(const Cage& cage, const SubdivisionOptions& options, CageReport& report) {
    const std::unique_ptr<Refiner> refiner = makeRefiner(cage);
    report.faces = drawnFaces(*refiner);
    const double tolerance = options.tolerance * sizeOf(cage);
    LoopSurface surface = loopSurface(*refiner, cage.points, cage.texturePoints, tolerance, cage.name);
    if (!surface.mesh.has_value()) return {};
    report.patches = surface.mesh->patchCount();
    report.deepestLevel = surface.level;
    report.limitDistance = surface.limitDistance;
    if (surface.limitDistance > tolerance) {
        report.notes.push_back("triangles lie up to " + numberText(static_cast<float>(surface.limitDistance)) +
                               " from the limit surface; the tolerance asks for " + numberText(static_cast<float>(tolerance)));
    }
    return {std::move(*surface.mesh)};
}

std::vector<Mesh> polygonMeshes(const Cage& cage, CageReport& report) {
    std::optional<PnCage> patches = pnCage(polygonTriangles(cage, report));
    if (!patches.has_value()) return {};
    report.patches = patches->mesh.patchCount();
    return {std::move(patches->mesh)};
}

}  // namespace

std::vector<Mesh> cageMeshes(const Cage& cage, const SubdivisionOptions& options, CageReport& report) {
    if (cage.faceVertices.size() > kMostCorners) {
        throw Error("cage " + quotedName(cage.name) + ": " + std::to_string(cage.faceVertices.size()) +
                    " corners of faces are more than the " + std::to_string(kMostCorners) + " of a cage; split it");
    }
    Cage clean = cleanCage(cage, options.creaseAngle, report).cage;
    if (clean.scheme == SubdivisionScheme::loop) clean = loopCage(std::move(clean), report);
    if (clean.scheme == SubdivisionScheme::catmullClark) flattenCrowded(clean, report);
    countCage(clean, report);
    if (report.faces == 0) return {};
    if (clean.scheme == SubdivisionScheme::none) return polygonMeshes(clean, report);
    return clean.scheme == SubdivisionScheme::loop ? loopMeshes(clean, options, report) : quadMeshes(clean, options, report);
}

}  // namespace tessera::subdivision
