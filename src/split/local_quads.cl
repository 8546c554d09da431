// local_quads: a launch of the local method in the watertight mode (local.clh has the queues, and why they are never too full). A group
// takes its share of the pool, bounds and splits for a number of rounds, and leaves what is on its stack.
#include "split/local.clh"
#include "split/quad_phases.clh"

// A group's local memory: what quad_work points to, and what its work-items tell each other.
typedef struct {
    quad_range quad[QUAD_GROUP];
    quad_interior interior[QUAD_GROUP];
    quad_cut cut[QUAD_GROUP];
    int action[QUAD_GROUP], outside[QUAD_HULLS], u[QUAD_PLACES], v[QUAD_PLACES];
    float x[QUAD_PLACES_READ], y[QUAD_PLACES_READ], along[QUAD_PLACES], across[QUAD_HULLS];
    float screen_x[QUAD_HULLS], screen_y[QUAD_HULLS], depth[QUAD_HULLS], slack[QUAD_HULLS];
    chunk_sum partial[GROUP];
    local_round round;
    uint places[QUAD_GROUP];
} local_quad_group;

// The host counts on this where it chooses how many ranges a group takes at a time: a negative size does not compile.
typedef char local_quads_scratch[sizeof(local_quad_group) <= LOCAL_QUADS_SCRATCH ? 1 : -1];

static inline uint quad_level(const local quad_range* quad) { return quad_byte(quad->sizes, 0) + quad_byte(quad->sizes, 1); }

// Loads a round's ranges: fresh patches first, then the stack's from `base` on.
static inline void fetch_round(const frame_params* frame, global const uint* feed, const local quad_range* stack, uint base, uint count,
                               local local_quad_group* group) {
    uint fresh = group->round.fresh;
    for (uint k = (uint)get_local_id(0); k < count; k += GROUP)
        group->quad[k] = k < fresh ? whole_patch(frame, feed[group->round.first_fresh + k]) : stack[base + (k - fresh)];
}

// Puts the children on the stack from `base` on, and what is to be diced into `ready`.
static inline void scatter_round(uint count, uint base, local quad_range* stack, global quad_range* ready, local local_quad_group* group) {
    for (uint k = (uint)get_local_id(0); k < count; k += GROUP) {
        int action = group->action[k];
        uint slot = group->places[k];
        if (action >= QUAD_SPLIT) {
            for (int which = 0; which < 2; ++which)
                stack[base + 2u * slot + which] = quad_child(group->quad + k, action - QUAD_SPLIT, group->cut[k], which);
        } else if (action == QUAD_DICE) {
            ready[group->round.ready_slot + slot] = group->quad[k];
        }
    }
}

// Leaves the stack in the group's places of the pool.
static inline void leave_quads(const local quad_range* stack, uint n, global quad_range* pool, global local_group* left) {
    for (uint i = (uint)get_local_id(0); i <= n; i += GROUP) {
        note_starts(i, n, i > 0u ? quad_level(stack + i - 1) : 0u, i < n ? quad_level(stack + i) : 0u, left);
        if (i < n) pool[i] = stack[i];
    }
}

// `stack`: stack_room(shape) ranges.
kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void local_quads(
    frame_params frame, split_limits limits, local_limits shape, global const float* eye_points, global const float* dicing_points,
    global const placed_patch* patches, global const edge_info* records, global const uint* feed, global const uint* coarse,
    global const split_state* state, global local_run* run, global local_group* groups, global const local_rank* ranks,
    global quad_range* pool, global quad_range* ready, local quad_range* stack) {
    local local_quad_group group;
    quad_work work = {group.quad,  group.action, group.interior, group.cut,      group.u,        group.v,     group.x,    group.y,
                      group.along, group.across, group.outside,  group.screen_x, group.screen_y, group.depth, group.slack};
    uint lid = (uint)get_local_id(0), g = (uint)get_group_id(0);
    quad_source source = {eye_points, dicing_points, patches, records, coarse, false};
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
        uint fresh = group.round.fresh;
        uint count = fresh + taken;
        n -= taken;
        fetch_round(&frame, feed, stack, n, count, &group);
        barrier(CLK_LOCAL_MEM_FENCE);
        source.looks = looks_behind(&frame, state, i);
        sum.looked += source.looks && lid == 0 ? count : 0u;
        bound_quads(&frame, source, count, fresh, work, &sum);
        if (lid == 0) place_round(group.action, count, state, &run->diced, group.places, &group.round);
        barrier(CLK_LOCAL_MEM_FENCE);
        scatter_round(count, n, stack, ready, &group);
        n += 2u * group.round.splits;
        processed += count;
        peak = max(peak, n);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    if (rounds > 0u) leave_quads(stack, n, pool + (1u - run->turn) * half_pool + g * stack_room(shape), groups + g);
    write_group(sum, processed, peak, groups + g, group.partial);
}
