// dice_hide: a work-group takes a range at a time, evaluates its grid into local memory and hides its micropolygons.
// In:     ready (state->ready_count ranges), eye_points.
// Out:    samples, touched (film/film.clh), with ids of micropolygons as film/batch.clh packs them.
// Runs:   when `ready` has too little room for another iteration, or nothing is left to split; else it returns at once.
// Bound:  no global memory beyond the film; a grid of at most 33 x 33 vertices of 12 bytes in local memory.
// The grid holds 24.8 fixed-point screen positions (as bits in floats) and 1/z; where a vertex is nearer than the near plane or
// outside the guard band the whole range's grid holds eye-space positions instead and takes the careful path (raster_wide.clh).
#include "device/lanes.clh"
#include "dice/raster_lanes.clh"
#include "dice/raster_wide.clh"
#include "film/batch.clh"
#include "surface/patch_eval.clh"
#include "surface/patch_nets.clh"

#define GRID_SIDE_MOST 33
// Vectors may read a row and a few places beyond the last vertex.
#define GRID_FLOATS (GRID_SIDE_MOST * (GRID_SIDE_MOST + 1) + 2 * LANES)

typedef struct {
    local float* x;
    local float* y;
    local float* w;
    local int* careful;
} grid_store;

// Where a range lies in its patch and how its grid steps.
typedef struct {
    uint u_index, v_index;  // in units of 2^-level
    float u_size, v_size;   // 2^-level
    float per_rate;         // 1 / rate
} grid_domain;

static inline grid_domain domain_of(const frame_params* frame, range_t range) {
    grid_domain domain;
    domain.u_index = range.u_side & SIDE_INDEX_MASK;
    domain.v_index = range.v_side & SIDE_INDEX_MASK;
    domain.u_size = range_side_size(range.u_side);
    domain.v_size = range_side_size(range.v_side);
    domain.per_rate = 1.0f / (float)frame->dice_rate;
    return domain;
}

// The lanes' eye-space vertices; vertex i is column i mod (rate + 1) of row i / (rate + 1).
static inline __attribute__((always_inline)) vpoint grid_vertices(const frame_params* frame, grid_domain domain, global const float* net,
                                                                  int count, int first) {
    int side = (int)frame->dice_rate + 1;
    vint i = first + vlane_index();
    // Exact: i is below 2^11, and the half keeps the quotient away from integers.
    vint row = vto_int((vto_float(i) + 0.5f) * (1.0f / (float)side));
    vint column = i - row * side;
    vfloat u = ((float)domain.u_index + vto_float(column) * domain.per_rate) * domain.u_size;
    vfloat v = ((float)domain.v_index + vto_float(row) * domain.per_rate) * domain.v_size;
    return patch_point(net, count, u, v);
}

static inline void snap_grid(const frame_params* frame, grid_domain domain, global const float* net, int count, grid_store grid) {
    int vertices = ((int)frame->dice_rate + 1) * ((int)frame->dice_rate + 1);
    vint bad = (vint)(0);
    for (int i = (int)get_local_id(0) * LANES; i < vertices; i += GROUP * LANES) {
        vpoint p = grid_vertices(frame, domain, net, count, i);
        vfloat w = 1.0f / p.z;
        vfloat x = p.x * w * frame->raster_scale;
        vfloat y = p.y * w * frame->raster_scale;
        const float guard = GUARD_CELLS * 256.0f;
        vint good = vle((vfloat)(frame->near_plane), p.z) & vle(fabs(x), (vfloat)(guard)) & vle(fabs(y), (vfloat)(guard));
        bad |= ~good & vlt(i + vlane_index(), (vint)(vertices));
        vint fixed_x = film_snap(x + frame->raster_x) - frame->raster_x0;
        vint fixed_y = film_snap(frame->raster_y - y) - frame->raster_y0;
        store_lanes(vas_float(fixed_x), grid.x + i);
        store_lanes(vas_float(fixed_y), grid.y + i);
        store_lanes(w, grid.w + i);
    }
    if (vany(bad)) *grid.careful = 1;
}

static inline void keep_eye_grid(const frame_params* frame, grid_domain domain, global const float* net, int count, grid_store grid) {
    int vertices = ((int)frame->dice_rate + 1) * ((int)frame->dice_rate + 1);
    for (int i = (int)get_local_id(0) * LANES; i < vertices; i += GROUP * LANES) {
        vpoint p = grid_vertices(frame, domain, net, count, i);
        store_lanes(p.x, grid.x + i);
        store_lanes(p.y, grid.y + i);
        store_lanes(p.z, grid.w + i);
    }
}

static inline wide_vertex snapped_vertex(grid_store grid, int i) {
    wide_vertex v = {as_int(grid.x[i]), as_int(grid.y[i]), grid.w[i]};
    return v;
}

static inline wide_point eye_vertex(grid_store grid, int i) {
    wide_point p = {grid.x[i], grid.y[i], grid.w[i]};
    return p;
}

static inline void hide_large(const frame_params* frame, hide_target* target, grid_store grid, int vertex, uint id) {
    int side = (int)frame->dice_rate + 1;
    wide_vertex a = snapped_vertex(grid, vertex), b = snapped_vertex(grid, vertex + 1);
    wide_vertex c = snapped_vertex(grid, vertex + side + 1), d = snapped_vertex(grid, vertex + side);
    wide_triangle(frame, target, a, b, c, id);
    wide_triangle(frame, target, a, c, d, id);
}

// Micropolygons are taken in blocks of BLOCK_COLUMNS x BLOCK_ROWS, a lane each: at the usual rate of 8 no lane idles.
#if LANES == 16
#define BLOCK_ROWS 2
#else
#define BLOCK_ROWS 1
#endif
#define BLOCK_COLUMNS (LANES / BLOCK_ROWS)

static inline vfloat load_block(local const float* corner, int side) {
#if LANES == 16
    return (vfloat)(vload8(0, corner), vload8(0, corner + side));
#else
    return load_lanes(corner);
#endif
}

static inline lane_quads load_quads(grid_store grid, int vertex, int side) {
    lane_quads q;
    q.ax = vas_int(load_block(grid.x + vertex, side));
    q.bx = vas_int(load_block(grid.x + vertex + 1, side));
    q.dx = vas_int(load_block(grid.x + vertex + side, side));
    q.cx = vas_int(load_block(grid.x + vertex + side + 1, side));
    q.ay = vas_int(load_block(grid.y + vertex, side));
    q.by = vas_int(load_block(grid.y + vertex + 1, side));
    q.dy = vas_int(load_block(grid.y + vertex + side, side));
    q.cy = vas_int(load_block(grid.y + vertex + side + 1, side));
    q.aw = load_block(grid.w + vertex, side);
    q.bw = load_block(grid.w + vertex + 1, side);
    q.dw = load_block(grid.w + vertex + side, side);
    q.cw = load_block(grid.w + vertex + side + 1, side);
    return q;
}

static inline void hide_snapped_grid(const frame_params* frame, hide_target* target, grid_store grid, uint first_id) {
    int rate = (int)frame->dice_rate;
    int side = rate + 1;
    int blocks_x = (rate + BLOCK_COLUMNS - 1) / BLOCK_COLUMNS;
    int blocks = blocks_x * ((rate + BLOCK_ROWS - 1) / BLOCK_ROWS);
    vint lane_column = vlane_index() % BLOCK_COLUMNS;
    vint lane_row = vlane_index() / BLOCK_COLUMNS;
    for (int i = (int)get_local_id(0); i < blocks; i += GROUP) {
        int row = i / blocks_x * BLOCK_ROWS;
        int column = i % blocks_x * BLOCK_COLUMNS;
        int vertex = row * side + column;
        lane_quads q = load_quads(grid, vertex, side);
        q.active = vlt(column + lane_column, (vint)(rate)) & vlt(row + lane_row, (vint)(rate));
        vint large = raster_bounds(frame, &q);
        vint ids = (int)first_id + ((row + lane_row) << (int)frame->rate_bits) + column + lane_column;
        if (vany(q.active)) raster_quads(frame, target, q, ids);
        if (vany(large)) {
            int lanes[LANES], names[LANES];
            store_lanes(large, lanes);
            store_lanes(ids, names);
            for (int k = 0; k < LANES; ++k)
                if (lanes[k]) hide_large(frame, target, grid, vertex + k / BLOCK_COLUMNS * side + k % BLOCK_COLUMNS, (uint)names[k]);
        }
    }
}

static inline void hide_eye_grid(const frame_params* frame, hide_target* target, grid_store grid, uint first_id) {
    int rate = (int)frame->dice_rate;
    int side = rate + 1;
    for (int i = (int)get_local_id(0); i < rate * rate; i += GROUP) {
        int row = i / rate;
        int vertex = i + row;
        uint id = first_id + (uint)((row << (int)frame->rate_bits) + i - row * rate);
        wide_point a = eye_vertex(grid, vertex), b = eye_vertex(grid, vertex + 1);
        wide_point c = eye_vertex(grid, vertex + side + 1), d = eye_vertex(grid, vertex + side);
        wide_clip_and_cover(frame, target, a, b, c, id);
        wide_clip_and_cover(frame, target, a, c, d, id);
    }
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void dice_hide(frame_params frame, split_limits limits,
                                                                         global const split_state* state, global const range_t* ready,
                                                                         global const float* eye_points, global ulong* samples,
                                                                         global uchar* touched, uint pass) {
    local float grid_x[GRID_FLOATS], grid_y[GRID_FLOATS], grid_w[GRID_FLOATS];
    local int careful;
    grid_store grid = {grid_x, grid_y, grid_w, &careful};
    hide_target target;
    target.samples = samples;
    target.touched = touched;
    target.pass = pass;
    target.per_tile = tile_reciprocal(&frame);
    target.hits = 0;
    uint ranges = batch_to_hide(&frame, state, limits);
    // Neighbours in `ready` are mostly neighbours on the screen: a group takes a run of them, so that their samples stay in its cache,
    // but short enough that each group has several runs.
    uint groups = (uint)get_num_groups(0);
    uint run = clamp(ranges / (4u * groups), 1u, 64u);
    for (uint step = 0u;; ++step) {
        uint r = ((step / run) * groups + (uint)get_group_id(0)) * run + step % run;
        if (r - step % run >= ranges) break;
        if (r >= ranges) continue;
        range_t range = ready[r];
        grid_domain domain = domain_of(&frame, range);
        int count = patch_point_count(&frame, range.patch_index);
        global const float* net = eye_points + patch_offset(&frame, range.patch_index);
        uint first_id = first_id_of(r, frame.rate_bits);
        if (get_local_id(0) == 0) careful = 0;
        barrier(CLK_LOCAL_MEM_FENCE);
        snap_grid(&frame, domain, net, count, grid);
        barrier(CLK_LOCAL_MEM_FENCE);
        if (careful) {
            keep_eye_grid(&frame, domain, net, count, grid);
            barrier(CLK_LOCAL_MEM_FENCE);
            hide_eye_grid(&frame, &target, grid, first_id);
        } else {
            hide_snapped_grid(&frame, &target, grid, first_id);
        }
        hide_waiting(&target);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
}
