// dice_hide: a work-group takes a range at a time, evaluates its grid into local memory and hides its micropolygons.
// In:    ready (the ranges [hidden, ready_count) of it: range_t in classical mode, quad_range in watertight mode), eye_points, patches,
//        records.
// Out:   samples, touched (film/film.clh), with ids of micropolygons as film/batch.clh packs them.
// Runs:  when enough ranges are collected, `ready` has too little room for another iteration, or nothing is left to split; else it
//        returns at once (film/batch.clh).
// Bound: no global memory beyond the film; a grid of at most 33 x 33 vertices of 12 bytes in local memory.
// The grid holds 24.8 fixed-point screen positions (as bits in floats) and 1/z; where a vertex is nearer than the near plane or
// outside the guard band the whole range's grid holds eye-space positions instead and takes the careful path (raster_wide.clh).
#include "device/lanes.clh"
#include "dice/box_grid.clh"
#include "dice/quad_grid.clh"
#include "dice/raster_lanes.clh"
#include "dice/raster_wide.clh"
#include "film/batch.clh"

#define GRID_SIDE_MOST 33
// Vectors may read a row and a few places beyond the last vertex.
#define GRID_FLOATS (GRID_SIDE_MOST * (GRID_SIDE_MOST + 1) + 2 * LANES)

typedef struct {
    local float* x;
    local float* y;
    local float* w;
    local int* careful;
} grid_store;

// A range to be diced, in either mode.
typedef struct {
    patch_ref patch;
    grid_domain box;
    quad_domain quad;
    int columns, rows;  // of micropolygons
} grid_range;

static inline grid_range range_to_dice(const frame_params* frame, global const uint* ready, uint r, global const float* eye_points,
                                       global const placed_patch* patches, global const edge_info* records) {
    grid_range range;
    uint patch_index;
    if (frame->watertight) {
        quad_range quad = ((global const quad_range*)ready)[r];
        range.quad = quad_domain_of(quad);
        range.columns = range.quad.columns;
        range.rows = range.quad.rows;
        patch_index = quad.patch_index;
    } else {
        range_t box = ((global const range_t*)ready)[r];
        range.box = domain_of(frame, box);
        range.columns = range.rows = (int)frame->dice_rate;
        patch_index = box.patch_index;
    }
    range.patch = patch_at(frame, eye_points, patches, records, patch_index);
    return range;
}

// The lanes' vertices as the grid holds them.
typedef struct {
    vfloat x, y, w;
    vint bad;  // nearer than the near plane or outside the guard band
} grid_lanes;

static inline grid_lanes snap_vertices(const frame_params* frame, vpoint p) {
    grid_lanes out;
    vfloat w = 1.0f / p.z;
    vfloat x = p.x * w * frame->raster_scale;
    vfloat y = p.y * w * frame->raster_scale;
    const float guard = GUARD_CELLS * 256.0f;
    out.bad = ~(vle((vfloat)(frame->near_plane), p.z) & vle(fabs(x), (vfloat)(guard)) & vle(fabs(y), (vfloat)(guard)));
    out.x = vas_float(film_snap(x + frame->raster_x) - frame->raster_x0);
    out.y = vas_float(film_snap(frame->raster_y - y) - frame->raster_y0);
    out.w = w;
    return out;
}

static inline grid_lanes keep_vertices(vpoint p) {
    grid_lanes out = {p.x, p.y, p.z, (vint)(0)};
    return out;
}

static inline void store_vertices(grid_store grid, int at, grid_lanes lanes) {
    store_lanes(lanes.x, grid.x + at);
    store_lanes(lanes.y, grid.y + at);
    store_lanes(lanes.w, grid.w + at);
}

static inline void scatter_vertices(grid_store grid, vint place, int count, grid_lanes lanes) {
    int places[LANES];
    float x[LANES], y[LANES], w[LANES];
    store_lanes(place, places);
    store_lanes(lanes.x, x);
    store_lanes(lanes.y, y);
    store_lanes(lanes.w, w);
    for (int k = 0; k < LANES && k < count; ++k) {
        grid.x[places[k]] = x[k];
        grid.y[places[k]] = y[k];
        grid.w[places[k]] = w[k];
    }
}

// Fills the grid with snapped positions, or with those in eye space. Returns the lanes that met a vertex which cannot be snapped.
static inline vint fill_box_grid(const frame_params* frame, const grid_range* range, grid_store grid, bool snap) {
    int vertices = (range->columns + 1) * (range->rows + 1);
    vint bad = (vint)(0);
    for (int i = (int)get_local_id(0) * LANES; i < vertices; i += GROUP * LANES) {
        vpoint p = grid_vertices(frame, range->box, range->patch, i);
        grid_lanes lanes = snap ? snap_vertices(frame, p) : keep_vertices(p);
        store_vertices(grid, i, lanes);
        bad |= lanes.bad & vlt(i + vlane_index(), (vint)(vertices));
    }
    return bad;
}

// The rows between the first and the last, with what they hold of the border, which is laid over them later.
static inline vint fill_quad_rows(const frame_params* frame, const grid_range* range, grid_store grid, bool snap) {
    int side = range->columns + 1;
    int inner = (range->rows - 1) * side;
    vint bad = (vint)(0);
    for (int i = (int)get_local_id(0) * LANES; i < inner; i += GROUP * LANES) {
        vpoint p = quad_inner_vertices(&range->quad, range->patch, i);
        grid_lanes lanes = snap ? snap_vertices(frame, p) : keep_vertices(p);
        store_vertices(grid, side + i, lanes);
        bad |= lanes.bad & vlt(i + vlane_index(), (vint)(inner));
    }
    return bad;
}

// The second part of a grid, after a barrier: the border of a watertight range.
static inline vint fill_border(const frame_params* frame, const grid_range* range, grid_store grid, bool snap) {
    vint bad = (vint)(0);
    if (!frame->watertight) return bad;
    int border = QUAD_BORDER_VERTICES(&range->quad);
    for (int i = (int)get_local_id(0) * LANES; i < border; i += GROUP * LANES) {
        quad_border at = quad_border_vertices(&range->quad, i);
        vpoint p = patch_vertex(range->patch, at.u, at.v);
        grid_lanes lanes = snap ? snap_vertices(frame, p) : keep_vertices(p);
        scatter_vertices(grid, at.place, border - i, lanes);
        bad |= lanes.bad & vlt(i + vlane_index(), (vint)(border));
    }
    return bad;
}

static inline vint fill_rows(const frame_params* frame, const grid_range* range, grid_store grid, bool snap) {
    return frame->watertight ? fill_quad_rows(frame, range, grid, snap) : fill_box_grid(frame, range, grid, snap);
}

static inline wide_vertex snapped_vertex(grid_store grid, int i) {
    wide_vertex v = {as_int(grid.x[i]), as_int(grid.y[i]), grid.w[i]};
    return v;
}

static inline wide_point eye_vertex(grid_store grid, int i) {
    wide_point p = {grid.x[i], grid.y[i], grid.w[i]};
    return p;
}

static inline void hide_large(const frame_params* frame, hide_target* target, grid_store grid, int side, int vertex, uint id) {
    wide_vertex a = snapped_vertex(grid, vertex), b = snapped_vertex(grid, vertex + 1);
    wide_vertex c = snapped_vertex(grid, vertex + side + 1), d = snapped_vertex(grid, vertex + side);
    wide_triangle(frame, target, a, b, c, id);
    wide_triangle(frame, target, a, c, d, id);
}

// Micropolygons are taken in blocks, a lane each: two rows of eight where the grid is wide enough, so that at the usual rates of 8 and 16
// no lane idles; one row of 16 in grids of one row, and four columns in narrow grids.
static inline int block_columns(int columns, int rows) {
    if (LANES == 1) return 1;
    if (columns <= 4) return 4;
    return LANES == 16 && rows == 1 && columns > 8 ? 16 : 8;
}

static inline vfloat load_block(local const float* corner, int side, int columns) {
#if LANES == 16
    if (columns == 8) return (vfloat)(vload8(0, corner), vload8(0, corner + side));
    if (columns == 4) {
        return (vfloat)(vload4(0, corner), vload4(0, corner + side), vload4(0, corner + 2 * side), vload4(0, corner + 3 * side));
    }
#elif LANES == 8
    if (columns == 4) return (vfloat)(vload4(0, corner), vload4(0, corner + side));
#endif
    return load_lanes(corner);
}

static inline __attribute__((always_inline)) lane_quads load_quads(grid_store grid, int vertex, int side, int columns) {
    lane_quads q;
    q.ax = vas_int(load_block(grid.x + vertex, side, columns));
    q.bx = vas_int(load_block(grid.x + vertex + 1, side, columns));
    q.dx = vas_int(load_block(grid.x + vertex + side, side, columns));
    q.cx = vas_int(load_block(grid.x + vertex + side + 1, side, columns));
    q.ay = vas_int(load_block(grid.y + vertex, side, columns));
    q.by = vas_int(load_block(grid.y + vertex + 1, side, columns));
    q.dy = vas_int(load_block(grid.y + vertex + side, side, columns));
    q.cy = vas_int(load_block(grid.y + vertex + side + 1, side, columns));
    q.aw = load_block(grid.w + vertex, side, columns);
    q.bw = load_block(grid.w + vertex + 1, side, columns);
    q.dw = load_block(grid.w + vertex + side, side, columns);
    q.cw = load_block(grid.w + vertex + side + 1, side, columns);
    return q;
}

static inline lane_quads load_shaped_quads(grid_store grid, int vertex, int side, int columns) {
    if (LANES > 1 && columns == 8) return load_quads(grid, vertex, side, 8);
    if (LANES > 1 && columns == 4) return load_quads(grid, vertex, side, 4);
    return load_quads(grid, vertex, side, LANES);
}

static inline void hide_snapped_grid(const frame_params* frame, hide_target* target, grid_store grid, int columns, int rows,
                                     uint first_id) {
    int side = columns + 1;
    int across = block_columns(columns, rows);
    int down = LANES / across;
    int blocks_x = (columns + across - 1) / across;
    int blocks = blocks_x * ((rows + down - 1) / down);
    vint lane_column = vlane_index() & (across - 1);
    vint lane_row = (vlane_index() - lane_column) / across;
    for (int i = (int)get_local_id(0); i < blocks; i += GROUP) {
        int row = i / blocks_x * down;
        int column = i % blocks_x * across;
        int vertex = row * side + column;
        lane_quads q = load_shaped_quads(grid, vertex, side, across);
        q.active = vlt(column + lane_column, (vint)(columns)) & vlt(row + lane_row, (vint)(rows));
        vint large = raster_bounds(frame, &q);
        vint ids = (int)first_id + ((row + lane_row) << (int)frame->rate_bits) + column + lane_column;
        if (vany(q.active)) raster_quads(frame, target, q, ids);
        if (vany(large)) {
            int lanes[LANES], names[LANES];
            store_lanes(large, lanes);
            store_lanes(ids, names);
            for (int k = 0; k < LANES; ++k)
                if (lanes[k]) hide_large(frame, target, grid, side, vertex + k / across * side + k % across, (uint)names[k]);
        }
    }
}

static inline void hide_eye_grid(const frame_params* frame, hide_target* target, grid_store grid, int columns, int rows, uint first_id) {
    int side = columns + 1;
    for (int i = (int)get_local_id(0); i < columns * rows; i += GROUP) {
        int row = i / columns;
        int vertex = i + row;
        uint id = first_id + (uint)((row << (int)frame->rate_bits) + i - row * columns);
        wide_point a = eye_vertex(grid, vertex), b = eye_vertex(grid, vertex + 1);
        wide_point c = eye_vertex(grid, vertex + side + 1), d = eye_vertex(grid, vertex + side);
        wide_clip_and_cover(frame, target, a, b, c, id);
        wide_clip_and_cover(frame, target, a, c, d, id);
    }
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void dice_hide(frame_params frame, split_limits limits,
                                                                         global const split_state* state, global const uint* ready,
                                                                         global const float* eye_points, global const placed_patch* patches,
                                                                         global const edge_info* records, global ulong* samples,
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
    uint hidden = state->hidden;
    uint ranges = hide_is_due(state, limits) ? state->ready_count - hidden : 0u;
    // Neighbours in `ready` are mostly neighbours on the screen: a group takes a run of them, so that their samples stay in its cache,
    // but short enough that each group has several runs.
    uint groups = (uint)get_num_groups(0);
    uint run = clamp(ranges / (4u * groups), 1u, 64u);
    for (uint step = 0u;; ++step) {
        uint r = ((step / run) * groups + (uint)get_group_id(0)) * run + step % run;
        if (r - step % run >= ranges) break;
        if (r >= ranges) continue;
        grid_range range = range_to_dice(&frame, ready, hidden + r, eye_points, patches, records);
        uint first_id = first_id_of(hidden + r, frame.rate_bits);
        if (get_local_id(0) == 0) careful = 0;
        barrier(CLK_LOCAL_MEM_FENCE);
        // Barriers stand at the kernel's own level: within branches that hold more, PoCL's groups of many work-items crashed.
        if (vany(fill_rows(&frame, &range, grid, true))) careful = 1;
        barrier(CLK_LOCAL_MEM_FENCE);
        if (vany(fill_border(&frame, &range, grid, true))) careful = 1;
        barrier(CLK_LOCAL_MEM_FENCE);
        bool snapped = careful == 0;
        if (!snapped) fill_rows(&frame, &range, grid, false);
        barrier(CLK_LOCAL_MEM_FENCE);
        if (!snapped) fill_border(&frame, &range, grid, false);
        barrier(CLK_LOCAL_MEM_FENCE);
        if (!snapped) {
            hide_eye_grid(&frame, &target, grid, range.columns, range.rows, first_id);
        } else {
            hide_snapped_grid(&frame, &target, grid, range.columns, range.rows, first_id);
        }
        hide_waiting(&target);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
}
