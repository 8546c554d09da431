// One iteration of bound and split in the classical mode, in three kernels; `breadth` and `bounded` differ in the batch size alone.
// After Weber and Owens, "Parallel Reyes-style Adaptive Subdivision with Bounded Memory Usage" (2015), with a lazy feed.
//
// Queues:   stack  ranges sorted by level, deepest at the end; at most (K + 1) p. Children go back to its end in order.
//           batch  the iteration's <= p ranges: fresh patches first (level 0), then the stack's end; keeps the order of levels.
//           ready  diceable ranges; room for split_limits.ready_capacity >= p. An iteration runs only while p are free.
// split_scan serves the watertight mode too (quad_split.cl).
// Counters: split_state, on the device: all passes read the iteration's, split_scan (one group) writes the next one's.
// Passes:   split_bound    stack, patches -> batch, actions, chunk_sums (of each SPLIT_CHUNK ranges)
//           split_scan     chunk_sums -> their exclusive sums; the next iteration's counts
//           split_scatter  batch, actions, chunk_sums -> stack, ready
// Slots come from scans, never from atomics: the order of ranges, and so the picture, is always the same.
#include "split/box_lanes.clh"

// What an iteration takes its ranges from.
typedef struct {
    split_plan plan;
    global const uint* fresh;  // the patches to be fed
    global const range_t* stack;
} range_source;

static inline range_t fetch_range(range_source from, uint i) {
    range_t range;
    if (i < from.plan.fresh) {
        range.patch_index = from.fresh[i];
        range.u_side = 0u;
        range.v_side = 0u;
    } else {
        range = from.stack[from.plan.stack_base + (i - from.plan.fresh)];
    }
    return range;
}

// Bounds the LANES ranges from `first` on and copies them to the batch.
static inline vint bound_lanes(const frame_params* frame, range_source from, global const float* eye_points, global range_t* batch,
                               uint first, local float* net, int stride) {
    box_lanes lanes;
    for (uint k = 0; k < LANES; ++k) {
        // Lanes past the end repeat the last range; nobody looks at what they decide.
        range_t range = fetch_range(from, min(first + k, from.plan.count - 1u));
        if (first + k < from.plan.count) batch[first + k] = range;
        set_box(frame, eye_points, range, k, &lanes, net, stride);
    }
    return bound_boxes(frame, &lanes, net, stride);
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void split_bound(frame_params frame, split_limits limits,
                                                                           global const float* eye_points, global const uint* feed,
                                                                           global const range_t* stack, global range_t* batch,
                                                                           global uchar* actions, global chunk_sum* chunk_sums,
                                                                           global const split_state* state) {
    local float nets[60 * GROUP * LANES];
    local chunk_sum partial[GROUP];
    uint lid = (uint)get_local_id(0);
    range_source from = {plan_iteration(state, limits), feed + state->next_input, stack};
    for (uint chunk = (uint)get_group_id(0); chunk * SPLIT_CHUNK < from.plan.count; chunk += (uint)get_num_groups(0)) {
        chunk_sum sum = no_ranges();
        uint begin = chunk * SPLIT_CHUNK;
        uint end = min(begin + SPLIT_CHUNK, from.plan.count);
        for (uint i = begin + lid * LANES; i < end; i += GROUP * LANES) {
            int action[LANES];
            store_lanes(bound_lanes(&frame, from, eye_points, batch, i, nets + lid * LANES, GROUP * LANES), action);
            for (uint k = 0; k < LANES && i + k < end; ++k) {
                actions[i + k] = (uchar)action[k];
                add_action(&sum, (uint)action[k], batch[i + k]);
            }
        }
        write_chunk_sum(sum, chunk_sums + chunk, partial);
    }
}

// One group: each work-item sums a run of chunks, then turns the run into exclusive sums.
kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void split_scan(split_limits limits, global chunk_sum* chunk_sums,
                                                                          global const split_state* state, global split_state* after) {
    local chunk_sum partial[GROUP];
    uint lid = (uint)get_local_id(0);
    split_plan plan = plan_iteration(state, limits);
    uint chunks = (plan.count + SPLIT_CHUNK - 1u) / SPLIT_CHUNK;
    uint run = (chunks + GROUP - 1u) / GROUP;
    uint begin = min(lid * run, chunks);
    uint end = min(begin + run, chunks);
    chunk_sum sum = no_ranges();
    for (uint i = begin; i < end; ++i) add_sum(&sum, chunk_sums[i]);
    partial[lid] = sum;
    barrier(CLK_LOCAL_MEM_FENCE);
    chunk_sum before = no_ranges();
    for (uint k = 0; k < lid; ++k) add_sum(&before, partial[k]);
    for (uint i = begin; i < end; ++i) {
        chunk_sum here = chunk_sums[i];
        chunk_sums[i] = before;
        add_sum(&before, here);
    }
    // The last work-item's sum is the total: those behind the last chunk hold it too.
    if (lid == GROUP - 1u) book_iteration(plan, state, after, before);
}

// A parent's children keep its place and order (thesis, section 4.2): what the proof of the stack's bound rests on.
static inline void place_children(range_t parent, uint action, global range_t* stack, uint slot) {
    for (uint k = 0; k < 2u; ++k) stack[slot + k] = box_child(parent, action, k);
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void split_scatter(split_limits limits, global const range_t* batch,
                                                                             global const uchar* actions,
                                                                             global const chunk_sum* chunk_sums,
                                                                             global const split_state* state, global range_t* stack,
                                                                             global range_t* ready) {
    local chunk_sum partial[GROUP];
    uint lid = (uint)get_local_id(0);
    split_plan plan = plan_iteration(state, limits);
    for (uint chunk = (uint)get_group_id(0); chunk * SPLIT_CHUNK < plan.count; chunk += (uint)get_num_groups(0)) {
        uint run = SPLIT_CHUNK / GROUP;
        uint begin = min(chunk * SPLIT_CHUNK + lid * run, plan.count);
        uint end = min(begin + run, plan.count);
        chunk_sum sum = no_ranges();
        for (uint i = begin; i < end; ++i) add_action(&sum, actions[i], batch[i]);
        partial[lid] = sum;
        barrier(CLK_LOCAL_MEM_FENCE);
        chunk_sum before = chunk_sums[chunk];
        for (uint k = 0; k < lid; ++k) add_sum(&before, partial[k]);
        uint child_slot = plan.stack_base + 2u * before.splits;
        uint ready_slot = state->ready_count + before.dices;
        for (uint i = begin; i < end; ++i) {
            uint action = actions[i];
            if (action >= ACTION_SPLIT_U) {
                place_children(batch[i], action, stack, child_slot);
                child_slot += 2u;
            } else if (action == ACTION_DICE) {
                ready[ready_slot++] = batch[i];
            }
        }
        barrier(CLK_LOCAL_MEM_FENCE);
    }
}
