// shade_tiles: the last pass of a frame. A work-group takes a tile at a time: gathers its pixels' samples, shades each visible
// micropolygon once a pixel, box-filters the samples into pixels and leaves the tile's samples empty for the next frame.
// In:    samples (ids all 0 by now), references, touched; eye_points, patches, objects, lights.
// Out:   picture: premultiplied linear rgba, then the planes asked for; state->pixels_covered.
// Bound: local lists of one slot a sample of a tile (at most 256); no global memory of its own.
#include "device/lanes.clh"
#include "film/film.clh"
#include "shade/lighting.clh"
#include "split/range_shared.h"
#include "surface/patch_eval.clh"
#include "surface/patch_nets.clh"

#define TILE_SAMPLES_MOST 256
#define LIST_SLOTS (TILE_SAMPLES_MOST + LANES)

// Shading points of a tile: pixel p has slots [p N N, (p + 1) N N); `weight` is the number of its samples that show it, 0 in unused slots.
typedef struct {
    local int* patch_index;
    local float* u;
    local float* v;
    local float* weight;
    local float* result;  // r, g, b, n.x, n.y, n.z, LIST_SLOTS apart
} shade_list;

typedef struct {
    global const uint* patch_index;
    global const float* u;
    global const float* v;
} sample_references;

// How far back a sample looks for its micropolygon among those of its pixel; one that is not found is shaded again.
#define LOOK_BACK 8

static inline int list_sample(shade_list list, int first, int count, uint patch_index, float u, float v) {
    for (int k = count - 1; k >= max(0, count - LOOK_BACK); --k) {
        int slot = first + k;
        if (list.patch_index[slot] == (int)patch_index && list.u[slot] == u && list.v[slot] == v) {
            list.weight[slot] += 1.0f;
            return count;
        }
    }
    int slot = first + count;
    list.patch_index[slot] = (int)patch_index;
    list.u[slot] = u;
    list.v[slot] = v;
    list.weight[slot] = 1.0f;
    return count + 1;
}

// Lists a pixel's samples and empties them. Returns the nearest sample's place, or -1 where all are background.
static inline int list_pixel(const frame_params* frame, shade_list list, global ulong* samples, sample_references references, int base,
                             int corner, int first, uint* depth) {
    int n = frame->pixel_samples;
    int nearest = -1, count = 0;
    *depth = 0xffffffffu;
    for (int k = 0; k < n * n; ++k) list.weight[first + k] = 0.0f;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            int s = base + corner + j * frame->tile_cells + i;
            ulong key = samples[s];
            if (key == FILM_BACKGROUND) continue;
            samples[s] = FILM_BACKGROUND;
            count = list_sample(list, first, count, references.patch_index[s], references.u[s], references.v[s]);
            uint sample_depth = (uint)(key >> 32);
            if (nearest < 0 || sample_depth < *depth) {
                nearest = s;
                *depth = sample_depth;
            }
        }
    }
    return nearest;
}

static inline void write_nearest(global float* picture, picture_planes planes, uint pixel, int nearest, uint depth,
                                 sample_references references, global const placed_patch* patches) {
    bool hit = nearest >= 0;
    if (planes.z != NO_PLANE) picture[planes.z + pixel] = hit ? 1.0f / as_float(~depth) : INFINITY;
    if (planes.uv != NO_PLANE) {
        picture[planes.uv + 2u * pixel] = hit ? references.u[nearest] : 0.0f;
        picture[planes.uv + 2u * pixel + 1u] = hit ? references.v[nearest] : 0.0f;
    }
    if (planes.object == NO_PLANE && planes.patch_id == NO_PLANE) return;
    placed_patch placed = patches[hit ? references.patch_index[nearest] : 0u];
    if (planes.object != NO_PLANE) picture[planes.object + pixel] = hit ? (float)placed.object : -1.0f;
    if (planes.patch_id != NO_PLANE) picture[planes.patch_id + pixel] = hit ? (float)placed.index_in_mesh : -1.0f;
}

static inline vpoint blend_point(vpoint otherwise, vpoint then, vint mask) {
    vpoint r = {vselect(otherwise.x, then.x, mask), vselect(otherwise.y, then.y, mask), vselect(otherwise.z, then.z, mask)};
    return r;
}

// Evaluates the lanes' points a patch at a time (neighbours mostly share one) and shades them together.
static inline void shade_slots(const frame_params* frame, shade_list list, int first, global const float* eye_points,
                               global const placed_patch* patches, global const placed_object* objects,
                               global const eye_light* lights) {
    vint patch_lanes = load_lanes(list.patch_index + first);
    vfloat u = load_lanes(list.u + first), v = load_lanes(list.v + first);
    vint waiting = vlt((vfloat)(0.0f), load_lanes(list.weight + first));
    if (!vany(waiting)) return;
    vpoint zero = {(vfloat)(0.0f), (vfloat)(0.0f), (vfloat)(0.0f)};
    vpoint position = zero, normal = zero;
    lane_material material = {zero, (vfloat)(0.0f), (vfloat)(1.0f)};
    while (vany(waiting)) {
        uint patch_index = (uint)vreduce_max(vselect((vint)(-1), patch_lanes, waiting));
        vint mine = waiting & veq(patch_lanes, (vint)((int)patch_index));
        waiting &= ~mine;
        vpoint du, dv;
        vpoint p = patch_tangents(eye_points + patch_offset(frame, patch_index), patch_point_count(frame, patch_index), u, v, &du, &dv);
        position = blend_point(position, p, mine);
        normal = blend_point(normal, facing_normal(p, du, dv), mine);
        global const placed_object* object = objects + patches[patch_index].object;
        vpoint color = {(vfloat)(object->color[0]), (vfloat)(object->color[1]), (vfloat)(object->color[2])};
        material.color = blend_point(material.color, color, mine);
        material.specular = vselect(material.specular, (vfloat)(object->specular), mine);
        material.shininess = vselect(material.shininess, (vfloat)(object->shininess), mine);
    }
    vpoint radiance = shade_lanes(lights, frame->lights, position, normal, material);
    store_lanes(radiance.x, list.result + first);
    store_lanes(radiance.y, list.result + LIST_SLOTS + first);
    store_lanes(radiance.z, list.result + 2 * LIST_SLOTS + first);
    store_lanes(normal.x, list.result + 3 * LIST_SLOTS + first);
    store_lanes(normal.y, list.result + 4 * LIST_SLOTS + first);
    store_lanes(normal.z, list.result + 5 * LIST_SLOTS + first);
}

static inline void write_normal(const frame_params* frame, global float* to, float x, float y, float z) {
    const float* m = frame->world_from_eye;
    float length = sqrt(x * x + y * y + z * z);
    float scale = length > 0.0f ? 1.0f / length : 0.0f;
    for (int row = 0; row < 3; ++row) to[row] = (m[3 * row] * x + m[3 * row + 1] * y + m[3 * row + 2] * z) * scale;
}

// Box-filters a pixel's slots over the background.
static inline void write_pixel(const frame_params* frame, shade_list list, int first, global float* picture, picture_planes planes,
                               uint pixel) {
    int slots = frame->pixel_samples * frame->pixel_samples;
    float sum[6] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    float covered = 0.0f;
    for (int k = first; k < first + slots && list.weight[k] > 0.0f; ++k) {
        float weight = list.weight[k];
        covered += weight;
        for (int c = 0; c < 6; ++c) sum[c] += weight * list.result[c * LIST_SLOTS + k];
    }
    float per_slot = 1.0f / (float)slots;
    float open = 1.0f - covered * per_slot;
    float4 rgba = (float4)(sum[0] * per_slot + open * frame->background_r, sum[1] * per_slot + open * frame->background_g,
                           sum[2] * per_slot + open * frame->background_b, covered * per_slot + open * frame->background_a);
    vstore4(rgba, pixel, picture);
    if (planes.normal != NO_PLANE) write_normal(frame, picture + planes.normal + 3u * pixel, sum[3], sum[4], sum[5]);
}

static inline void write_empty_pixel(const frame_params* frame, global float* picture, picture_planes planes, uint pixel,
                                     sample_references references, global const placed_patch* patches) {
    vstore4((float4)(frame->background_r, frame->background_g, frame->background_b, frame->background_a), pixel, picture);
    write_nearest(picture, planes, pixel, -1, 0u, references, patches);
    if (planes.normal != NO_PLANE) write_normal(frame, picture + planes.normal + 3u * pixel, 0.0f, 0.0f, 0.0f);
}

// A tile's pixels in the picture.
typedef struct {
    int side;        // pixels along a side
    float per_side;  // 1 / side
    int x, y;        // of the first pixel
} tile_pixels;

static inline tile_pixels pixels_of_tile(const frame_params* frame, int tile) {
    tile_pixels t;
    t.side = frame->tile_cells / frame->pixel_samples;
    t.per_side = 1.0f / (float)t.side;
    int row = tile / frame->tiles_x;
    t.x = (tile - row * frame->tiles_x) * t.side;
    t.y = row * t.side;
    return t;
}

// Where pixel p of a tile stands: its corner's cell in the tile, and its place in the picture, or -1 outside.
typedef struct {
    int corner;
    int place;
} pixel_place;

static inline pixel_place place_pixel(const frame_params* frame, tile_pixels t, int p) {
    int row = (int)(((float)p + 0.5f) * t.per_side);  // exact: p is below 2^8
    int column = p - row * t.side;
    pixel_place pixel;
    pixel.corner = (row * frame->tile_cells + column) * frame->pixel_samples;
    bool inside = t.x + column < frame->width && t.y + row < frame->height;
    pixel.place = inside ? (t.y + row) * frame->width + t.x + column : -1;
    return pixel;
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void shade_tiles(
    frame_params frame, picture_planes planes, global const float* eye_points, global const placed_patch* patches,
    global const placed_object* objects, global const eye_light* lights, global const uint* reference_patch,
    global const float* reference_u, global const float* reference_v, global ulong* samples, global uchar* touched, global float* picture,
    global split_state* state) {
    local int list_patch[LIST_SLOTS];
    local float list_u[LIST_SLOTS], list_v[LIST_SLOTS], list_weight[LIST_SLOTS], list_result[6 * LIST_SLOTS];
    shade_list list = {list_patch, list_u, list_v, list_weight, list_result};
    sample_references references = {reference_patch, reference_u, reference_v};
    int lid = (int)get_local_id(0);
    int slots = frame.pixel_samples * frame.pixel_samples;
    int tile_samples = frame.tile_cells * frame.tile_cells;
    int pixels = tile_samples / slots;
    uint covered = 0u;
    for (int k = lid; k < LANES; k += GROUP) list_weight[tile_samples + k] = 0.0f;
    for (int tile = (int)get_group_id(0); tile < frame.tiles; tile += (int)get_num_groups(0)) {
        bool empty = touched[tile] == TILE_EMPTY;
        tile_pixels t = pixels_of_tile(&frame, tile);
        barrier(CLK_LOCAL_MEM_FENCE);
        if (empty) {
            for (int p = lid; p < pixels; p += GROUP) {
                pixel_place pixel = place_pixel(&frame, t, p);
                if (pixel.place >= 0) write_empty_pixel(&frame, picture, planes, (uint)pixel.place, references, patches);
            }
            continue;
        }
        for (int p = lid; p < pixels; p += GROUP) {
            pixel_place pixel = place_pixel(&frame, t, p);
            uint depth;
            // Cells outside the picture hold no samples, so their pixels list nothing.
            int nearest = list_pixel(&frame, list, samples, references, tile * tile_samples, pixel.corner, p * slots, &depth);
            if (pixel.place < 0) continue;
            write_nearest(picture, planes, (uint)pixel.place, nearest, depth, references, patches);
            covered += nearest >= 0 ? 1u : 0u;
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        for (int i = lid * LANES; i < tile_samples; i += GROUP * LANES)
            shade_slots(&frame, list, i, eye_points, patches, objects, lights);
        barrier(CLK_LOCAL_MEM_FENCE);
        for (int p = lid; p < pixels; p += GROUP) {
            pixel_place pixel = place_pixel(&frame, t, p);
            if (pixel.place >= 0) write_pixel(&frame, list, p * slots, picture, planes, (uint)pixel.place);
        }
        if (lid == 0) touched[tile] = TILE_EMPTY;
    }
    if (covered > 0u) atomic_add(&state->pixels_covered, covered);
}
