// local_boxes: a launch of the local method in the classical mode (local.clh). A group takes its share of the pool, bounds and splits for a
// number of rounds, and leaves what is on its stack.
#include "split/box_lanes.clh"
#include "split/local.clh"

// A group's ranges, and what its work-items tell each other.
typedef struct {
    float nets[60 * GROUP * LANES];
    range_t box[LOCAL_BOXES_MOST];
    int action[LOCAL_BOXES_MOST];
    uint places[LOCAL_BOXES_MOST];
    chunk_sum partial[GROUP];
    local_round round;
} local_box_group;

// The host counts on this where it chooses how many ranges a group takes at a time: a negative size does not compile.
typedef char local_boxes_scratch[sizeof(local_box_group) <= LOCAL_BOXES_SCRATCH ? 1 : -1];

static inline uint box_level(range_t box) { return (box.u_side >> SIDE_LEVEL_SHIFT) + (box.v_side >> SIDE_LEVEL_SHIFT); }

// Bounds the round's ranges: fresh patches first, then the stack's from `base` on.
static inline void bound_round(const frame_params* frame, global const float* eye_points, global const uint* feed,
                               const local range_t* stack, uint base, uint count, local local_box_group* group, chunk_sum* sum) {
    uint lid = (uint)get_local_id(0), fresh = group->round.fresh;
    local float* net = group->nets + lid * LANES;
    for (uint first = lid * LANES; first < count; first += GROUP * LANES) {
        box_lanes lanes;
        for (uint k = 0; k < LANES; ++k) {
            // Lanes past the end repeat the last range; nobody looks at what they decide.
            uint i = min(first + k, count - 1u);
            range_t box = {0u, 0u, 0u};
            if (i < fresh)
                box.patch_index = feed[group->round.first_fresh + i];
            else
                box = stack[base + (i - fresh)];
            if (first + k < count) group->box[i] = box;
            set_box(frame, eye_points, box, k, &lanes, net, GROUP * LANES);
        }
        int action[LANES];
        store_lanes(bound_boxes(frame, &lanes, net, GROUP * LANES), action);
        for (uint k = 0; k < LANES && first + k < count; ++k) {
            group->action[first + k] = action[k];
            add_action(sum, (uint)action[k], group->box[first + k]);
        }
    }
}

// Puts the children on the stack from `base` on, and what is to be diced into `ready`.
static inline void scatter_boxes(uint count, uint base, local range_t* stack, global range_t* ready, local local_box_group* group) {
    for (uint k = (uint)get_local_id(0); k < count; k += GROUP) {
        int action = group->action[k];
        uint slot = group->places[k];
        if (action >= ACTION_SPLIT_U) {
            for (uint which = 0; which < 2u; ++which) stack[base + 2u * slot + which] = box_child(group->box[k], (uint)action, which);
        } else if (action == ACTION_DICE) {
            ready[group->round.ready_slot + slot] = group->box[k];
        }
    }
}

// Leaves the stack in the group's places of the pool.
static inline void leave_boxes(const local range_t* stack, uint n, global range_t* pool, global local_group* left) {
    for (uint i = (uint)get_local_id(0); i <= n; i += GROUP) {
        note_starts(i, n, i > 0u ? box_level(stack[i - 1]) : 0u, i < n ? box_level(stack[i]) : 0u, left);
        if (i < n) pool[i] = stack[i];
    }
}

// `stack`: stack_room(shape) ranges.
kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void local_boxes(frame_params frame, split_limits limits, local_limits shape,
                                                                           global const float* eye_points, global const uint* feed,
                                                                           global const split_state* state, global local_run* run,
                                                                           global local_group* groups, global const local_rank* ranks,
                                                                           global range_t* pool, global range_t* ready,
                                                                           local range_t* stack) {
    local local_box_group group;
    uint lid = (uint)get_local_id(0), g = (uint)get_group_id(0);
    uint rounds = plan_rounds(state, limits, shape);
    uint half_pool = shape.groups * stack_room(shape);
    uint n = rounds > 0u ? dealt_to(g, state, shape) : 0u;
    for (uint k = lid; k < n; k += GROUP) stack[k] = pool[run->turn * half_pool + pool_place(g + k * shape.groups, ranks, shape)];
    chunk_sum sum = no_ranges();
    uint processed = 0u, peak = n;
    // All work-items know the same n and count, so they go through the same barriers.
    for (uint i = 0u; i < rounds; ++i) {
        uint taken = min(n, shape.width);
        if (lid == 0) group.round.first_fresh = take_fresh(state, &run->fed, shape, shape.width - taken, &group.round.fresh);
        barrier(CLK_LOCAL_MEM_FENCE);
        uint count = group.round.fresh + taken;
        n -= taken;
        bound_round(&frame, eye_points, feed, stack, n, count, &group, &sum);
        barrier(CLK_LOCAL_MEM_FENCE);
        if (lid == 0) place_round(group.action, count, state, &run->diced, group.places, &group.round);
        barrier(CLK_LOCAL_MEM_FENCE);
        scatter_boxes(count, n, stack, ready, &group);
        n += 2u * group.round.splits;
        processed += count;
        peak = max(peak, n);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    if (rounds > 0u) leave_boxes(stack, n, pool + (1u - run->turn) * half_pool + g * stack_room(shape), groups + g);
    write_group(sum, processed, peak, groups + g, group.partial);
}
