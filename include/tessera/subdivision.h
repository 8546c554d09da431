// Subdivision surfaces as patches: topology and limit surface by OpenSubdiv, in a library of its own (tessera::subdivision).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tessera/cage.h"
#include "tessera/progress.h"
#include "tessera/scene.h"

namespace tessera {

enum class SubdivisionSurface {
    exact,    // the limit surface: bicubic patches where it is one, cut ever smaller towards what is none
    gregory,  // one patch a quadrilateral: Gregory patches at irregular vertices (Loop, Schaefer, Ni, Castano: "Approximating Subdivision
              // Surfaces with Gregory Patches for Hardware Tessellation", 2009)
};

struct SubdivisionOptions {
    SubdivisionSurface surface = SubdivisionSurface::exact;
    // exact: how far patches at irregular vertices may lie from the limit surface, relative to the cage's size (its bounds' diagonal).
    double tolerance = 2e-6;                  // 1e-9 to 0.1
    std::optional<SubdivisionScheme> scheme;  // instead of the cages' own
    // Edges whose faces' normals differ by more than these degrees become creases, for ever sharp; 180: none.
    double creaseAngle = 180.0;
    Progress progress{};  // told how far subdivide() is, where it is set

    void validate() const;  // throws Error naming the option and its range
};

// What was found in one cage, and made of it; counts.
struct CageReport {
    std::string cage;
    std::size_t faces = 0;              // as drawn: without holes and what was left out
    std::size_t vertices = 0;           // that faces use
    std::size_t irregularVertices = 0;  // inner ones with other than four faces, boundary ones with other than two
    std::size_t creaseEdges = 0;        // with a sharpness above 0, boundaries not counted
    std::size_t creasedByAngle = 0;     // of these
    std::size_t cornerVertices = 0;     // with a sharpness above 0
    std::size_t boundaryEdges = 0;
    std::size_t holes = 0;
    std::size_t droppedFaces = 0;      // repeated vertices, fewer than three corners, corners that are no vertex or not finite, duplicates
    std::size_t isolatedVertices = 0;  // of no face: left out
    std::size_t turnedFaces = 0;       // turned round to agree with their neighbours
    std::size_t splitEdges = 0;        // edges of three or more faces, or that faces disagree along: cut open
    std::size_t splitVertices = 0;     // where surfaces touch in a single point: taken apart
    std::size_t largestValence = 0;
    std::size_t patches = 0;
    std::size_t regularPatches = 0;  // bicubic and exact
    std::size_t deepestLevel = 0;    // most times that a face was halved on the way to a patch
    double limitDistance = 0;        // measured: the greatest distance found between patches and limit surface, scene units; not nearer to
                                     // irregular vertices than a thousandth of a face, where OpenSubdiv's own surface is no measure
    std::vector<std::string> notes;  // what a user should know, a line each, without the cage's name
};

// Replaces the scene's cages by meshes, and the objects that place them by objects that place these (`gregory` may need two a cage, which
// have the same transform). Meshes come with their edge records and shared points, closed wherever the cage is, and must not be welded
// again. Memory depends on the cages alone. Cages without a single face that can be drawn are left out with their objects, with a note.
// Objects keep their names; one placed once more for Gregory patches is "NAME gregory". Cages that no object places are left out. What is
// wrong with a cage's faces, places and tags is repaired and told of. Throws Error, naming the cage and leaving the scene as it was, on
// lists that do not fit each other, names that meshes and cages use twice, and cages too large for 32-bit numbers.
std::vector<CageReport> subdivide(Scene& scene, const SubdivisionOptions& options = {});

}  // namespace tessera
