// place_patches: object-space control points in file order -> eye-space control points, a net a patch (patch_shared.h).
// place_records: the same for the curves of edge records, behind the patches' nets.
// place_boxes: what each patch may cover of the picture, from what the other two have placed.
// In:  points (as uploaded, floats), patches (one placed_patch a patch) or records, objects (this frame's matrices).
// Out: eye_points: by kind; 192 bytes a Bezier patch or PN triangle, 240 a Gregory, 304 a rational patch, 64 a record.
//      boxes: a patch_box a patch.
// A work-item a patch or record in turn.
// The same object-space bits give the same eye-space bits, whatever the kind, as far as objects have the same matrix and a weight is 1.
#include "core/frame_shared.h"
#include "device/lanes.clh"
#include "surface/patch_box.clh"

constant int gregory_net_source[GREGORY_POINTS] = {0, 4, 9, 1, 8, 12, 13, 5, 7, 15, 14, 10, 3, 11, 6, 2, 16, 17, 18, 19};

// A row of the matrix times (x, y, z, w).
static inline float place_row(global const float* row, float x, float y, float z, float w) {
    return row[0] * x + row[1] * y + row[2] * z + row[3] * w;
}

// Points of x, y, z, w multiplied by w, into `count` places a coordinate.
static inline void place_homogeneous(global const float* m, global const float* points, int count, global float* net) {
    for (int k = 0; k < count; ++k) {
        float x = points[4 * k], y = points[4 * k + 1], z = points[4 * k + 2], w = points[4 * k + 3];
        net[k] = place_row(m, x, y, z, w);
        net[count + k] = place_row(m + 4, x, y, z, w);
        net[2 * count + k] = place_row(m + 8, x, y, z, w);
        net[3 * count + k] = w;
    }
}

// The corners of a rational patch, as a polynomial neighbour would have them. They are uploaded behind its homogeneous points.
static inline void place_corners(global const float* m, global const float* corners, global float* net) {
    for (int k = 0; k < 4; ++k) {
        float x = corners[3 * k], y = corners[3 * k + 1], z = corners[3 * k + 2];
        net[k] = place_row(m, x, y, z, 1.0f);
        net[4 + k] = place_row(m + 4, x, y, z, 1.0f);
        net[8 + k] = place_row(m + 8, x, y, z, 1.0f);
    }
}

// Sixteen points at once, each coordinate as place_row gives it.
static inline void place_sixteen(global const float* m, global const float* points, float16 w, global float* net) {
    float16 a = vload16(0, points), b = vload16(1, points), c = vload16(2, points);
    float16 x = (float16)(a.s0369, a.scf, b.s25, b.s8b, b.se, c.s1, c.s47ad);
    float16 y = (float16)(a.s147a, a.sd, b.s0, b.s369c, b.sf, c.s2, c.s58be);
    float16 z = (float16)(a.s258b, a.se, b.s1, b.s47ad, c.s0369, c.scf);
    for (int row = 0; row < 3; ++row) {
        global const float* r = m + 4 * row;
        vstore16(r[0] * x + r[1] * y + r[2] * z + r[3] * w, row, net);
    }
}

static inline void place_gregory(global const float* m, global const float* points, global float* net) {
    for (int k = 0; k < GREGORY_POINTS; ++k) {
        global const float* p = points + 3 * gregory_net_source[k];
        float x = p[0], y = p[1], z = p[2];
        net[k] = place_row(m, x, y, z, 1.0f);
        net[GREGORY_POINTS + k] = place_row(m + 4, x, y, z, 1.0f);
        net[2 * GREGORY_POINTS + k] = place_row(m + 8, x, y, z, 1.0f);
    }
}

kernel void place_patches(frame_params frame, global const float* points, global const placed_patch* patches,
                          global const placed_object* objects, global float* eye_points) {
    for (uint patch_index = (uint)get_global_id(0); patch_index < frame.patches; patch_index += (uint)get_global_size(0)) {
        placed_patch placed = patches[patch_index];
        global const float* m = objects[placed.object].eye_from_object;
        global float* net = eye_points + patch_offset(&frame, patch_index);
        int kind = patch_kind(&frame, patch_index);
        if (kind == KIND_RATIONAL) {
            place_homogeneous(m, points + placed.first_float, 16, net);
            place_corners(m, points + placed.first_float + 64, net + 64);
        } else if (kind == KIND_GREGORY) {
            place_gregory(m, points + placed.first_float, net);
        } else {
            // Of a PN triangle the last six are normals, which only turn.
            float16 all = (float16)(1.0f);
            if (kind == KIND_PN) all.hi = (float8)(1.0f, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f);
            place_sixteen(m, points + placed.first_float, all, net);
        }
    }
}

kernel void place_records(frame_params frame, uint records, global const float* points, global const edge_info* info,
                          global const placed_object* objects, global float* eye_points) {
    for (uint r = (uint)get_global_id(0); r < records; r += (uint)get_global_size(0)) {
        global const float* m = objects[info[r].object].eye_from_object;
        place_homogeneous(m, points + info[r].first_float, 4, eye_points + record_offset(&frame, r));
    }
}

kernel void place_boxes(frame_params frame, global const float* eye_points, global const placed_patch* patches,
                        global const edge_info* records, global patch_box* boxes) {
    for (uint patch_index = (uint)get_global_id(0); patch_index < frame.patches; patch_index += (uint)get_global_size(0))
        boxes[patch_index] = patch_box_of(&frame, patch_at(&frame, eye_points, patches, records, patch_index));
}
