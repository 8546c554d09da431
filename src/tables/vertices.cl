// Vertices of patches: tables times control points.
// In:  run; tables of the levels that patches have; faces, their control points, objects; patterns and offsets (mesh/offsets.cl).
// Out: vertices: mesh_vertex, or three floats; those of run.first_patch to run.end_patch, from run.first_vertex on.
// A group takes a run of patches, so that faces of one table follow each other; its work-items share a patch's points. A face makes all
// points of its level. Where a neighbour is coarser, those of the side that it has not are left out.
#include "mesh/vertex_store.clh"
#include "tables/sums.clh"

typedef struct {
    global float* to;  // the patch's first vertex
    float2 ids;
    uint turn;
    uint level;
    uint loop;  // vertices of the pattern's loop
    uint side[4];
    bool whole;  // whether no side has fewer segments than cells
} table_target;

// The pattern's number of a point of the table; 0xffffffff where it has none.
static inline uint table_vertex(const table_target* target, uint column) {
    uint cells = 1u << target->level, all = 4u * cells;
    if (column >= all) return target->loop + (column - all);
    uint first = 0u, side = column >> target->level, at = column & (cells - 1u);
    for (uint s = 0u; s < side; ++s) first += target->side[s];
    uint step = cells / target->side[side];
    return at % step == 0u ? first + at / step : 0xffffffffu;
}

// The point's own parameters: the face's, whose corner `turn` is the table's first.
static inline void table_own_place(uint turn, vfloat u, vfloat v, vfloat* own_u, vfloat* own_v) {
    vfloat one = (vfloat)(1.0f);
    *own_u = turn == 0u ? u : turn == 1u ? one - v : turn == 2u ? one - u : v;
    *own_v = turn == 0u ? v : turn == 1u ? u : turn == 2u ? one - v : one - u;
}

// Points from `column` on, `count` of them; words: a vector each. A patch with a coarser neighbour has some of them.
static inline void table_store(const table_target* target, uint column, uint count, const vfloat* words, vpoint position,
                               bool positions_only) {
    uint all = 4u << target->level, size = positions_only ? 3u : MESH_VERTEX_WORDS;
    if (target->whole || column >= all) {
        global float* to = target->to + (ulong)size * table_vertex(target, column);
        if (positions_only)
            mesh_store_positions(to, (int)count, position);
        else
            mesh_store(to, (int)count, words, target->ids);
        return;
    }
    float tile[MESH_LANE_WORDS * LANES];
    for (uint k = 0u; k < (positions_only ? 3u : MESH_LANE_WORDS); ++k) store_lanes(words[k], tile + LANES * k);
    for (uint l = 0u; l < count; ++l) {
        uint vertex = table_vertex(target, column + l);
        if (vertex == 0xffffffffu) continue;
        global float* to = target->to + (ulong)size * vertex;
        for (uint k = 0u; k < (positions_only ? 3u : MESH_LANE_WORDS); ++k) to[k] = tile[LANES * k + l];
        if (!positions_only) vstore2(target->ids, 4, to);
    }
}

// The last three are constants where it is called.
static inline __attribute__((always_inline)) void table_points(const table_source* source, const table_target* target,
                                                               global const float* places, uint column, bool by_number, bool positions_only,
                                                               int blocks) {
    table_sums sums = table_sum(source, column, by_number, !positions_only, blocks);
    uint columns = table_columns(target->level);
#pragma unroll
    for (int b = 0; b < blocks; ++b) {
        uint at = column + (uint)(b * LANES);
        vfloat words[MESH_LANE_WORDS];
        vpoint normal = table_normal(sums.du[b], sums.dv[b]);
        // Neither side of an edge may have a zero of another sign.
        words[0] = sums.position[b].x + 0.0f;
        words[1] = sums.position[b].y + 0.0f;
        words[2] = sums.position[b].z + 0.0f;
        words[3] = normal.x;
        words[4] = normal.y;
        words[5] = normal.z;
        vpoint position = {words[0], words[1], words[2]};
        if (!positions_only)
            table_own_place(target->turn, load_lanes(places + at), load_lanes(places + source->padded + at), &words[6], &words[7]);
        table_store(target, at, min((uint)LANES, columns - at), words, position, positions_only);
    }
}

static inline __attribute__((always_inline)) void table_patch(const table_source* source, const table_target* target,
                                                              global const float* places, bool by_number, bool positions_only, uint lid) {
    uint columns = table_columns(target->level);
    for (uint column = lid * TABLE_BLOCKS * LANES; column < columns; column += GROUP * TABLE_BLOCKS * LANES) {
        if (TABLE_BLOCKS == 1 || columns - column <= LANES)
            table_points(source, target, places, column, by_number, positions_only, 1);
        else
            table_points(source, target, places, column, by_number, positions_only, TABLE_BLOCKS);
    }
}

// Places of a level's points in one buffer: u, then v, level by level.
static inline uint table_first_place(uint level) {
    uint first = 0u;
    for (uint l = 0u; l < level; ++l) first += 2u * table_padded(l);
    return first;
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void table_vertices(
    table_run run, global const float* restrict p0, global const float* restrict p1, global const float* restrict p2,
    global const float* restrict p3, global const float* restrict p4, global const float* restrict p5, global const float* restrict t0,
    global const float* restrict t1, global const float* restrict t2, global const float* restrict t3, global const float* restrict t4,
    global const float* restrict t5, global const float* restrict places, global const table_info* restrict infos,
    global const table_object* restrict objects, global const table_face* restrict faces, global const uint* restrict entries,
    global const ushort* restrict rows_of, global const float* restrict points, global const mesh_pattern* restrict patterns,
    global const mesh_offset* restrict offsets, global float* restrict vertices) {
    uint lid = (uint)get_local_id(0);
    ulong group = get_group_id(0), groups = get_num_groups(0), count = run.end_patch - run.first_patch;
    uint begin = run.first_patch + (uint)(count * group / groups), end = run.first_patch + (uint)(count * (group + 1u) / groups);
    ulong first_vertex = ((ulong)run.first_vertex_high << 32) | run.first_vertex_low;
    bool positions_only = run.positions_only != 0u, by_number = run.by_number != 0u;
    for (uint patch = begin; patch < end; ++patch) {
        table_placed placed = table_placed_of(objects, run.objects, faces, patch);
        table_info info = infos[placed.face.table];
        global const mesh_pattern* pattern = patterns + patch;
        table_target target;
        uint cells = max(pattern->cells_u, 1u);
        target.level = 31u - clz(cells);
        target.whole = true;
        target.loop = 0u;
        for (int s = 0; s < 4; ++s) {
            target.side[s] = pattern->side[s];
            target.loop += target.side[s];
            target.whole = target.whole && target.side[s] == cells;
        }
        target.turn = placed.face.turn;
        target.ids = as_float2((uint2)(placed.id, placed.face.number));
        target.to = vertices + (positions_only ? 3ul : (ulong)MESH_VERTEX_WORDS) * (offsets[patch].vertices - first_vertex);
        table_source source;
        source.rows = info.rows;
        source.padded = table_padded(target.level);
        uint l = target.level;
        global const float* level_positions = l == 0u ? p0 : l == 1u ? p1 : l == 2u ? p2 : l == 3u ? p3 : l == 4u ? p4 : p5;
        global const float* level_tangents = l == 0u ? t0 : l == 1u ? t1 : l == 2u ? t2 : l == 3u ? t3 : l == 4u ? t4 : t5;
        source.positions = level_positions + (ulong)info.first_row * source.padded;
        source.tangents = level_tangents + 2ul * info.first_row * source.padded;
        source.points = points + 3ul * placed.first_point;
        source.entries = entries + placed.face.first_entry;
        source.rows_of = rows_of + placed.face.first_entry;
        global const float* own_places = places + table_first_place(target.level);
        if (by_number) {
            if (positions_only)
                table_patch(&source, &target, own_places, true, true, lid);
            else
                table_patch(&source, &target, own_places, true, false, lid);
        } else {
            if (positions_only)
                table_patch(&source, &target, own_places, false, true, lid);
            else
                table_patch(&source, &target, own_places, false, false, lid);
        }
    }
}
