// feed_patches: which patches are fed, in what order. One work-group.
// In:   boxes (of the patches on the device), the counts so far.
// Out:  feed: indices of patches, at most frame.patches; the counts for them: an empty stack, nothing fed yet, nothing ready.
// Where frame.feed_boxes is set, patches are left out whose boxes miss the film; where frame.occlusion is too, the others go from front to
// back, by a stable counting sort on four steps an octave of depth, so that what hides comes before what it hides, and neighbours stay
// neighbours.
// Each work-item takes a run of patches, counts its bins, and then knows where its patches go: no atomics, the order is always the same.
#include "core/frame_shared.h"
#include "split/plan.clh"
#include "surface/patch_shared.h"

#define FEED_BINS 64
#define FEED_BIN_SHIFT 21  // of a float's bits: its exponent and two bits more

static inline int box_side(uint both, int last) { return (int)(last ? both >> 16 : both & 0xffffu); }

// The patch's bin, or -1 where it is not fed.
static inline int feed_bin(const frame_params* frame, global const patch_box* boxes, uint patch_index) {
    if (!frame->feed_boxes) return 0;
    patch_box box = boxes[patch_index];
    int x0 = box_side(box.columns, 0), x1 = box_side(box.columns, 1), y0 = box_side(box.rows, 0), y1 = box_side(box.rows, 1);
    bool empty = x0 > x1 || y0 > y1;
    bool outside = x1 < frame->box_x0 || x0 > frame->box_x1 || y1 < frame->box_y0 || y0 > frame->box_y1;
    if (empty || outside) return -1;
    if (!frame->occlusion) return 0;
    // Positive floats are in the order of their bits.
    int steps =
        (int)(as_uint(fmax(box.nearest, frame->near_plane)) >> FEED_BIN_SHIFT) - (int)(as_uint(frame->near_plane) >> FEED_BIN_SHIFT);
    return clamp(steps, 0, FEED_BINS - 1);
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void feed_patches(frame_params frame, global const patch_box* boxes,
                                                                            global uint* feed, global const split_state* state,
                                                                            global split_state* after) {
    local uint places[FEED_BINS * GROUP];  // bin by bin
    uint lid = (uint)get_local_id(0);
    uint run = (frame.patches + GROUP - 1u) / GROUP;
    uint begin = min(lid * run, frame.patches);
    uint end = min(begin + run, frame.patches);
    for (uint k = 0; k < FEED_BINS; ++k) places[k * GROUP + lid] = 0u;
    for (uint i = begin; i < end; ++i) {
        int bin = feed_bin(&frame, boxes, i);
        if (bin >= 0) places[(uint)bin * GROUP + lid] += 1u;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (lid == 0) {
        uint fed = 0u;
        for (uint k = 0; k < FEED_BINS * GROUP; ++k) {
            uint count = places[k];
            places[k] = fed;
            fed += count;
        }
        split_state next = *state;
        next.stack_count = 0u;
        next.next_input = 0u;
        next.feed_count = fed;
        // What a bucket before left in `ready` is shaded; breadth has no more room there than it needs for what comes.
        next.ready_count = 0u;
        next.hidden = 0u;
        next.area_done = (float)(frame.patches - fed);
        next.run_iterations = 0u;
        add_wide(&next.skipped_low, &next.skipped_high, frame.patches - fed);
        *after = next;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint i = begin; i < end; ++i) {
        int bin = feed_bin(&frame, boxes, i);
        if (bin >= 0) feed[places[(uint)bin * GROUP + lid]++] = i;
    }
}
