// A range is a piece of one patch, [u0,u1] x [v0,v1], cut by halving: never a copy of control points.
#ifndef TESSERA_SPLIT_RANGE_SHARED_H
#define TESSERA_SPLIT_RANGE_SHARED_H

#include "core/types_shared.h"

TESSERA_SHARED_BEGIN

// A side's interval [i, i + 1] / 2^level: the level in the upper 5 bits, i in the lower 27. Exact in float up to level 24.
#define SIDE_LEVEL_SHIFT 27u
#define SIDE_INDEX_MASK 0x07ffffffu

typedef struct {
    uint patch_index;
    uint u_side;
    uint v_side;
} range_t;

// What bounding a range decides.
#define ACTION_CULL 0
#define ACTION_DICE 1
#define ACTION_SPLIT_U 2
#define ACTION_SPLIT_V 3

// Ranges that one work-group bounds and places at a time.
#define SPLIT_CHUNK 256

// What a chunk's ranges became, and how much of the patches' parameter area is done with them (diced or culled; a patch is 1).
typedef struct {
    uint splits;
    uint dices;
    uint micropolygons;  // of the diced ones; 0 in classical mode, where all ranges have the same number
    float area;
} chunk_sum;

// The split stage's counts, which live on the device. `stack` holds ranges sorted by level, `ready` the diceable ones.
typedef struct {
    uint stack_count;
    uint next_input;   // patches [next_input, patches) have not been fed yet
    uint ready_count;  // diceable ranges that wait for dicing
    // The iteration under way, set by split_scan for split_scatter.
    uint batch_count;
    uint stack_base;  // where children go
    uint ready_base;  // where diceable ranges go
    // Statistics of the frame; 64-bit counts as low and high words.
    uint processed_low;
    uint processed_high;
    uint diced_low;
    uint diced_high;
    uint culled_low;
    uint culled_high;
    uint micropolygons_low;
    uint micropolygons_high;
    uint stack_peak;
    uint iterations;
    uint batches;
    uint pixels_covered;
    float area_done;  // of `patches`: how far the frame is
} split_state;

// What bounds the split stage: p and the room for diceable ranges (at least p).
typedef struct {
    uint batch;
    uint ready_capacity;
} split_limits;

TESSERA_SHARED_END

#endif
