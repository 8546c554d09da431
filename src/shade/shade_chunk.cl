// Shading a frame whose patches are not all on the device at once: when all of it is hidden and resolved, mark_chunks tells which chunks
// of patches are seen, shade_chunk shades the samples that show the chunk on the device, for one chunk after the other, and filter_tiles
// makes the picture. The same bits as from shade_tiles.
#include "device/lanes.clh"
#include "film/batch.clh"
#include "film/film.clh"
#include "film/picture_shared.h"
#include "shade/pixels.clh"
#include "shade/shade_list.clh"
#include "shade/shade_slots.clh"

// mark_chunks: which chunks are seen.
// In:  samples, touched, reference_patch (of the scene); all ids are 0.
// Out: flags[patch / patches_each] = 1 for every patch that a sample shows; other flags stay.
kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void mark_chunks(frame_params frame, uint patches_each,
                                                                           global const uint* reference_patch, global const ulong* samples,
                                                                           global const uchar* touched, global uint* flags) {
    int tile_samples = frame.tile_cells * frame.tile_cells;
    // Neighbours mostly show one patch, and division is slow.
    uint last = 0xffffffffu;
    tile_run run = tiles_of_group(&frame);
    for (int tile = run.begin; tile < run.end; ++tile) {
        if (touched[tile] == TILE_EMPTY) continue;
        for (int k = (int)get_local_id(0); k < tile_samples; k += GROUP) {
            size_t s = (size_t)tile * tile_samples + k;
            if (samples[s] == FILM_BACKGROUND || reference_patch[s] == last) continue;
            last = reference_patch[s];
            flags[last / patches_each] = 1u;
        }
    }
}

// Pixel p's samples that were listed: their radiances take the places of their references.
static inline void store_radiances(const frame_params* frame, shade_list list, int base, int corner, int p, global uint* reference_patch,
                                   global float* reference_u, global float* reference_v, global ulong* samples) {
    for (int j = 0; j < frame->pixel_samples; ++j) {
        for (int i = 0; i < frame->pixel_samples; ++i) {
            int cell = corner + j * frame->tile_cells + i;
            if (list.place[cell] == NO_PLACE) continue;
            local const float* result = list.result + list.first[p] + list.place[cell];
            int s = base + cell;
            reference_patch[s] = as_uint(result[0]);
            reference_u[s] = result[RESULT_STRIDE];
            reference_v[s] = result[2 * RESULT_STRIDE];
            samples[s] = list.key[cell] | SAMPLE_SHADED;
        }
    }
}

static inline void store_normals(const frame_params* frame, shade_list list, int base, int corner, int p, global float* normals) {
    for (int j = 0; j < frame->pixel_samples; ++j) {
        for (int i = 0; i < frame->pixel_samples; ++i) {
            int cell = corner + j * frame->tile_cells + i;
            if (list.place[cell] == NO_PLACE) continue;
            local const float* result = list.result + 3 * RESULT_STRIDE + list.first[p] + list.place[cell];
            global float* to = normals + 3 * (size_t)(base + cell);
            to[0] = result[0];
            to[1] = result[RESULT_STRIDE];
            to[2] = result[2 * RESULT_STRIDE];
        }
    }
}

// Takes a tile's samples into the list, with those that this chunk does not shade marked SAMPLE_SHADED. Sets `found` where one is left.
static inline void load_chunk_samples(const frame_params* frame, local ulong* keys, local int* found, int base,
                                      global const uint* reference_patch, global const ulong* samples) {
    int tile_samples = frame->tile_cells * frame->tile_cells;
    for (int k = (int)get_local_id(0); k < tile_samples; k += GROUP) {
        ulong key = samples[base + k];
        if (key != FILM_BACKGROUND) {
            bool here = (uint)key == 0u && reference_patch[base + k] - frame->first_patch < frame->patches;
            if (here) *found = 1;
            key |= here ? 0ul : (ulong)SAMPLE_SHADED;
        }
        keys[k] = key;
    }
}

// shade_chunk: a work-group takes a tile at a time and shades each micropolygon of the chunk's patches once a pixel.
// In:    samples, touched; references (patch of the scene, u, v) of samples whose id is 0; eye_points, patches, objects of the chunk,
//        which is patches [frame.first_patch, frame.first_patch + frame.patches) of the scene; lights.
// Out:   of the samples that show the chunk: r, g, b in the places of the reference, the id SAMPLE_SHADED, and in normals x, y, z where
//        that plane is wanted; of the pixels whose nearest sample shows it the planes object.id, patch.id and uv, where wanted.
// Bound: local lists as in shade_tiles.
kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void shade_chunk(
    frame_params frame, picture_planes planes, global const float* eye_points, global const placed_patch* patches,
    global const placed_object* objects, global const eye_light* lights, global uint* reference_patch, global float* reference_u,
    global float* reference_v, global float* normals, global ulong* samples, global const uchar* touched, global float* picture) {
    local ulong list_key[TILE_SAMPLES_MOST];
    local int list_place[TILE_SAMPLES_MOST], list_sample[TILE_SAMPLES_MOST];
    local int list_count[TILE_PIXELS_MOST], list_covered[TILE_PIXELS_MOST], list_first[TILE_PIXELS_MOST + 1];
    local int list_patch[LIST_SLOTS];
    local float list_u[LIST_SLOTS], list_v[LIST_SLOTS], list_result[6 * RESULT_STRIDE];
    local int found;
    shade_list list = {list_key, list_place, list_sample, list_count, list_covered, list_first, list_patch, list_u, list_v, list_result};
    shade_scene scene = {eye_points, patches, objects, lights};
    sample_references references = {reference_patch, reference_u, reference_v, 0};
    int lid = (int)get_local_id(0);
    int tile_samples = frame.tile_cells * frame.tile_cells;
    int pixels = tile_samples / (frame.pixel_samples * frame.pixel_samples);
    tile_run run = tiles_of_group(&frame);
    for (int tile = run.begin; tile < run.end; ++tile) {
        int base = tile * tile_samples;
        barrier(CLK_LOCAL_MEM_FENCE);
        if (lid == 0) found = 0;
        barrier(CLK_LOCAL_MEM_FENCE);
        if (touched[tile] != TILE_EMPTY) load_chunk_samples(&frame, list_key, &found, base, reference_patch, samples);
        barrier(CLK_LOCAL_MEM_FENCE);
        // Loops of no steps in the place of `continue`, with which PoCL's groups of many work-items crashed here.
        int todo = found != 0 ? pixels : 0;
        for (pixel_walk walk = walk_pixels(&frame, tile); pixel_number(&walk) < todo; next_pixel(&walk)) {
            int nearest = list_pixel(&frame, list, references, base, pixel_corner(&frame, &walk), pixel_number(&walk), true);
            if (nearest < 0 || (uint)list_key[nearest] != 0u || !surface_is_wanted(planes)) continue;
            surface_reference reference = look_up(&frame, references, 0u, base + nearest);
            write_surface(&frame, picture, planes, (uint)pixel_place(&frame, &walk), reference, patches, objects);
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        if (lid == 0) place_slots(list, todo);
        barrier(CLK_LOCAL_MEM_FENCE);
        for (int p = lid; p < todo; p += GROUP) fill_slots(&frame, list, references, base, p);
        barrier(CLK_LOCAL_MEM_FENCE);
        int points = list_first[todo];
        for (int i = lid * LANES; i < points; i += GROUP * LANES) shade_slots(&frame, list, i, points, scene);
        barrier(CLK_LOCAL_MEM_FENCE);
        for (pixel_walk walk = walk_pixels(&frame, tile); pixel_number(&walk) < todo; next_pixel(&walk)) {
            int corner = pixel_corner(&frame, &walk), p = pixel_number(&walk);
            store_radiances(&frame, list, base, corner, p, reference_patch, reference_u, reference_v, samples);
            if (planes.normal != NO_PLANE) store_normals(&frame, list, base, corner, p, normals);
        }
    }
}

// What shade_chunk made of the samples.
typedef struct {
    global const float* red;
    global const float* green;
    global const float* blue;
    global const float* normals;  // read only where the plane is wanted
} stored_radiances;

// Sums a pixel's samples and takes them from the film; `depth_key` becomes the nearest one's.
static inline pixel_sum take_samples(const frame_params* frame, stored_radiances stored, int first, bool normals, global ulong* samples,
                                     uint* depth_key) {
    pixel_sum sum = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0};
    *depth_key = 0xffffffffu;
    for (int j = 0; j < frame->pixel_samples; ++j) {
        for (int i = 0; i < frame->pixel_samples; ++i) {
            int s = first + j * frame->tile_cells + i;
            ulong key = samples[s];
            if (key == FILM_BACKGROUND) continue;
            samples[s] = FILM_BACKGROUND;
            sum.covered += 1;
            *depth_key = min(*depth_key, (uint)(key >> 32));
            sum.radiance.x += stored.red[s];
            sum.radiance.y += stored.green[s];
            sum.radiance.z += stored.blue[s];
            if (!normals) continue;
            global const float* normal = stored.normals + 3 * (size_t)s;
            sum.normal.x += normal[0];
            sum.normal.y += normal[1];
            sum.normal.z += normal[2];
        }
    }
    return sum;
}

// filter_tiles: box-filters the samples into pixels, a work-group a tile at a time, and leaves them empty for the next frame.
// In:  samples, all of them SAMPLE_SHADED or background; touched; red, green, blue, normals: what shade_chunk stored.
// Out: picture: rgba, Z, N, and every plane of pixels that show nothing; state->pixels_covered.
kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void filter_tiles(frame_params frame, picture_planes planes,
                                                                            global const float* red, global const float* green,
                                                                            global const float* blue, global const float* normals,
                                                                            global ulong* samples, global uchar* touched,
                                                                            global float* picture, global split_state* state) {
    stored_radiances stored = {red, green, blue, normals};
    int tile_samples = frame.tile_cells * frame.tile_cells;
    uint covered = 0u;
    tile_run run = tiles_of_group(&frame);
    for (int tile = run.begin; tile < run.end; ++tile) {
        bool empty = touched[tile] == TILE_EMPTY;
        barrier(CLK_LOCAL_MEM_FENCE);
        if (empty) {
            write_empty_tile(&frame, picture, planes, tile);
            continue;
        }
        for (pixel_walk walk = walk_pixels(&frame, tile); walk.row < walk.side; next_pixel(&walk)) {
            int place = pixel_place(&frame, &walk);
            // Cells outside the picture hold no samples.
            if (place < 0) continue;
            uint depth_key;
            int first = tile * tile_samples + pixel_corner(&frame, &walk);
            pixel_sum sum = take_samples(&frame, stored, first, planes.normal != NO_PLANE, samples, &depth_key);
            write_filtered(&frame, picture, planes, (uint)place, sum);
            if (sum.covered > 0)
                write_depth(picture, planes, (uint)place, depth_key);
            else
                write_no_surface(picture, planes, (uint)place);
            covered += sum.covered > 0 ? 1u : 0u;
        }
        if (get_local_id(0) == 0) touched[tile] = TILE_EMPTY;
    }
    if (covered > 0u) atomic_add(&state->pixels_covered, covered);
}
