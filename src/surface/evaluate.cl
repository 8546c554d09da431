// evaluate_points: position and tangents at a list of surface points, with the function that dice and shade use.
// In:  points (patch, u, v); eye_points as place_patches left them. Out: 9 floats a point: position, du, dv. A work-item a point, in all
// its lanes.
#include "device/lanes.clh"
#include "surface/evaluate_shared.h"
#include "surface/patch_eval.clh"
#include "surface/patch_nets.clh"

kernel void evaluate_points(frame_params frame, global const float* eye_points, global const evaluate_point* points, uint count,
                            global float* out) {
    for (uint i = (uint)get_global_id(0); i < count; i += (uint)get_global_size(0)) {
        evaluate_point point = points[i];
        vpoint du, dv;
        vpoint p = patch_tangents(eye_points + patch_offset(&frame, point.patch_index), patch_kind(&frame, point.patch_index),
                                  (vfloat)(point.u), (vfloat)(point.v), &du, &dv);
        global float* to = out + 9u * i;
        to[0] = vfirst(p.x);
        to[1] = vfirst(p.y);
        to[2] = vfirst(p.z);
        to[3] = vfirst(du.x);
        to[4] = vfirst(du.y);
        to[5] = vfirst(du.z);
        to[6] = vfirst(dv.x);
        to[7] = vfirst(dv.y);
        to[8] = vfirst(dv.z);
    }
}
