// One iteration of bound and split in the classical mode, in three kernels; `breadth` and `bounded` differ in the batch size alone.
// split_scan serves the watertight mode too (quad_split.cl).
// After Weber and Owens, "Parallel Reyes-style Adaptive Subdivision with Bounded Memory Usage" (2015), with a lazy feed.
//
// Queues:   stack  ranges sorted by level, deepest at the end; at most (K + 1) p. Children go back to its end in order.
//           batch  the iteration's <= p ranges: fresh patches first (level 0), then the stack's end; keeps the order of levels.
//           ready  diceable ranges; room for split_limits.ready_capacity >= p. An iteration runs only while p are free.
// Counters: split_state, on the device. Of these kernels only split_scan (one group) changes it, so the others may read it freely.
// Passes:   split_bound    stack, patches -> batch, actions, chunk_sums (of each SPLIT_CHUNK ranges)
//           split_scan     chunk_sums -> their exclusive sums; takes the batch off the stack and books its children
//           split_scatter  batch, actions, chunk_sums -> stack, ready
// Slots come from scans, never from atomics: the order of ranges, and so the picture, is always the same.
#include "core/frame_shared.h"
#include "device/lanes.clh"
#include "split/plan.clh"
#include "split/range.clh"
#define NET_SPACE local
#include "split/bound.clh"
#include "surface/patch_nets.clh"

static inline range_t fetch_range(split_plan plan, global const split_state* state, global const range_t* stack, uint i) {
    range_t range;
    if (i < plan.fresh) {
        range.patch_index = state->next_input + i;
        range.u_side = 0u;
        range.v_side = 0u;
    } else {
        range = stack[plan.stack_base + (i - plan.fresh)];
    }
    return range;
}

static inline void add_action(chunk_sum* sum, uint action, range_t range) {
    sum->splits += action >= ACTION_SPLIT_U ? 1u : 0u;
    sum->dices += action == ACTION_DICE ? 1u : 0u;
    sum->area += action < ACTION_SPLIT_U ? range_side_size(range.u_side) * range_side_size(range.v_side) : 0.0f;
}

// Copies a range's control points into one lane's column of the group's scratch.
static inline void load_net(const frame_params* frame, global const float* eye_points, uint patch_index, local float* column, int stride) {
    int count = patch_point_count(frame, patch_index);
    global const float* net = eye_points + patch_offset(frame, patch_index);
    for (int c = 0; c < 3; ++c) {
        local float* to = column + c * 20 * stride;
        // Unrolled, or LLVM vectorises the copy into scatters, which take twice the time of the bounding.
#pragma unroll
        for (int k = 0; k < 16; ++k) to[k * stride] = net[k];
        if (count == GREGORY_POINTS) {
            for (int k = 16; k < 20; ++k) to[k * stride] = net[k];
        } else if (frame->bezier_patches < frame->patches) {
            // A Gregory patch may stand in another lane (bound.clh).
            to[16 * stride] = net[5];
            to[17 * stride] = net[6];
            to[18 * stride] = net[10];
            to[19 * stride] = net[9];
        }
        net += count;
    }
}

// Bounds the LANES ranges from `first` on and copies them to the batch.
static inline vint bound_lanes(const frame_params* frame, split_plan plan, global const float* eye_points, global const range_t* stack,
                               global range_t* batch, global const split_state* state, uint first, local float* net, int stride) {
    float u0[LANES], v0[LANES], u_size[LANES], v_size[LANES];
    int u_level[LANES], v_level[LANES], gregory[LANES];
    for (uint k = 0; k < LANES; ++k) {
        // Lanes past the end repeat the last range; nobody looks at what they decide.
        range_t range = fetch_range(plan, state, stack, min(first + k, plan.count - 1u));
        if (first + k < plan.count) batch[first + k] = range;
        load_net(frame, eye_points, range.patch_index, net + k, stride);
        u_size[k] = range_side_size(range.u_side);
        v_size[k] = range_side_size(range.v_side);
        u0[k] = (float)(range.u_side & SIDE_INDEX_MASK) * u_size[k];
        v0[k] = (float)(range.v_side & SIDE_INDEX_MASK) * v_size[k];
        u_level[k] = (int)(range.u_side >> SIDE_LEVEL_SHIFT);
        v_level[k] = (int)(range.v_side >> SIDE_LEVEL_SHIFT);
        gregory[k] = range.patch_index < frame->bezier_patches ? 0 : -1;
    }
    return bound_ranges(frame, net, stride, load_lanes(u0), load_lanes(v0), load_lanes(u_size), load_lanes(v_size), load_lanes(u_level),
                        load_lanes(v_level), load_lanes(gregory));
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void split_bound(frame_params frame, split_limits limits,
                                                                           global const float* eye_points, global const range_t* stack,
                                                                           global range_t* batch, global uchar* actions,
                                                                           global chunk_sum* chunk_sums, global const split_state* state) {
    local float nets[60 * GROUP * LANES];
    local chunk_sum partial[GROUP];
    uint lid = (uint)get_local_id(0);
    split_plan plan = plan_iteration(&frame, state, limits);
    for (uint chunk = (uint)get_group_id(0); chunk * SPLIT_CHUNK < plan.count; chunk += (uint)get_num_groups(0)) {
        chunk_sum sum = no_ranges();
        uint begin = chunk * SPLIT_CHUNK;
        uint end = min(begin + SPLIT_CHUNK, plan.count);
        for (uint i = begin + lid * LANES; i < end; i += GROUP * LANES) {
            int action[LANES];
            store_lanes(bound_lanes(&frame, plan, eye_points, stack, batch, state, i, nets + lid * LANES, GROUP * LANES), action);
            for (uint k = 0; k < LANES && i + k < end; ++k) {
                actions[i + k] = (uchar)action[k];
                add_action(&sum, (uint)action[k], batch[i + k]);
            }
        }
        partial[lid] = sum;
        barrier(CLK_LOCAL_MEM_FENCE);
        if (lid == 0) {
            for (uint k = 1; k < GROUP; ++k) add_sum(&sum, partial[k]);
            chunk_sums[chunk] = sum;
        }
        barrier(CLK_LOCAL_MEM_FENCE);
    }
}

static inline void add_wide(global uint* low, global uint* high, uint value) {
    uint sum = *low + value;
    if (sum < value) *high += 1u;
    *low = sum;
}

static inline void book_iteration(split_plan plan, global split_state* state, chunk_sum total) {
    uint splits = total.splits, dices = total.dices;
    state->batch_count = plan.count;
    state->stack_base = plan.stack_base;
    state->ready_base = state->ready_count;
    if (plan.count == 0u) return;
    state->stack_peak = max(state->stack_peak, state->stack_count + plan.fresh);
    state->stack_count = plan.stack_base + 2u * splits;
    state->next_input += plan.fresh;
    state->ready_count += dices;
    state->iterations += 1u;
    state->area_done += total.area;
    add_wide(&state->processed_low, &state->processed_high, plan.count);
    add_wide(&state->diced_low, &state->diced_high, dices);
    add_wide(&state->culled_low, &state->culled_high, plan.count - splits - dices);
    add_wide(&state->micropolygons_low, &state->micropolygons_high, total.micropolygons);
}

// One group: each work-item sums a run of chunks, then turns the run into exclusive sums.
kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void split_scan(frame_params frame, split_limits limits,
                                                                          global chunk_sum* chunk_sums, global split_state* state) {
    local chunk_sum partial[GROUP];
    uint lid = (uint)get_local_id(0);
    split_plan plan = plan_iteration(&frame, state, limits);
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
    barrier(CLK_GLOBAL_MEM_FENCE | CLK_LOCAL_MEM_FENCE);
    // The last work-item's sum is the total: those behind the last chunk hold it too.
    if (lid == GROUP - 1u) book_iteration(plan, state, before);
}

// A parent's children keep its place and order (thesis, section 4.2): what the proof of the stack's bound rests on.
static inline void place_children(range_t parent, uint action, global range_t* stack, uint slot) {
    range_t child = parent;
    uint side = action == ACTION_SPLIT_U ? parent.u_side : parent.v_side;
    uint level = (side >> SIDE_LEVEL_SHIFT) + 1u;
    uint index = (side & SIDE_INDEX_MASK) << 1;
    for (uint k = 0; k < 2u; ++k) {
        uint half_side = (level << SIDE_LEVEL_SHIFT) | (index + k);
        if (action == ACTION_SPLIT_U)
            child.u_side = half_side;
        else
            child.v_side = half_side;
        stack[slot + k] = child;
    }
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void split_scatter(global const range_t* batch, global const uchar* actions,
                                                                             global const chunk_sum* chunk_sums,
                                                                             global const split_state* state, global range_t* stack,
                                                                             global range_t* ready) {
    local chunk_sum partial[GROUP];
    uint lid = (uint)get_local_id(0);
    uint count = state->batch_count;
    for (uint chunk = (uint)get_group_id(0); chunk * SPLIT_CHUNK < count; chunk += (uint)get_num_groups(0)) {
        uint run = SPLIT_CHUNK / GROUP;
        uint begin = min(chunk * SPLIT_CHUNK + lid * run, count);
        uint end = min(begin + run, count);
        chunk_sum sum = no_ranges();
        for (uint i = begin; i < end; ++i) add_action(&sum, actions[i], batch[i]);
        partial[lid] = sum;
        barrier(CLK_LOCAL_MEM_FENCE);
        chunk_sum before = chunk_sums[chunk];
        for (uint k = 0; k < lid; ++k) add_sum(&before, partial[k]);
        uint child_slot = state->stack_base + 2u * before.splits;
        uint ready_slot = state->ready_base + before.dices;
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
