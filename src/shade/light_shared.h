// A light as one frame sees it, in eye space (x right, y up, z the depth along the view axis).
#ifndef TESSERA_SHADE_LIGHT_SHARED_H
#define TESSERA_SHADE_LIGHT_SHARED_H

#include "core/types_shared.h"

TESSERA_SHARED_BEGIN

#define LIGHT_POINT 0u
#define LIGHT_DIRECTIONAL 1u
#define LIGHT_HEMI 2u
#define LIGHT_HEAD 3u  // at the eye, without falloff

typedef struct {
    float place[3];     // point: position; directional: unit vector towards the light; hemi: unit vector to the sky; head: unused
    float radiance[3];  // colour times intensity
    uint kind;
} eye_light;

TESSERA_SHARED_END

#endif
