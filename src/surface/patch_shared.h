// How control points lie on the device, and the objects that place them.
#ifndef TESSERA_SURFACE_PATCH_SHARED_H
#define TESSERA_SURFACE_PATCH_SHARED_H

#include "core/types_shared.h"

TESSERA_SHARED_BEGIN

// Kinds of patches, in the order in which they stand in the patch set.
#define KIND_BEZIER 0
#define KIND_GREGORY 1
#define KIND_RATIONAL 2
#define KIND_PN 3

#define BEZIER_POINTS 16
#define GREGORY_POINTS 20

// Floats of a patch's net in eye space.
#define BEZIER_FLOATS 48    // x[16], y[16], z[16]
#define GREGORY_FLOATS 60   // x[20], y[20], z[20], in net order (gregory.clh)
#define RATIONAL_FLOATS 76  // homogeneous xw[16], yw[16], zw[16], w[16]; then the corners' x[4], y[4], z[4] at (0,0), (1,0), (0,1), (1,1)
#define PN_FLOATS 48        // x[16], y[16], z[16]: 10 points and 6 normals
#define RECORD_FLOATS 16    // an edge record's curve: homogeneous xw[4], yw[4], zw[4], w[4]

// placed_patch.flags: bit k says that side k is one point, bit 4 + k that it has a record; sides as in EdgeRecord (tessera/scene.h).
#define SIDE_DEGENERATE 1u
#define SIDE_RECORDED 16u

// A patch of an object: where its floats begin (x, y, z of points in file order; a rational patch's with w, multiplied by it) and whose
// it is.
typedef struct {
    uint first_float;
    uint object;
    uint index_in_mesh;
    uint flags;
    uint first_record;  // of its records, in the order of sides
} placed_patch;

// What draws a border in the place of its own curve: the part [index, index + 1] / 2^level of a curve (EdgeRecord, tessera/scene.h).
typedef struct {
    uint first_float;  // of four points x, y, z, w, multiplied by w
    uint object;
    uint level;
    uint index;
    uint reversed;
    uint rational;  // 0: all weights are 1
    uint cuts;
} edge_info;

// What a patch may cover: tiles of 8 x 8 pixels of the full picture, the first in the lower 16 bits, the last in the upper ones, none
// where the first is greater; and its least depth.
typedef struct {
    uint columns;
    uint rows;
    float nearest;
} patch_box;

// An object as one frame sees it.
typedef struct {
    float eye_from_object[12];  // three rows of four; the third gives the depth
    float color[3];
    float specular;   // strength of the highlight; 0 for matte
    float shininess;  // Blinn-Phong exponent
    uint id;          // index into Scene::objects
} placed_object;

TESSERA_SHARED_END

#endif
