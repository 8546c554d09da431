// A range of the watertight mode: a quadrilateral in a patch's (u,v) with a rate for each edge. What is decided of an edge is a pure
// function of that edge alone (after DiagSplit: Fisher, Fatahalian, Boulos, Akeley, Mark, Hanrahan, 2009).
#ifndef TESSERA_SPLIT_QUAD_SHARED_H
#define TESSERA_SPLIT_QUAD_SHARED_H

#include "core/types_shared.h"

TESSERA_SHARED_BEGIN

// Rates of edges, by the number of segments T. A uniform edge has 2^k, and keeps its share of them when it is cut.
#define RATE_ZERO 0u  // the edge is one point
#define RATE_ONE 1u   // 1 + k stands for T = 2^k
#define RATE_NONUNIFORM 62u
#define RATE_UNKNOWN 63u  // of a patch that has just been fed

// Corners c0 to c3 go around; edge k runs from c_k to c_(k + 1 mod 4); edges 0 and 2 are of direction 0, 1 and 3 of direction 1.
typedef struct {
    uint patch_index;
    uint rates;  // a byte an edge
    uint sizes;  // a byte each: cuts in direction 0 and 1; log2 of the grid's columns (along edges 0 and 2) and rows, once it is diced
    uint corner_u[4];  // units of 2^-24
    uint corner_v[4];
} quad_range;

// What a split measured: the rates of the cut edges' halves in the order of their corners, first edge and opposite one a byte each,
// and of the new inner edge.
typedef struct {
    uint halves;
    uint inner;
} quad_cut;

// Cuts in one direction after which an edge takes the largest rate: no range has more than twice as many.
#define QUAD_LEVEL_MOST 12

// Ranges that a work-group bounds together, and the places that each has for points: 16 of its hull, or 5 on each of 5 edges.
#define QUAD_GROUP 16
#define QUAD_HULL 16
#define QUAD_SAMPLES 32

TESSERA_SHARED_END

#endif
