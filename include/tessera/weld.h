// Clean input: neighbouring patches of real files differ in the last bits, and drawing them as they are shows pinholes.
#pragma once

#include <cstddef>

#include "tessera/scene.h"

namespace tessera {

// What weld() found and did. Edges are patches' borders; degenerate ones (collapsed to a point) are counted by themselves.
struct WeldReport {
    double tolerance = 0;             // greatest absolute tolerance used, scene units
    std::size_t edges = 0;            // borders of all patches that are not degenerate
    std::size_t matchedEdges = 0;     // those that have a neighbour along their whole length, the same to the bit or by a record
    std::size_t boundaryEdges = 0;    // those that have none
    std::size_t degenerateEdges = 0;  // borders that are one point, those collapsed here included
    std::size_t collapsedEdges = 0;   // borders shorter than the tolerance that were made one point
    std::size_t snappedPoints = 0;    // control points that moved
    std::size_t recordedEdges = 0;    // borders that have an EdgeRecord now
    std::size_t overusedEdges = 0;    // borders that three or more patches share; they match all the same
    double largestGap = 0;            // greatest distance that a control point moved, scene units
    double nearestMiss = 0;           // boundary edges: least distance to a border with the same ends within 100 tolerances whose curve
                                      // differs; 0 where there is none. A hint that the data has a crack.
};

// Makes borders that agree within `tolerance` (relative to the mesh's size: the diagonal of its bounds) the same to the bit, collapses
// borders shorter than that to a point, and gives the borders of neighbours of different kind or level edge records. Works over meshes
// whose objects have the same transform, and within each mesh; between two meshes the smaller one's tolerance holds. Where points lie in
// chains, one may move by some four tolerances. Existing records are replaced. `tolerance` 0 still matches edges that are the same to the
// bit, and makes records; it may make -0 a +0. Weights match within 1e-5 of each other, up to a common factor.
// A border whose neighbours are finer may be matched in part: it then has a record, and counts as boundary. But every patch with a corner
// strictly inside it is a user of the record, or there is none.
// Meshes that are `welded` already are left as they are, and others are not matched with them.
// Time and memory grow with the number of patches, however they lie. Requires a validated scene; throws Error, naming the scene, on a
// tolerance outside [0, 0.1].
WeldReport weld(Scene& scene, double tolerance = 1e-5);

}  // namespace tessera
