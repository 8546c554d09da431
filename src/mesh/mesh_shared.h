// Patterns of patches, what they are measured by, and where their vertices and triangles go: what host and kernels share.
#ifndef TESSERA_MESH_MESH_SHARED_H
#define TESSERA_MESH_MESH_SHARED_H

#include "core/types_shared.h"

TESSERA_SHARED_BEGIN

#ifndef __OPENCL_VERSION__
using ulong = std::uint64_t;
#endif

// Most segments of a side and cells of a direction: parameters count units of 2^-24, so that a segment has 256 of them at least.
#define MESH_RATE_MOST 65536u
// A pattern with more vertices is cut into units: its sides, and bands of its inner lines.
#define MESH_UNIT_VERTICES 4096u
// A PN triangle of a greater rate is a ring though its sides agree: a grid is never cut.
#define MESH_GRID_MOST 64u

// mesh_pattern.form
#define MESH_NOTHING 0u        // outside the view, or of no area: no vertices
#define MESH_RIBBON_U 1u       // no inner lines: triangles between sides 0 and 2; sides 1 and 3 have one segment at most
#define MESH_RIBBON_V 2u       // the same between sides 3 and 1
#define MESH_RING 3u           // a grid of inner lines, and a transition region along each side
#define MESH_TRIANGLE_RING 4u  // of a PN triangle: the same with a triangle of inner lines
#define MESH_TRIANGLE_GRID 5u  // of a PN triangle whose sides all have cells_u segments: the uniform pattern
#define MESH_FAN_0 6u          // of a PN triangle: side 0 and the corner opposite; the other sides have one segment
#define MESH_FAN_1 7u
#define MESH_FAN_3 8u

// How a patch is tessellated (pattern.clh draws it). Sides as in EdgeRecord (tessera/scene.h).
typedef struct mesh_pattern {
    uint form;
    uint side[4];  // segments; 0: the side is one point, or, of a PN triangle, side 2. All 0 in MESH_NOTHING
    // MESH_RING: cells between the sides along u and v, 2 at least, those of the transition regions included; lines 1 to cells - 1 are
    // inner ones. MESH_TRIANGLE_RING: cells_u along a side of the inner triangle, which may be 0: a point. MESH_TRIANGLE_GRID: cells_u
    // along a side. Else 0.
    // Where a side is a point, two triangles may have the same corners, and face opposite ways, unless there are 3 cells at least in both
    // directions (2 in a MESH_TRIANGLE_RING) and inner lines lie as far from one side as from the others.
    uint cells_u;
    uint cells_v;
    // Where the first and the last inner line lie, units of 2^-24; the others evenly between. MESH_TRIANGLE_RING: the inner triangle has
    // u >= low_u, v >= low_v and u + v <= high_u.
    uint low_u;
    uint high_u;
    uint low_v;
    uint high_v;
    uint refused;  // 0 or 1: its tolerance asks for more than MESH_RATE_MOST
    uint turned;   // 0 or 1: triangles turn clockwise in (u, v), and normals are against du x dv, as its neighbours have it (orientation.h)
} mesh_pattern;

// What lies before a patch in all units, vertices (those of its units: what two units share stands twice) and triangles.
typedef struct {
    ulong units;
    ulong vertices;
    ulong triangles;
} mesh_offset;

// Patches that one work-group counts: a block of offsets.cl's scan.
#define MESH_SCAN_BLOCK 1024u

// What a run of patches comes to.
typedef struct {
    mesh_offset sum;
    ulong distinct;       // vertices, those that units share counted once
    ulong nothing;        // patches of MESH_NOTHING
    ulong refused;        // patches that are `refused`
    ulong first_refused;  // index among all patches; their number where none is
} mesh_totals;

// What a patch's rates are measured by. Nets are in world space.
typedef struct {
    uint patches;
    uint first_patch;          // of these, among all placed patches
    uint view;                 // 0 or 1: whether tolerances grow with the distance from the camera
    uint cull;                 // 0 or 1: whether patches outside the view are left out
    float tolerance;           // world units; with `view` per unit of depth
    float least_tolerance;     // world units: what positions can hold; no tolerance is less
    float near_plane;          // world units
    float depth_share;         // what a point in the view has at least of depth per distance from the eye
    float eye_from_world[12];  // three rows of four; z is depth
    // Planes through the eye along the picture's sides: a point is inside where |x| <= slope_x * z and |y| <= slope_y * z.
    float slope_x;
    float slope_y;
} mesh_view;

// MeshVertex (tessera/tessellator.h, which says what its members are) as kernels write it.
typedef struct {
    float position[3];
    float normal[3];
    float u, v;
    uint object;
    uint patch;
} mesh_vertex;

// Units to be made: a run of those of all the patches here.
typedef struct {
    uint patches;
    uint positions_only;  // 0 or 1: vertices are three floats
    ulong first_unit;
    ulong units;
    ulong first_vertex;    // of the first unit: the buffer's first
    ulong first_triangle;  // of the first unit: the buffer's first
} mesh_piece;

TESSERA_SHARED_END

#endif
