// A point on a patch, as evaluate_points takes it.
#ifndef TESSERA_SURFACE_EVALUATE_SHARED_H
#define TESSERA_SURFACE_EVALUATE_SHARED_H

#include "core/types_shared.h"

TESSERA_SHARED_BEGIN

typedef struct {
    uint patch_index;
    float u;
    float v;
} evaluate_point;

TESSERA_SHARED_END

#endif
