// shade_tiles: the last pass of a bucket where the patches are all on the device. A work-group takes a tile at a time: gathers its pixels'
// samples, shades each visible micropolygon once a pixel, box-filters the samples into pixels and leaves the tile's samples empty for
// the next bucket. Does nothing unless this one is drawn to its end (film/batch.clh).
// In:    samples, touched; what their ids stand for: references where the id is 0, else ready (the last batch); eye_points, patches,
//        objects, lights.
// Out:   picture: premultiplied linear rgba, then the planes asked for; state->pixels_covered.
// Bound: local lists of one slot a sample of a tile (at most 256), 56 bytes each; no global memory of its own.
#include "device/lanes.clh"
#include "film/batch.clh"
#include "film/film.clh"
#include "film/picture_shared.h"
#include "shade/pixels.clh"
#include "shade/shade_list.clh"
#include "shade/shade_slots.clh"

static inline void add_point(pixel_point* sum, local const float* point) {
    sum->x += point[0];
    sum->y += point[RESULT_STRIDE];
    sum->z += point[2 * RESULT_STRIDE];
}

static inline void add_slot(pixel_sum* sum, local const float* result, bool normals) {
    add_point(&sum->radiance, result);
    if (normals) add_point(&sum->normal, result + 3 * RESULT_STRIDE);
}

// Pixel p's samples, from the slots in which their micropolygons were shaded. Background adds the slot that is always 0.
static inline pixel_sum sum_slots(const frame_params* frame, shade_list list, int corner, int p, bool normals) {
    pixel_sum sum = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, list.covered[p]};
    local const float* first = list.result + list.first[p];
    if (frame->pixel_samples == 1) {
        if (sum.covered > 0) add_slot(&sum, first, normals);
        return sum;
    }
    for (int j = 0; j < frame->pixel_samples; ++j) {
        for (int i = 0; i < frame->pixel_samples; ++i) {
            int place = list.place[corner + j * frame->tile_cells + i];
            add_slot(&sum, place == NO_PLACE ? list.result + NO_SLOT : first + place, normals);
        }
    }
    return sum;
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void shade_tiles(
    frame_params frame, picture_planes planes, global const float* eye_points, global const placed_patch* patches,
    global const placed_object* objects, global const eye_light* lights, global const uint* reference_patch,
    global const float* reference_u, global const float* reference_v, global const uint* ready, global ulong* samples,
    global uchar* touched, global float* picture, global split_state* state) {
    local ulong list_key[TILE_SAMPLES_MOST];
    local int list_place[TILE_SAMPLES_MOST], list_sample[TILE_SAMPLES_MOST];
    local int list_count[TILE_PIXELS_MOST], list_covered[TILE_PIXELS_MOST], list_first[TILE_PIXELS_MOST + 1];
    local int list_patch[LIST_SLOTS];
    local float list_u[LIST_SLOTS], list_v[LIST_SLOTS], list_result[6 * RESULT_STRIDE];
    shade_list list = {list_key, list_place, list_sample, list_count, list_covered, list_first, list_patch, list_u, list_v, list_result};
    shade_scene scene = {eye_points, patches, objects, lights};
    sample_references references = {reference_patch, reference_u, reference_v, ready};
    int lid = (int)get_local_id(0);
    int tile_samples = frame.tile_cells * frame.tile_cells;
    int pixels = tile_samples / (frame.pixel_samples * frame.pixel_samples);
    uint covered = 0u;
    for (int k = lid; k < 6; k += GROUP) list_result[k * RESULT_STRIDE + NO_SLOT] = 0.0f;
    tile_run run = tiles_of_group(&frame);
    if (!frame_is_drawn(state)) run.end = run.begin;
    for (int tile = run.begin; tile < run.end; ++tile) {
        bool empty = touched[tile] == TILE_EMPTY;
        barrier(CLK_LOCAL_MEM_FENCE);
        if (empty) {
            write_empty_tile(&frame, picture, planes, tile);
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
            // Cells outside the picture hold no samples, so their pixels list nothing.
            int nearest = list_pixel(&frame, list, references, base, pixel_corner(&frame, &walk), pixel_number(&walk), false);
            if (place < 0) continue;
            if (nearest < 0) {
                write_no_surface(picture, planes, (uint)place);
                continue;
            }
            covered += 1u;
            ulong key = list_key[nearest];
            write_depth(picture, planes, (uint)place, (uint)(key >> 32));
            if (surface_is_wanted(planes))
                write_surface(&frame, picture, planes, (uint)place, look_up(&frame, references, (uint)key, base + nearest), patches,
                              objects);
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        if (lid == 0) place_slots(list, pixels);
        barrier(CLK_LOCAL_MEM_FENCE);
        for (int p = lid; p < pixels; p += GROUP) fill_slots(&frame, list, references, base, p);
        barrier(CLK_LOCAL_MEM_FENCE);
        int points = list_first[pixels];
        for (int i = lid * LANES; i < points; i += GROUP * LANES) shade_slots(&frame, list, i, points, scene);
        barrier(CLK_LOCAL_MEM_FENCE);
        for (pixel_walk walk = walk_pixels(&frame, tile); walk.row < walk.side; next_pixel(&walk)) {
            int place = pixel_place(&frame, &walk);
            if (place < 0) continue;
            pixel_sum sum = sum_slots(&frame, list, pixel_corner(&frame, &walk), pixel_number(&walk), planes.normal != NO_PLANE);
            write_filtered(&frame, picture, planes, (uint)place, sum);
        }
        if (lid == 0) touched[tile] = TILE_EMPTY;
    }
    if (covered > 0u) atomic_add(&state->pixels_covered, covered);
}
