// One iteration of bound and split in the watertight mode. Queues, counters and passes are those of split.cl, with ranges of 44 bytes:
//   quad_bound    stack, patches -> batch (edges measured, grids sized), actions, cuts (rates of a split's new edges), chunk_sums
//   split_scan    (split.cl)
//   quad_scatter  batch, actions, cuts, chunk_sums -> stack, ready
// A work-group takes QUAD_GROUP ranges at a time through the phases of quad_phases.clh.
#include "split/plan.clh"
#include "split/quad_phases.clh"

// Loads the ranges [first, first + count) of an iteration.
static inline void fetch_quads(const frame_params* frame, split_plan plan, global const split_state* state, global const uint* feed,
                               global const quad_range* stack, uint first, uint count, local quad_range* quads) {
    for (uint k = (uint)get_local_id(0); k < count; k += GROUP) {
        uint i = first + k;
        quads[k] = i < plan.fresh ? whole_patch(frame, feed[state->next_input + i]) : stack[plan.stack_base + (i - plan.fresh)];
    }
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void quad_bound(
    frame_params frame, split_limits limits, global const float* eye_points, global const float* dicing_points,
    global const placed_patch* patches, global const edge_info* records, global const uint* feed, global const uint* coarse,
    global const quad_range* stack, global quad_range* batch, global uchar* actions, global quad_cut* cuts, global chunk_sum* chunk_sums,
    global const split_state* state) {
    local quad_range quads[QUAD_GROUP];
    local quad_interior interiors[QUAD_GROUP];
    local quad_cut new_cuts[QUAD_GROUP];
    local int action[QUAD_GROUP], outside[QUAD_HULLS], u[QUAD_PLACES], v[QUAD_PLACES];
    local float x[QUAD_PLACES_READ], y[QUAD_PLACES_READ], along[QUAD_PLACES], across[QUAD_HULLS];
    local float screen_x[QUAD_HULLS], screen_y[QUAD_HULLS], depth[QUAD_HULLS], slack[QUAD_HULLS];
    quad_work work = {quads, action, interiors, new_cuts, u, v, x, y, along, across, outside, screen_x, screen_y, depth, slack};
    local chunk_sum partial[GROUP];
    quad_source source = {eye_points, dicing_points, patches, records, coarse, false};
    split_plan plan = plan_iteration(state, limits);
    for (uint chunk = (uint)get_group_id(0); chunk * SPLIT_CHUNK < plan.count; chunk += (uint)get_num_groups(0)) {
        chunk_sum sum = no_ranges();
        uint begin = chunk * SPLIT_CHUNK;
        uint end = min(begin + SPLIT_CHUNK, plan.count);
        for (uint i = begin; i < end; i += QUAD_GROUP) {
            uint count = min((uint)QUAD_GROUP, end - i);
            fetch_quads(&frame, plan, state, feed, stack, i, count, work.quad);
            source.looks = looks_behind(&frame, state, i / QUAD_GROUP);
            sum.looked += source.looks && get_local_id(0) == 0 ? count : 0u;
            barrier(CLK_LOCAL_MEM_FENCE);
            bound_quads(&frame, source, count, i < plan.fresh ? min(count, plan.fresh - i) : 0u, work, &sum);
            for (uint k = (uint)get_local_id(0); k < count; k += GROUP) {
                batch[i + k] = work.quad[k];
                actions[i + k] = (uchar)work.action[k];
                if (work.action[k] >= QUAD_SPLIT) cuts[i + k] = work.cut[k];
            }
            barrier(CLK_LOCAL_MEM_FENCE);
        }
        write_chunk_sum(sum, chunk_sums + chunk, partial);
    }
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void quad_scatter(split_limits limits, global const quad_range* batch,
                                                                            global const uchar* actions, global const quad_cut* cuts,
                                                                            global const chunk_sum* chunk_sums,
                                                                            global const split_state* state, global quad_range* stack,
                                                                            global quad_range* ready) {
    local chunk_sum partial[GROUP];
    local quad_range parents[GROUP];
    uint lid = (uint)get_local_id(0);
    split_plan plan = plan_iteration(state, limits);
    for (uint chunk = (uint)get_group_id(0); chunk * SPLIT_CHUNK < plan.count; chunk += (uint)get_num_groups(0)) {
        uint run = SPLIT_CHUNK / GROUP;
        uint begin = min(chunk * SPLIT_CHUNK + lid * run, plan.count);
        uint end = min(begin + run, plan.count);
        chunk_sum sum = no_ranges();
        for (uint i = begin; i < end; ++i) add_quad(&sum, actions[i], 0u);
        partial[lid] = sum;
        barrier(CLK_LOCAL_MEM_FENCE);
        chunk_sum before = chunk_sums[chunk];
        for (uint k = 0; k < lid; ++k) add_sum(&before, partial[k]);
        uint child_slot = plan.stack_base + 2u * before.splits;
        uint ready_slot = state->ready_count + before.dices;
        for (uint i = begin; i < end; ++i) {
            int action = actions[i];
            if (action >= QUAD_SPLIT) {
                parents[lid] = batch[i];
                for (int k = 0; k < 2; ++k) stack[child_slot + k] = quad_child(parents + lid, action - QUAD_SPLIT, cuts[i], k);
                child_slot += 2u;
            } else if (action == QUAD_DICE) {
                ready[ready_slot++] = batch[i];
            }
        }
        barrier(CLK_LOCAL_MEM_FENCE);
    }
}
