// coarse_depth: how far each tile can be seen into, for culling ranges behind what is drawn (split/occlusion.clh).
// In:   samples, touched: only tiles hit since their key was taken are looked at.
// Out:  coarse: for every tile the key ~bits(1/z) of its farthest sample (all ones while any is background), then for every block of
//       8 x 8 tiles the farthest of its tiles' keys; TILE_DEEPER cleared.
// Runs: between hiding and resolving, when ranges were hidden and more are to be split, of these patches or of others. A work-group takes
//       a block at a time.
#include "film/batch.clh"
#include "film/film.clh"
#include "split/occlusion.clh"

#define BLOCK_TILES (COARSE_BLOCK * COARSE_BLOCK)

static inline uint farthest_key(const frame_params* frame, global const uint2* samples, int tile) {
    int count = frame->tile_cells * frame->tile_cells;
    global const uint2* sample = samples + (size_t)tile * count;
    uint key = 0u;
    for (int k = 0; k < count; ++k) key = max(key, sample[k].y);
    return key;
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void coarse_depth(frame_params frame, split_limits limits,
                                                                            global const split_state* state, global const uint2* samples,
                                                                            global uchar* touched, global uint* coarse) {
    local uint keys[BLOCK_TILES];
    local int dirty;
    // Behind the last chunk's last ranges it is of no use, but which chunk is the last the device does not know.
    bool more = !split_is_over(state) || frame.streamed != 0u;
    if (!more || !hide_is_due(state, limits)) return;
    int lid = (int)get_local_id(0);
    int tiles_y = frame.tiles / frame.tiles_x;
    int blocks_x = (frame.tiles_x + COARSE_BLOCK - 1) / COARSE_BLOCK;
    int blocks = blocks_x * ((tiles_y + COARSE_BLOCK - 1) / COARSE_BLOCK);
    for (int block = (int)get_group_id(0); block < blocks; block += (int)get_num_groups(0)) {
        int block_y = block / blocks_x;
        if (lid == 0) dirty = 0;
        barrier(CLK_LOCAL_MEM_FENCE);
        for (int t = lid; t < BLOCK_TILES; t += GROUP) {
            int x = (block - block_y * blocks_x) * COARSE_BLOCK + t % COARSE_BLOCK, y = block_y * COARSE_BLOCK + t / COARSE_BLOCK;
            int tile = y * frame.tiles_x + x;
            keys[t] = 0u;
            if (x >= frame.tiles_x || y >= tiles_y) continue;
            if (touched[tile] & TILE_DEEPER) {
                coarse[tile] = farthest_key(&frame, samples, tile);
                touched[tile] &= (uchar)~TILE_DEEPER;
                dirty = 1;
            }
            keys[t] = coarse[tile];
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        if (lid == 0 && dirty != 0) {
            uint key = keys[0];
            for (int t = 1; t < BLOCK_TILES; ++t) key = max(key, keys[t]);
            coarse[frame.tiles + block] = key;
        }
        barrier(CLK_LOCAL_MEM_FENCE);
    }
}
