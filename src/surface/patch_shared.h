// How control points lie on the device, and the objects that place them.
#ifndef TESSERA_SURFACE_PATCH_SHARED_H
#define TESSERA_SURFACE_PATCH_SHARED_H

#include "core/types_shared.h"

TESSERA_SHARED_BEGIN

#define BEZIER_POINTS 16
#define GREGORY_POINTS 20

// A patch of an object: where its control points begin (in points of x, y, z floats, file order) and whose it is.
typedef struct {
    uint first_point;
    uint object;
    uint index_in_mesh;
} placed_patch;

// An object as one frame sees it.
typedef struct {
    float eye_from_object[12];  // three rows of four; the third gives the depth
    float color[3];
    float specular;   // strength of the highlight; 0 for matte
    float shininess;  // Blinn-Phong exponent
} placed_object;

TESSERA_SHARED_END

#endif
