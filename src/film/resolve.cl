// resolve_samples: turns the batch's visible samples into surface references, since ids of successive batches collide.
// The last batch needs none of it: nothing comes after it.
// In:   samples, touched; ready (the batch's ranges).
// Out:  references (patch, u, v of the micropolygon's middle) of samples whose id is not 0, whose ids become 0.
//       Tiles that the batch did not touch are not looked at. A work-group a tile at a time.
// Bound: 12 bytes a sample for the references, in three arrays.
// batch_done: empties `ready` for the next batch. One work-item.
#include "device/lanes.clh"
#include "film/batch.clh"
#include "film/film.clh"

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void resolve_samples(frame_params frame, split_limits limits,
                                                                               global const split_state* state, global const uint* ready,
                                                                               global uint2* samples, global uchar* touched,
                                                                               global uint* reference_patch, global float* reference_u,
                                                                               global float* reference_v) {
    if (batch_to_hide(&frame, state, limits) == 0u || batch_is_last(&frame, state)) return;
    int side = frame.tile_cells;
    int count = side * side;
    tile_run run = tiles_of_group(&frame);
    for (int tile = run.begin; tile < run.end; ++tile) {
        if (touched[tile] != TILE_NEW) continue;
        for (int i = (int)get_local_id(0); i < count; i += GROUP) {
            size_t s = (size_t)tile * count + i;
            uint2 key = samples[s];  // id, depth
            if (key.x == 0u || (key.x & key.y) == 0xffffffffu) continue;
            surface_reference reference = reference_of(&frame, ready, key.x);
            reference_patch[s] = reference.patch_index;
            reference_u[s] = reference.u;
            reference_v[s] = reference.v;
            samples[s].x = 0u;
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        if (get_local_id(0) == 0) touched[tile] = TILE_SEEN;
    }
}

kernel void batch_done(frame_params frame, split_limits limits, global split_state* state) {
    if (batch_to_hide(&frame, state, limits) == 0u) return;
    state->ready_count = 0u;
    state->batches += 1u;
}
