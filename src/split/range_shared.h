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
    uint occluded;       // of the culled ones
    uint looked;         // that were held against what is drawn
    float area;
} chunk_sum;

// The split stage's counts, which live on the device. `stack` holds ranges sorted by level, `ready` the diceable ones. A kernel that
// changes them reads one copy and writes another, so that all of its groups see the same.
typedef struct {
    uint stack_count;
    uint next_input;   // entries [next_input, feed_count) of `feed` wait
    uint feed_count;   // patches that may be seen
    uint ready_count;  // diceable ranges
    uint hidden;       // the first of them are drawn already
    // How much looking at what is drawn has brought of late: ranges held against it, and those of them that lay behind it.
    uint looked;
    uint found;
    // Statistics of the frame; 64-bit counts as low and high words.
    uint processed_low;
    uint processed_high;
    uint diced_low;
    uint diced_high;
    uint culled_low;
    uint culled_high;
    uint occluded_low;  // of the culled ones
    uint occluded_high;
    uint micropolygons_low;
    uint micropolygons_high;
    uint stack_peak;
    uint iterations;
    uint run_iterations;  // since patches were last fed
    uint batches;
    uint skipped_low;  // patches that were not fed: their boxes lie outside
    uint skipped_high;
    uint pixels_covered;
    float area_done;  // of the patches on the device, since they were fed: how far it is
} split_state;

// What bounds the split stage: p, the room for diceable ranges (at least p), and how many of them are collected before they are diced.
typedef struct {
    uint batch;
    uint ready_capacity;
    uint collect;
} split_limits;

TESSERA_SHARED_END

#endif
