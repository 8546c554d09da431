// shade_tiles: the last pass of a frame. A work-group takes a tile at a time: gathers its pixels' samples, shades each visible
// micropolygon once a pixel, box-filters the samples into pixels and leaves the tile's samples empty for the next frame.
// In:    samples, touched; what their ids stand for: references where the id is 0, else ready (the last batch); eye_points, patches,
//        objects, lights.
// Out:   picture: premultiplied linear rgba, then the planes asked for; state->pixels_covered.
// Bound: local lists of one slot a sample of a tile (at most 256), 56 bytes each; no global memory of its own.
#include "device/lanes.clh"
#include "film/batch.clh"
#include "film/film.clh"
#include "film/picture_shared.h"
#include "shade/lighting.clh"
#include "surface/patch_eval.clh"
#include "surface/patch_nets.clh"

#define TILE_SAMPLES_MOST 256
#define TILE_PIXELS_MOST 64
#define LIST_SLOTS (TILE_SAMPLES_MOST + LANES)

// The tile's samples and shading points. Pixel p lists its micropolygons in places [p N N, p N N + count), and has them shaded in
// the `count` slots from `first` on: slots are dense, so that no lane idles.
typedef struct {
    local ulong* key;        // of each sample, as in the film
    local int* place;        // of each sample: where its pixel lists its micropolygon, from p N N on
    local int* sample;       // of each place: one of its samples
    local int* weight;       // of each place: the number of its samples
    local int* count;        // of each pixel
    local int* first;        // of each pixel, and of one behind the last
    local int* patch_index;  // of each slot
    local float* u;
    local float* v;
    local float* result;  // r, g, b, n.x, n.y, n.z, LIST_SLOTS apart
} shade_list;

// What the samples' ids stand for.
typedef struct {
    global const uint* patch_index;
    global const float* u;
    global const float* v;
    global const uint* ready;
} sample_references;

static inline surface_reference look_up(const frame_params* frame, sample_references references, uint id, int sample) {
    if (id != 0u) return reference_of(frame, references.ready, id);
    surface_reference reference = {references.patch_index[sample], references.u[sample], references.v[sample]};
    return reference;
}

// Whether two samples of a tile show the same micropolygon. Of earlier batches' samples (id 0) the references tell.
static inline bool same_micropolygon(shade_list list, sample_references references, int base, int a, int b) {
    uint id = (uint)list.key[a];
    if (id != (uint)list.key[b]) return false;
    if (id != 0u) return true;
    a += base;
    b += base;
    return references.patch_index[a] == references.patch_index[b] && references.u[a] == references.u[b] &&
           references.v[a] == references.v[b];
}

// Lists the micropolygons that pixel p's samples show: a sample's is its left or upper neighbour's where they show the same one, else a
// new one. (A micropolygon that none of its neighbours shows may be listed twice: it is shaded twice, and its weights add up all the same.)
// Returns the nearest sample, or -1 where all are background.
static inline int list_pixel(const frame_params* frame, shade_list list, sample_references references, int base, int corner, int p) {
    int n = frame->pixel_samples;
    int row_step = frame->tile_cells;
    int first = p * n * n;
    int nearest = -1, count = 0;
    uint depth = 0u;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            int cell = corner + j * row_step + i;
            ulong key = list.key[cell];
            if (key == FILM_BACKGROUND) continue;
            int place = count;
            if (j > 0 && same_micropolygon(list, references, base, cell, cell - row_step)) place = list.place[cell - row_step];
            if (i > 0 && same_micropolygon(list, references, base, cell, cell - 1)) place = list.place[cell - 1];
            list.place[cell] = place;
            list.sample[first + place] = cell;
            list.weight[first + place] = 1 + (place == count ? 0 : list.weight[first + place]);
            count += place == count ? 1 : 0;
            bool nearer = nearest < 0 || (uint)(key >> 32) < depth;
            nearest = nearer ? cell : nearest;
            depth = nearer ? (uint)(key >> 32) : depth;
        }
    }
    list.count[p] = count;
    return nearest;
}

// Gives the pixels' micropolygons their slots. One work-item: a tile has 64 pixels at most.
static inline void place_slots(shade_list list, int pixels) {
    int sum = 0;
    for (int p = 0; p < pixels; ++p) {
        list.first[p] = sum;
        sum += list.count[p];
    }
    list.first[pixels] = sum;
}

static inline void fill_slots(const frame_params* frame, shade_list list, sample_references references, int base, int p) {
    int slot = list.first[p];
    int place = p * frame->pixel_samples * frame->pixel_samples;
    for (int end = slot + list.count[p]; slot < end; ++slot, ++place) {
        int cell = list.sample[place];
        surface_reference reference = look_up(frame, references, (uint)list.key[cell], base + cell);
        list.patch_index[slot] = (int)reference.patch_index;
        list.u[slot] = reference.u;
        list.v[slot] = reference.v;
    }
}

static inline void write_nearest(const frame_params* frame, shade_list list, global float* picture, picture_planes planes, uint pixel,
                                 int base, int nearest, sample_references references, global const placed_patch* patches) {
    ulong key = list.key[nearest];
    if (planes.z != NO_PLANE) picture[planes.z + pixel] = 1.0f / as_float(~(uint)(key >> 32));
    if (planes.uv == NO_PLANE && planes.object == NO_PLANE && planes.patch_id == NO_PLANE) return;
    surface_reference reference = look_up(frame, references, (uint)key, base + nearest);
    if (planes.uv != NO_PLANE) {
        picture[planes.uv + 2u * pixel] = reference.u;
        picture[planes.uv + 2u * pixel + 1u] = reference.v;
    }
    placed_patch placed = patches[reference.patch_index];
    if (planes.object != NO_PLANE) picture[planes.object + pixel] = (float)placed.object;
    if (planes.patch_id != NO_PLANE) picture[planes.patch_id + pixel] = (float)placed.index_in_mesh;
}

static inline void write_no_surface(global float* picture, picture_planes planes, uint pixel) {
    if (planes.z != NO_PLANE) picture[planes.z + pixel] = INFINITY;
    if (planes.object != NO_PLANE) picture[planes.object + pixel] = -1.0f;
    if (planes.patch_id != NO_PLANE) picture[planes.patch_id + pixel] = -1.0f;
    if (planes.uv == NO_PLANE) return;
    picture[planes.uv + 2u * pixel] = 0.0f;
    picture[planes.uv + 2u * pixel + 1u] = 0.0f;
}

static inline vpoint blend_point(vpoint otherwise, vpoint then, vint mask) {
    vpoint r = {vselect(otherwise.x, then.x, mask), vselect(otherwise.y, then.y, mask), vselect(otherwise.z, then.z, mask)};
    return r;
}

// Evaluates the lanes' points a patch at a time (neighbours mostly share one) and shades them together.
static inline void shade_slots(const frame_params* frame, shade_list list, int first, int count, global const float* eye_points,
                               global const placed_patch* patches, global const placed_object* objects, global const eye_light* lights) {
    vint patch_lanes = load_lanes(list.patch_index + first);
    vfloat u = load_lanes(list.u + first), v = load_lanes(list.v + first);
    vint waiting = vlt(first + vlane_index(), (vint)(count));
    vpoint zero = {(vfloat)(0.0f), (vfloat)(0.0f), (vfloat)(0.0f)};
    vpoint position = zero, normal = zero;
    lane_material material = {zero, (vfloat)(0.0f), (vfloat)(1.0f)};
    while (vany(waiting)) {
        uint patch_index = (uint)vreduce_max(vselect((vint)(-1), patch_lanes, waiting));
        vint mine = waiting & veq(patch_lanes, (vint)((int)patch_index));
        waiting &= ~mine;
        global const float* net = eye_points + patch_offset(frame, patch_index);
        int kind = patch_kind(frame, patch_index);
        vpoint du, dv;
        vpoint p = patch_tangents(net, kind, u, v, &du, &dv);
        vpoint across = kind == KIND_PN ? pn_normal(net, u, v) : normal_of_tangents(du, dv);
        position = blend_point(position, p, mine);
        normal = blend_point(normal, facing_normal(p, across), mine);
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
    for (int row = 0; row < 3; ++row) to[row] = length > 0.0f ? (m[3 * row] * x + m[3 * row + 1] * y + m[3 * row + 2] * z) / length : 0.0f;
}

typedef struct {
    float x, y, z;
} pixel_sum;

static inline void add_pixel(pixel_sum* sum, float weight, local const float* result) {
    sum->x += weight * result[0];
    sum->y += weight * result[LIST_SLOTS];
    sum->z += weight * result[2 * LIST_SLOTS];
}

// Box-filters pixel p's samples over the background.
static inline void write_pixel(const frame_params* frame, shade_list list, int p, global float* picture, picture_planes planes,
                               uint pixel) {
    int slots = frame->pixel_samples * frame->pixel_samples;
    pixel_sum color = {0.0f, 0.0f, 0.0f}, normal = {0.0f, 0.0f, 0.0f};
    float covered = 0.0f;
    for (int k = 0; k < list.count[p]; ++k) {
        float weight = (float)list.weight[p * slots + k];
        local const float* result = list.result + list.first[p] + k;
        covered += weight;
        add_pixel(&color, weight, result);
        if (planes.normal != NO_PLANE) add_pixel(&normal, weight, result + 3 * LIST_SLOTS);
    }
    float per_slot = 1.0f / (float)slots;
    float open = 1.0f - covered * per_slot;
    float4 rgba = (float4)(color.x * per_slot + open * frame->background_r, color.y * per_slot + open * frame->background_g,
                           color.z * per_slot + open * frame->background_b, covered * per_slot + open * frame->background_a);
    vstore4(rgba, pixel, picture);
    if (planes.normal != NO_PLANE) write_normal(frame, picture + planes.normal + 3u * pixel, normal.x, normal.y, normal.z);
}

static inline void write_empty_pixel(const frame_params* frame, global float* picture, picture_planes planes, uint pixel) {
    vstore4((float4)(frame->background_r, frame->background_g, frame->background_b, frame->background_a), pixel, picture);
    write_no_surface(picture, planes, pixel);
    if (planes.normal != NO_PLANE) vstore3((float3)(0.0f), 0, picture + planes.normal + 3u * pixel);
}

// A tile's pixels, walked in steps of the group's size.
typedef struct {
    int side;         // pixels along a tile's side
    int x, y;         // of the tile's first pixel in the picture
    int row, column;  // of the pixel in the tile
} pixel_walk;

static inline pixel_walk walk_pixels(const frame_params* frame, int tile) {
    pixel_walk walk;
    walk.side = frame->tile_cells / frame->pixel_samples;
    int tile_row = tile / frame->tiles_x;
    walk.x = (tile - tile_row * frame->tiles_x) * walk.side;
    walk.y = tile_row * walk.side;
    walk.row = (int)get_local_id(0) / walk.side;
    walk.column = (int)get_local_id(0) - walk.row * walk.side;
    return walk;
}

static inline void next_pixel(pixel_walk* walk) {
    walk->column += GROUP;
    while (walk->column >= walk->side) {
        walk->column -= walk->side;
        walk->row += 1;
    }
}

// The pixel's place in the picture, or -1 outside it.
static inline int pixel_place(const frame_params* frame, const pixel_walk* walk) {
    int x = walk->x + walk->column, y = walk->y + walk->row;
    return x < frame->width && y < frame->height ? y * frame->width + x : -1;
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void shade_tiles(
    frame_params frame, picture_planes planes, global const float* eye_points, global const placed_patch* patches,
    global const placed_object* objects, global const eye_light* lights, global const uint* reference_patch,
    global const float* reference_u, global const float* reference_v, global const uint* ready, global ulong* samples,
    global uchar* touched, global float* picture, global split_state* state) {
    local ulong list_key[TILE_SAMPLES_MOST];
    local int list_place[TILE_SAMPLES_MOST], list_sample[TILE_SAMPLES_MOST], list_count[TILE_PIXELS_MOST], list_first[TILE_PIXELS_MOST + 1];
    local int list_weight[TILE_SAMPLES_MOST];
    local int list_patch[LIST_SLOTS];
    local float list_u[LIST_SLOTS], list_v[LIST_SLOTS], list_result[6 * LIST_SLOTS];
    shade_list list = {list_key, list_place, list_sample, list_weight, list_count, list_first, list_patch, list_u, list_v, list_result};
    sample_references references = {reference_patch, reference_u, reference_v, ready};
    int lid = (int)get_local_id(0);
    int tile_samples = frame.tile_cells * frame.tile_cells;
    int pixels = tile_samples / (frame.pixel_samples * frame.pixel_samples);
    uint covered = 0u;
    tile_run run = tiles_of_group(&frame);
    for (int tile = run.begin; tile < run.end; ++tile) {
        bool empty = touched[tile] == TILE_EMPTY;
        barrier(CLK_LOCAL_MEM_FENCE);
        if (empty) {
            for (pixel_walk walk = walk_pixels(&frame, tile); walk.row < walk.side; next_pixel(&walk)) {
                int place = pixel_place(&frame, &walk);
                if (place >= 0) write_empty_pixel(&frame, picture, planes, (uint)place);
            }
            continue;
        }
        int base = tile * tile_samples;
        for (int k = lid; k < tile_samples; k += GROUP) {
            list_key[k] = samples[base + k];
            samples[base + k] = FILM_BACKGROUND;
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        for (pixel_walk walk = walk_pixels(&frame, tile); walk.row < walk.side; next_pixel(&walk)) {
            int place = pixel_place(&frame, &walk);
            int corner = (walk.row * frame.tile_cells + walk.column) * frame.pixel_samples;
            // Cells outside the picture hold no samples, so their pixels list nothing.
            int nearest = list_pixel(&frame, list, references, base, corner, walk.row * walk.side + walk.column);
            if (place < 0) continue;
            if (nearest >= 0)
                write_nearest(&frame, list, picture, planes, (uint)place, base, nearest, references, patches);
            else
                write_no_surface(picture, planes, (uint)place);
            covered += nearest >= 0 ? 1u : 0u;
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        if (lid == 0) place_slots(list, pixels);
        barrier(CLK_LOCAL_MEM_FENCE);
        for (int p = lid; p < pixels; p += GROUP) fill_slots(&frame, list, references, base, p);
        barrier(CLK_LOCAL_MEM_FENCE);
        int points = list_first[pixels];
        for (int i = lid * LANES; i < points; i += GROUP * LANES)
            shade_slots(&frame, list, i, points, eye_points, patches, objects, lights);
        barrier(CLK_LOCAL_MEM_FENCE);
        for (pixel_walk walk = walk_pixels(&frame, tile); walk.row < walk.side; next_pixel(&walk)) {
            int place = pixel_place(&frame, &walk);
            if (place >= 0) write_pixel(&frame, list, walk.row * walk.side + walk.column, picture, planes, (uint)place);
        }
        if (lid == 0) touched[tile] = TILE_EMPTY;
    }
    if (covered > 0u) atomic_add(&state->pixels_covered, covered);
}
