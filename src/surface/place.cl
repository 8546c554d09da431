// place_patches: object-space control points in file order -> eye-space control points, x[], y[], z[] a patch.
// In:  points (as uploaded, 3 floats each), patches (one placed_patch a patch), objects (this frame's matrices).
// Out: eye_points: Bezier patches first, 48 floats each, then Gregory patches, 60 floats each, in net order.
// A work-item a patch; the NDRange covers all patches. Memory: 192 or 240 bytes a patch.
#include "core/frame_shared.h"
#include "device/lanes.clh"
#include "surface/patch_nets.clh"

constant int gregory_net_source[GREGORY_POINTS] = {0, 4, 9, 1, 8, 12, 13, 5, 7, 15, 14, 10, 3, 11, 6, 2, 16, 17, 18, 19};

kernel void place_patches(frame_params frame, global const float* points, global const placed_patch* patches,
                          global const placed_object* objects, global float* eye_points) {
    for (uint patch_index = (uint)get_global_id(0); patch_index < frame.patches; patch_index += (uint)get_global_size(0)) {
        int count = patch_point_count(&frame, patch_index);
        placed_patch placed = patches[patch_index];
        global const float* m = objects[placed.object].eye_from_object;
        global float* net = eye_points + patch_offset(&frame, patch_index);
        for (int k = 0; k < count; ++k) {
            int source = count == GREGORY_POINTS ? gregory_net_source[k] : k;
            global const float* p = points + 3 * (placed.first_point + (uint)source);
            float x = p[0], y = p[1], z = p[2];
            net[k] = m[0] * x + m[1] * y + m[2] * z + m[3];
            net[count + k] = m[4] * x + m[5] * y + m[6] * z + m[7];
            net[2 * count + k] = m[8] * x + m[9] * y + m[10] * z + m[11];
        }
    }
}
