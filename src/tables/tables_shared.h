// Tables of coefficients and the faces that use them: what host and kernels share.
#ifndef TESSERA_TABLES_TABLES_SHARED_H
#define TESSERA_TABLES_TABLES_SHARED_H

#include "core/types_shared.h"

TESSERA_SHARED_BEGIN

// Levels that tables have: 2^n cells a side.
#define TABLE_LEVELS 6u
// Rows of a table are padded to whole vectors of so many points.
#define TABLE_PAD 16u

// New points of levels 1 to 5 and the middles of cells by their other diagonals, padded level by level: where those of each begin.
#define TABLE_DEVIATIONS 1456u

// A table of each level, in buffers of their own: rows of positions, point after point in the order of a MESH_RING's vertices
// (mesh/pattern.clh), and twice as many of tangents, along u and v in turn.
typedef struct {
    uint first_row;  // among the rows of all tables
    uint rows;
    float decay;  // how much less each level from 5 on adds to a mesh's distance than the one before
} table_info;

// A quadrilateral. Sides are its table's: side k from corner k to k + 1, with corner 0 at (0, 0) and corner 1 at (1, 0).
typedef struct {
    uint table;
    uint first_entry;  // of its control points
    uint number;       // among the cage's quadrilaterals
    uint turn;         // its own corner that is the table's corner 0
    uint beside[4];    // the face across each side, among the cage's in their order here; itself where there is none
} table_face;

// A placed cage.
typedef struct {
    uint first_patch;  // among all placed faces
    uint first_face;
    uint first_point;   // of its placed control points
    uint first_source;  // of its cage's control points
    uint points;
    uint id;                      // index into Scene::objects
    float world_from_object[12];  // three rows of four
} table_object;

// Which patches of a scene are to be made, and how.
typedef struct {
    uint objects;
    uint patches;  // of the scene
    uint first_patch;
    uint end_patch;
    uint by_number;         // 0 or 1: products are added in the order of the control points' numbers
    uint positions_only;    // 0 or 1: vertices are three floats
    uint first_vertex_low;  // the buffer's first vertex, two words of a 64-bit number
    uint first_vertex_high;
} table_run;

TESSERA_SHARED_END

#endif
