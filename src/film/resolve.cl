// resolve_samples: turns the visible samples of what is in `ready` into surface references, since ids of what comes next would collide.
// The last ranges need none of it: nothing comes after them.
// In:   samples, touched; ready; the counts.
// Out:  references (patch, u, v of the micropolygon's middle) of samples whose id is not 0, whose ids become 0; the counts after hiding,
//       with `ready` empty where it was resolved. It is the last pass of hiding and books it.
//       Tiles that were not touched are not looked at. A work-group a tile at a time.
// Bound: 12 bytes a sample for the references, in three arrays.
#include "device/lanes.clh"
#include "film/batch.clh"
#include "film/film.clh"

static inline void book_hiding(const frame_params* frame, split_limits limits, global const split_state* before,
                               global split_state* after) {
    split_state state = *before;
    if (hide_is_due(before, limits)) {
        state.hidden = state.ready_count;
        state.batches += 1u;
    }
    if (resolve_is_due(frame, before, limits)) {
        state.hidden = 0u;
        state.ready_count = 0u;
    }
    *after = state;
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void resolve_samples(frame_params frame, split_limits limits,
                                                                               global const split_state* state, global split_state* after,
                                                                               global const uint* ready, global uint2* samples,
                                                                               global uchar* touched, global uint* reference_patch,
                                                                               global float* reference_u, global float* reference_v) {
    if (get_global_id(0) == 0) book_hiding(&frame, limits, state, after);
    if (!resolve_is_due(&frame, state, limits)) return;
    int side = frame.tile_cells;
    int count = side * side;
    tile_run run = tiles_of_group(&frame);
    for (int tile = run.begin; tile < run.end; ++tile) {
        if ((touched[tile] & TILE_NEW) == 0) continue;
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
