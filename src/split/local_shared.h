// The local method's queues (local.clh): how many groups share the work, and what each of them leaves for the next launch.
#ifndef TESSERA_SPLIT_LOCAL_SHARED_H
#define TESSERA_SPLIT_LOCAL_SHARED_H

#include "split/quad_shared.h"
#include "split/range_shared.h"

TESSERA_SHARED_BEGIN

// Levels (cuts from the patch) that a range on a stack may have: 0 to 24 in either mode.
#define LOCAL_LEVELS 25

// Ranges that a group takes at a time, at most.
#define LOCAL_QUADS_MOST QUAD_GROUP
#define LOCAL_BOXES_MOST 64

// Local memory that the kernels take beside a group's stack, bytes at most; they don't compile where it is more.
#define LOCAL_QUADS_SCRATCH 20480
#define LOCAL_BOXES_SCRATCH 18432

typedef struct {
    uint groups;
    uint width;        // ranges that a group takes at a time
    uint most_rounds;  // of a launch
} local_limits;

// Of all groups.
typedef struct {
    uint turn;   // 0 or 1: which half of the pool the next launch takes from
    uint fed;    // entries of `feed` that the groups of this launch took
    uint diced;  // places in `ready` that they took
} local_run;

// Of one group.
typedef struct {
    chunk_sum sum;   // of a launch
    uint processed;  // in a launch
    uint peak;       // ranges on its stack, most in a launch
    uint frame_low;  // ranges that it bounded in the frame, 64 bits
    uint frame_high;
    uint starts[LOCAL_LEVELS + 1];  // of the ranges that it left in the pool: how many have fewer cuts than k
} local_group;

// Of the ranges of one level that one group left, where they come in the order of all, and what takes a rank to a place in the pool.
typedef struct {
    uint first;
    uint shift;  // modulo 2^32
} local_rank;

TESSERA_SHARED_END

#endif
