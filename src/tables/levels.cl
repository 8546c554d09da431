// Which level each patch takes, and its pattern.
// table_levels    points, deviations -> levels: the least whose mesh is near enough, beyond TABLE_LEVELS where tables end
// table_grade     levels -> levels, so that neighbours differ by one at most: as often as there are levels
// table_patterns  levels -> patterns
// A mesh of 2^(n + 1) cells a side differs from that of 2^n by no more than at its new vertices: there it is the surface's point less
// the middle of the old segment or diagonal. Of this difference counts what stands upright on the surface there, and at a patch's side
// what stands upright on the side: what lies within moves points along the surface, not off it, and at irregular corners it is by far the
// greater part. The sum of the greatest over all levels from n on is how far the mesh of level n is from the surface; what comes behind
// level 5 falls by `decay` from level to level.
#include "tables/sums.clh"

constant uint table_first_deviation[TABLE_LEVELS] = {0u, 16u, 48u, 128u, 400u, TABLE_DEVIATIONS};

// Squared: the part of a difference that is across `along` and, where there is one, `other`.
static inline vfloat table_upright(vpoint off, vpoint along, vpoint other) {
    vpoint n = {along.y * other.z - along.z * other.y, along.z * other.x - along.x * other.z, along.x * other.y - along.y * other.x};
    vfloat normal = n.x * n.x + n.y * n.y + n.z * n.z, square = off.x * off.x + off.y * off.y + off.z * off.z;
    vfloat up = off.x * n.x + off.y * n.y + off.z * n.z;
    vfloat length = along.x * along.x + along.y * along.y + along.z * along.z;
    vfloat dot = off.x * along.x + off.y * along.y + off.z * along.z;
    vfloat least = (vfloat)(1e-30f);
    vfloat beside = vselect(square, fmax(square - dot * dot / fmax(length, least), 0.0f), vlt(least, length));
    // A normal that is nothing but rounding tells no direction.
    return vselect(beside, up * up / fmax(normal, least), vlt(length * length * 1e-8f + least, normal));
}

// The greatest distance, squared, at columns [begin, end) of a table.
static inline float table_greatest(global const float* restrict table, uint rows, global const uint* restrict entries,
                                   global const float* restrict points, uint begin, uint end) {
    vfloat most = (vfloat)(0.0f);
    for (uint c = begin; c < end; c += LANES) {
        vpoint none = {(vfloat)(0.0f), (vfloat)(0.0f), (vfloat)(0.0f)};
        vpoint off = none, along = none, other = none;
        for (uint k = 0u; k < rows; ++k) {
            global const float* p = points + 3ul * entries[k];
            global const float* w = table + 3ul * k * TABLE_DEVIATIONS + c;
            off = table_add(off, load_lanes(w), p[0], p[1], p[2]);
            along = table_add(along, load_lanes(w + TABLE_DEVIATIONS), p[0], p[1], p[2]);
            other = table_add(other, load_lanes(w + 2u * TABLE_DEVIATIONS), p[0], p[1], p[2]);
        }
        most = fmax(most, table_upright(off, along, other));
    }
#if LANES == 1
    return most;
#else
    return vmost(most);
#endif
}

// What a patch may be off by: of the point nearest to the eye, where tolerances grow with the distance.
static inline float table_tolerance(const mesh_view* view, uint rows, global const uint* restrict entries,
                                    global const float* restrict points) {
    if (view->view == 0u) return view->tolerance;
    float nearest = INFINITY;
    for (uint k = 0u; k < rows; ++k) {
        global const float* p = points + 3ul * entries[k];
        const float* row = view->eye_from_world + 8;
        nearest = fmin(nearest, row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]);
    }
    return fmax(view->tolerance * fmax(nearest, view->near_plane), view->least_tolerance);
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void table_levels(
    table_run run, mesh_view view, uint most_level, global const table_info* restrict infos, global const float* restrict deviations,
    global const table_object* restrict objects, global const table_face* restrict faces, global const uint* restrict by_row,
    global const float* restrict points, global uint* restrict levels) {
    for (uint patch = (uint)get_global_id(0); patch < run.patches; patch += (uint)get_global_size(0)) {
        table_placed placed = table_placed_of(objects, run.objects, faces, patch);
        table_info info = infos[placed.face.table];
        global const float* own = points + 3ul * placed.first_point;
        global const uint* entries = by_row + placed.face.first_entry;
        global const float* table = deviations + 3ul * info.first_row * TABLE_DEVIATIONS;
        float tolerance = table_tolerance(&view, info.rows, entries, own);
        float finest = sqrt(table_greatest(table, info.rows, entries, own, table_first_deviation[4], table_first_deviation[5]));
        // Level 5 and beyond: geometric sums.
        float behind = finest * info.decay / (1.0f - info.decay);
        uint level = TABLE_LEVELS - 1u;
        if (behind > tolerance) {
            for (; level < most_level && behind > tolerance; ++level) behind *= info.decay;
        } else {
            float sum = behind + finest;
            for (; level > 0u && sum <= tolerance; --level) {
                if (level >= 2u) {
                    sum += sqrt(table_greatest(table, info.rows, entries, own, table_first_deviation[level - 2u],
                                               table_first_deviation[level - 1u]));
                }
            }
        }
        levels[patch] = level;
    }
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void table_grade(table_run run, global const table_object* restrict objects,
                                                                           global const table_face* restrict faces,
                                                                           global const uint* restrict from, global uint* restrict to) {
    for (uint patch = (uint)get_global_id(0); patch < run.patches; patch += (uint)get_global_size(0)) {
        table_placed placed = table_placed_of(objects, run.objects, faces, patch);
        uint level = from[patch];
        for (int s = 0; s < 4; ++s) {
            uint other = from[placed.first_patch + placed.face.beside[s]];
            level = max(level, other == 0u ? 0u : other - 1u);
        }
        to[patch] = level;
    }
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void table_patterns(table_run run, global const table_object* restrict objects,
                                                                              global const table_face* restrict faces,
                                                                              global const uint* restrict levels,
                                                                              global mesh_pattern* restrict patterns) {
    for (uint patch = (uint)get_global_id(0); patch < run.patches; patch += (uint)get_global_size(0)) {
        table_placed placed = table_placed_of(objects, run.objects, faces, patch);
        uint level = levels[patch], cells = 1u << level;
        mesh_pattern p;
        p.form = level == 0u ? MESH_RIBBON_U : MESH_RING;
        for (int s = 0; s < 4; ++s) p.side[s] = 1u << min(level, levels[placed.first_patch + placed.face.beside[s]]);
        p.cells_u = level == 0u ? 0u : cells;
        p.cells_v = p.cells_u;
        p.low_u = (1u << 24) / cells;
        p.high_u = (1u << 24) - p.low_u;
        p.low_v = p.low_u;
        p.high_v = p.high_u;
        p.refused = 0u;
        p.turned = 0u;
        patterns[patch] = p;
    }
}
