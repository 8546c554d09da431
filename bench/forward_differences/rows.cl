// Points of inner rows of bicubic Bezier patches three ways, to compare their speed and error: each row's cubic evaluated anew at every
// point, the same cubic by forward differences with lanes over columns, each stepping LANES columns at a time, and with lanes over rows,
// each stepping one column.
// In:  nets (x[16], y[16], z[16] a patch), rate (columns and rows, at i / rate for i of 1 to rate; a multiple of 16).
// Out: points, x y z each, patch after patch, row after row. A group LANES rows in turn.
#include "mesh/vertex_store.clh"
#include "surface/patch_eval.clh"

// Cubics of LANES rows, by coordinate and point along u.
static inline void row_cubics(global const float* net, float first, float step, vfloat* q) {
    vfloat b[4];
    bezier_basis((first + vto_float(vlane_index())) * step, b);
    for (int k = 0; k < 12; ++k) {
        global const float* x = net + 16 * (k / 4) + k % 4;
        q[k] = cubic(b, (vfloat)(x[0]), (vfloat)(x[4]), (vfloat)(x[8]), (vfloat)(x[12]));
    }
}

// The same as tile[LANES * k + row], for lanes over columns.
static inline void row_tile(global const float* net, float first, float step, float* tile) {
    vfloat q[12];
    row_cubics(net, first, step, q);
    for (int k = 0; k < 12; ++k) store_lanes(q[k], tile + LANES * k);
}

// Point and three differences, of step h, of the cubic with Bezier points c0 to c3 from t on.
static inline void differences(vfloat c0, vfloat c1, vfloat c2, vfloat c3, vfloat t, float h, vfloat* d) {
    vfloat a1 = 3.0f * (c1 - c0), a2 = 3.0f * (c2 - 2.0f * c1 + c0), a3 = (c3 - c0) - 3.0f * (c2 - c1);
    d[0] = vfma(vfma(vfma(a3, t, a2), t, a1), t, c0);
    d[1] = h * vfma(a3, vfma(3.0f * t, t + h, (vfloat)(h * h)), vfma(a2, 2.0f * t + h, a1));
    d[2] = h * h * vfma(a3, 6.0f * (t + h), 2.0f * a2);
    d[3] = 6.0f * h * h * h * a3;
}

static inline void step_on(vfloat* d) {
    d[0] += d[1];
    d[1] += d[2];
    d[2] += d[3];
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void rows_direct(global const float* restrict nets, uint patches, int rate,
                                                                           global float* restrict points) {
    float step = 1.0f / (float)rate;
    uint blocks = (uint)(rate / LANES);
    for (uint block = (uint)get_group_id(0); block < patches * blocks; block += (uint)get_num_groups(0)) {
        uint patch = block / blocks;
        int row = (int)(block % blocks) * LANES;
        float tile[12 * LANES];
        row_tile(nets + 48 * patch, (float)(row + 1), step, tile);
        for (int r = 0; r < LANES; ++r) {
            global float* to = points + 3 * ((size_t)patch * rate + row + r) * rate;
            for (int i = 0; i < rate; i += LANES) {
                vfloat b[4];
                bezier_basis((float)(i + 1) * step + vto_float(vlane_index()) * step, b);
                const float* c = tile + r;
                vpoint p;
                p.x = cubic(b, (vfloat)(c[0]), (vfloat)(c[LANES]), (vfloat)(c[2 * LANES]), (vfloat)(c[3 * LANES]));
                p.y = cubic(b, (vfloat)(c[4 * LANES]), (vfloat)(c[5 * LANES]), (vfloat)(c[6 * LANES]), (vfloat)(c[7 * LANES]));
                p.z = cubic(b, (vfloat)(c[8 * LANES]), (vfloat)(c[9 * LANES]), (vfloat)(c[10 * LANES]), (vfloat)(c[11 * LANES]));
                mesh_store_positions(to + 3 * i, LANES, p);
            }
        }
    }
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void rows_by_columns(global const float* restrict nets, uint patches, int rate,
                                                                               global float* restrict points) {
    float step = 1.0f / (float)rate;
    vfloat t = (1.0f + vto_float(vlane_index())) * step;
    uint blocks = (uint)(rate / LANES);
    for (uint block = (uint)get_group_id(0); block < patches * blocks; block += (uint)get_num_groups(0)) {
        uint patch = block / blocks;
        int row = (int)(block % blocks) * LANES;
        float tile[12 * LANES];
        row_tile(nets + 48 * patch, (float)(row + 1), step, tile);
        for (int r = 0; r < LANES; ++r) {
            global float* to = points + 3 * ((size_t)patch * rate + row + r) * rate;
            vfloat d[3][4];
            for (int k = 0; k < 3; ++k) {
                const float* c = tile + 4 * LANES * k + r;
                differences((vfloat)(c[0]), (vfloat)(c[LANES]), (vfloat)(c[2 * LANES]), (vfloat)(c[3 * LANES]), t, LANES * step, d[k]);
            }
            for (int i = 0; i < rate; i += LANES) {
                vpoint p = {d[0][0], d[1][0], d[2][0]};
                mesh_store_positions(to + 3 * i, LANES, p);
                for (int k = 0; k < 3; ++k) step_on(d[k]);
            }
        }
    }
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void rows_by_rows(global const float* restrict nets, uint patches, int rate,
                                                                            global float* restrict points) {
    float step = 1.0f / (float)rate;
    uint blocks = (uint)(rate / LANES);
    for (uint block = (uint)get_group_id(0); block < patches * blocks; block += (uint)get_num_groups(0)) {
        uint patch = block / blocks;
        int row = (int)(block % blocks) * LANES;
        vfloat q[12], d[3][4];
        row_cubics(nets + 48 * patch, (float)(row + 1), step, q);
        for (int k = 0; k < 3; ++k) differences(q[4 * k], q[4 * k + 1], q[4 * k + 2], q[4 * k + 3], (vfloat)(step), step, d[k]);
        global float* to = points + 3 * ((size_t)patch * rate + row) * rate;
        for (int i = 0; i < rate; ++i) {
            float tile[3 * LANES];
            for (int k = 0; k < 3; ++k) store_lanes(d[k][0], tile + LANES * k);
            for (int r = 0; r < LANES; ++r) {
                global float* at = to + 3 * ((size_t)r * rate + i);
                at[0] = tile[r];
                at[1] = tile[LANES + r];
                at[2] = tile[2 * LANES + r];
            }
            for (int k = 0; k < 3; ++k) step_on(d[k]);
        }
    }
}
