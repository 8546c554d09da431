// Control points of tables: coarse steps of Catmull-Clark, and objects' places.
// table_stencils  sources -> points: each the sum of a cage's points times weights, in the stencil's order
// table_place     sources -> points in world space, of one object
#include "tables/faces.clh"

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void table_stencils(
    uint count, uint first_source, uint first_point, global const uint* restrict starts, global const uint* restrict indices,
    global const float* restrict weights, global const float* restrict sources, global float* restrict points) {
    for (uint i = (uint)get_global_id(0); i < count; i += (uint)get_global_size(0)) {
        float x = 0.0f, y = 0.0f, z = 0.0f;
        for (uint k = starts[i]; k < starts[i + 1u]; ++k) {
            global const float* p = sources + 3ul * (first_source + indices[k]);
            x = fma(weights[k], p[0], x);
            y = fma(weights[k], p[1], y);
            z = fma(weights[k], p[2], z);
        }
        global float* to = points + 3ul * (first_point + i);
        to[0] = x;
        to[1] = y;
        to[2] = z;
    }
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void table_place(table_object object, global const float* restrict sources,
                                                                           global float* restrict points) {
    for (uint i = (uint)get_global_id(0); i < object.points; i += (uint)get_global_size(0)) {
        global const float* p = sources + 3ul * (object.first_source + i);
        global float* to = points + 3ul * (object.first_point + i);
        for (int c = 0; c < 3; ++c) {
            float sum = object.world_from_object[4 * c + 3];
            for (int d = 0; d < 3; ++d) sum = fma(object.world_from_object[4 * c + d], p[d], sum);
            to[c] = sum;
        }
    }
}
