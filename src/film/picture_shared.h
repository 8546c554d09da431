// The planes of a picture in its buffer.
#ifndef TESSERA_FILM_PICTURE_SHARED_H
#define TESSERA_FILM_PICTURE_SHARED_H

#include "core/types_shared.h"

TESSERA_SHARED_BEGIN

// Where each plane begins, in floats; NO_PLANE where it is not wanted. The first is rgba, at 0.
#define NO_PLANE 0xffffffffu

typedef struct {
    uint z;
    uint normal;
    uint object;
    uint patch_id;
    uint uv;
} picture_planes;

TESSERA_SHARED_END

#endif
