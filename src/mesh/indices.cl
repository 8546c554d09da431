// Last stage of a tessellation: the triangles.
// In:  piece: a run of units; offsets (offsets.cl), patterns: of all patches.
// Out: indices: three a triangle (pattern.clh tells their order), into the piece's vertices.
// A work-group makes MESH_INDEX_UNITS units in turn. Within a unit its work-items share the work: slices of transition regions, runs of
// inner cells. No local memory, no barriers.
#include "device/lanes.clh"
#include "mesh/pattern.clh"

#define MESH_INDEX_UNITS 8u
// Cells of two triangles take six indices: so many vectors hold whole cells.
#define CELL_VECTORS (LANES == 1 ? 6 : 3)
#define CELLS_AT_ONCE (CELL_VECTORS * LANES / 6)

// The buffer's numbers of vertices that follow each other along a line: first, first + step, first + 2 step + turn, ...
typedef struct {
    uint first;
    uint step;
    uint turn;  // what each step is more than the one before; all wrap around at 2^32
    uint past;  // the number behind the loop's last, where the loop starts again ...
    uint again;
} index_line;

static inline uint line_settle(index_line line, uint number) { return number == line.past ? line.again : number; }

static inline index_line plain_line(uint first, uint step, uint turn) {
    index_line line = {first, step, turn, first - 1u, first - 1u};
    return line;
}

// Side s of a pattern whose first vertex is `base`, in its own direction.
static inline index_line loop_line(const mesh_pattern* p, int s, uint base) {
    index_line line;
    uint loop = mesh_loop(p);
    line.first = base + (s == 0 ? 0u : s == 1 ? p->side[0] : s == 2 ? p->side[0] + p->side[1] + p->side[2] : loop);
    line.step = s < 2 ? 1u : 0xffffffffu;
    line.turn = 0u;
    line.past = base + loop;
    line.again = base;
    return line;
}

// The inner line beside side s, in the same direction.
static inline index_line beside_line(const mesh_pattern* p, int s, uint base) {
    uint first = base + mesh_beside_vertex(p, s, 0u), width = mesh_inner_cells(p) + 1u;
    if ((s & 1) == 0) return plain_line(first, 1u, 0u);
    if (!mesh_is_triangle(p)) return plain_line(first, width, 0u);
    return plain_line(first, s == 1 ? width - 1u : width, 0xffffffffu);
}

// Of a patch that is `turned` the other way round.
static inline void put_triangle(global uint* to, uint turned, uint a, uint b, uint c) {
    to[0] = a;
    to[1] = turned ? c : b;
    to[2] = turned ? b : c;
}

// A transition region between two lines.
typedef struct {
    mesh_zip zip;
    index_line outer;
    index_line inner;
    uint mirrored;  // 0 or 1: the inner line lies to the right of the outer one, or to the left in a patch that is turned
    uint first;     // of the zip's triangles the first that is there, ...
    uint end;       // ... and the first behind them
} index_region;

// Triangles [begin, end) of the region's zip, which `to` follows from its first on.
static inline void put_slice(const index_region* region, uint begin, uint end, global uint* to) {
    index_region r = *region;
    uint i = mesh_zip_skip(&r.zip, begin), k = begin - i;
    uint inner_step = r.inner.step + k * r.inner.turn;
    uint outer_raw = r.outer.first + i * r.outer.step;
    uint inner_raw = r.inner.first + k * r.inner.step + r.inner.turn * (k * (k - 1u) / 2u);
    uint outer = line_settle(r.outer, outer_raw), inner = line_settle(r.inner, inner_raw);
    to += 3ul * (begin - r.first);
    uint t = begin;
    for (; t < end && i < r.zip.outer && k < r.zip.inner; ++t, to += 3) {
        bool take = mesh_zip_outer(&r.zip, i, k);
        uint next_outer = line_settle(r.outer, outer_raw + r.outer.step);
        uint next_inner = line_settle(r.inner, inner_raw + inner_step);
        to[0] = outer;
        to[1 + r.mirrored] = take ? next_outer : next_inner;
        to[2 - r.mirrored] = inner;
        mesh_zip_step(&r.zip, take);
        i += take ? 1u : 0u;
        k += take ? 0u : 1u;
        outer_raw += take ? r.outer.step : 0u;
        inner_raw += take ? 0u : inner_step;
        inner_step += take ? 0u : r.inner.turn;
        outer = take ? next_outer : outer;
        inner = take ? inner : next_inner;
    }
    // One line is at its end: a fan of the other's segments.
    for (; t < end && i < r.zip.outer; ++t, ++i, to += 3) {
        outer_raw += r.outer.step;
        uint next = line_settle(r.outer, outer_raw);
        put_triangle(to, r.mirrored, outer, next, inner);
        outer = next;
    }
    for (; t < end; ++t, to += 3) {
        inner_raw += inner_step;
        inner_step += r.inner.turn;
        uint next = line_settle(r.inner, inner_raw);
        put_triangle(to, r.mirrored, outer, next, inner);
        inner = next;
    }
}

// The work-item's share of a region.
// By reference: a copy would read what was just written in pieces, and wait for that.
static inline void put_region(const index_region* r, uint lid, global uint* to) {
    uint count = r->end - r->first, share = (count + GROUP - 1u) / GROUP;
    uint begin = min(lid * share, count), end = min(begin + share, count);
    if (begin < end) put_slice(r, r->first + begin, r->first + end, to);
}

// All that lies between side s and the inner line beside it. A unit that is a side has no vertices but theirs.
static inline void put_side(const mesh_pattern* p, int s, bool alone, uint base, uint lid, global uint* to) {
    index_region r;
    r.zip = mesh_side_zip(p, s);
    r.outer = alone ? plain_line(base, 1u, 0u) : loop_line(p, s, base);
    r.inner = alone ? plain_line(base + p->side[s] + 1u, 1u, 0u) : beside_line(p, s, base);
    r.mirrored = (s >= 2 ? 1u : 0u) ^ p->turned;
    r.first = 0u;
    r.end = r.zip.outer + r.zip.inner;
    put_region(&r, lid, to);
}

// Between sides `near_side` and `far_side`; `start` and `end` are the sides at the ribbon's ends.
static inline void put_ribbon(const mesh_pattern* p, int near_side, int far_side, int start, int end, uint base, uint lid,
                              global uint* to) {
    index_region r;
    r.zip = mesh_zip_of(p->side[near_side], p->side[far_side], 0u, 2u * MESH_ONE);
    r.outer = loop_line(p, near_side, base);
    r.inner = loop_line(p, far_side, base);
    r.mirrored = (near_side == 3 ? 1u : 0u) ^ p->turned;
    // Where an end is a point, two corners of the triangle there are one.
    r.first = p->side[start] == 0u ? 1u : 0u;
    r.end = r.first + mesh_ribbon_triangles(p->side[near_side], p->side[far_side], p->side[start], p->side[end]);
    put_region(&r, lid, to);
}

// Side s and the corner opposite, which has number `apex` in the loop.
static inline void put_fan(const mesh_pattern* p, int s, uint apex, uint base, uint lid, global uint* to) {
    index_region r;
    r.zip = mesh_zip_of(p->side[s], 0u, 0u, 2u * MESH_ONE);
    r.outer = loop_line(p, s, base);
    r.inner = plain_line(base + apex, 0u, 0u);
    r.mirrored = (s == 3 ? 1u : 0u) ^ p->turned;
    r.first = 0u;
    r.end = p->side[s];
    put_region(&r, lid, to);
}

// What the indices of CELLS_AT_ONCE cells are made of, in the order in which they are stored: a vector's cells, and how much more each
// number is than its cell's first corner.
typedef struct {
    vint cell[CELL_VECTORS];
    vint more[CELL_VECTORS];
} cell_vectors;

static inline cell_vectors cell_vectors_of(uint width, uint turned) {
    cell_vectors v;
#pragma unroll
    for (int k = 0; k < CELL_VECTORS; ++k) {
        vint index = vlane_index() + (vint)(k * LANES);
        v.cell[k] = index / (vint)(6);
        vint corner = index - v.cell[k] * (vint)(6);
        // Corners a, b, c, a, c, d: b and c lie one column on, c and d one row. Turned, b and d change places.
        vint to_c = veq(corner, (vint)(2)) | veq(corner, (vint)(4));
        vint column = to_c | veq(corner, (vint)(turned ? 5 : 1));
        vint row = to_c | veq(corner, (vint)(turned ? 1 : 5));
        v.more[k] = v.cell[k] - column + (row & (vint)((int)width));
    }
    return v;
}

// Indices of cells from the q-th on. Rows are counted by a quotient that is exact: fewer than 2^21 cells are in a unit.
static inline vint cell_indices(const cell_vectors* v, int k, uint q, uint base, float per_row) {
    vint row = vto_int((vto_float((vint)((int)q) + v->cell[k]) + (vfloat)(0.5f)) * (vfloat)(per_row));
    return (vint)((int)(base + q)) + v->more[k] + row;
}

// Rows of `cells` cells each, `count` cells in all; `base` is the first row's first vertex.
static inline void put_cells(uint cells, uint count, uint turned, uint base, uint lid, global uint* to) {
    cell_vectors v = cell_vectors_of(cells + 1u, turned);
    float per_row = 1.0f / (float)cells;
    for (uint next = lid * CELLS_AT_ONCE; next < count; next += GROUP * CELLS_AT_ONCE) {
        if (count < CELLS_AT_ONCE) {
            for (int k = 0; k < CELL_VECTORS; ++k) {
                int spill[LANES];
                store_lanes(cell_indices(&v, k, 0u, base, per_row), spill);
                for (uint l = 0; l < LANES && (uint)k * LANES + l < 6u * count; ++l) to[(uint)k * LANES + l] = (uint)spill[l];
            }
        } else {
            // The last vectors end with the last cell, and store some cells once more.
            uint q = min(next, count - (uint)CELLS_AT_ONCE);
#pragma unroll
            for (int k = 0; k < CELL_VECTORS; ++k)
                store_lanes(cell_indices(&v, k, q, base, per_row), (global int*)to + 6ul * q + (ulong)(k * LANES));
        }
    }
}

// Rows [first, end) of a triangle's inner cells; `base` is the first of their vertices.
static inline void put_triangle_rows(const mesh_pattern* p, uint first, uint end, uint base, uint lid, global uint* to) {
    uint skipped = (uint)mesh_rows_before(p, first);
    for (uint j = first + lid; j < end; j += GROUP) {
        uint cells = mesh_inner_cells(p) - j;
        uint a = base + (uint)mesh_rows_before(p, j) - skipped, above = a + cells + 1u;
        global uint* row = to + 3ul * mesh_rows_triangles(p, first, j);
        put_triangle(row, p->turned, a, a + 1u, above);
        for (uint i = 1; i < cells; ++i) {
            put_triangle(row + 6ul * i - 3u, p->turned, a + i, above + i, above + i - 1u);
            put_triangle(row + 6ul * i, p->turned, a + i, a + i + 1u, above + i);
        }
    }
}

// Row j of a uniform grid's vertices: the ends are the loop's.
typedef struct {
    uint first;
    uint last;
    uint between;  // the number of the second, less one
    uint count;    // vertices, less one
} grid_row;

static inline grid_row grid_row_of(const mesh_pattern* p, uint j, uint base) {
    uint n = p->cells_u;
    grid_row row;
    row.first = base + (j == 0u ? 0u : 3u * n - j);
    row.last = base + n + j;
    row.between = j == 0u ? base : base + 3u * n + (uint)mesh_rows_before(p, j - 1u) - 1u;
    row.count = n - j;
    return row;
}

static inline uint grid_vertex(grid_row row, uint i) { return i == 0u ? row.first : i == row.count ? row.last : row.between + i; }

static inline void put_grid(const mesh_pattern* p, uint base, uint lid, global uint* to) {
    uint n = p->cells_u;
    for (uint j = lid; j < n; j += GROUP) {
        grid_row under = grid_row_of(p, j, base), above = grid_row_of(p, j + 1u, base);
        global uint* row = to + 3ul * (n * n - (n - j) * (n - j));
        put_triangle(row, p->turned, under.first, grid_vertex(under, 1u), above.first);
        for (uint i = 1; i < under.count; ++i) {
            uint a = grid_vertex(under, i), d = grid_vertex(above, i);
            put_triangle(row + 6ul * i - 3u, p->turned, a, d, grid_vertex(above, i - 1u));
            put_triangle(row + 6ul * i, p->turned, a, grid_vertex(under, i + 1u), d);
        }
    }
}

static inline void put_ring(const mesh_pattern* p, mesh_unit u, uint base, uint lid, global uint* to) {
    bool alone = u.side >= 0;
    for (int s = 0; s < 4; ++s) {
        bool here = (alone ? s == u.side : u.side == -2) && !(s == 2 && mesh_is_triangle(p));
        if (here) {
            put_side(p, s, alone, base, lid, to);
            to += 3ul * (p->side[s] + mesh_beside(p, s));
        }
    }
    if (alone) return;
    uint inner = u.side == -2 ? base + mesh_loop(p) : base;
    if (mesh_is_triangle(p)) {
        put_triangle_rows(p, u.first_row, u.end_row, inner, lid, to);
    } else {
        uint cells = mesh_inner_cells(p);
        put_cells(cells, cells * (u.end_row - u.first_row), p->turned, inner, lid, to);
    }
}

// The work-item's share of a unit whose first vertex has number `base`.
static inline void put_unit(const mesh_pattern* p, mesh_unit u, uint base, uint lid, global uint* to) {
    if (mesh_has_ring(p)) put_ring(p, u, base, lid, to);
    if (p->form == MESH_RIBBON_U) put_ribbon(p, 0, 2, 3, 1, base, lid, to);
    if (p->form == MESH_RIBBON_V) put_ribbon(p, 3, 1, 0, 2, base, lid, to);
    if (p->form == MESH_TRIANGLE_GRID) put_grid(p, base, lid, to);
    if (p->form == MESH_FAN_0) put_fan(p, 0, p->side[0] + p->side[1], base, lid, to);
    if (p->form == MESH_FAN_1) put_fan(p, 1, 0u, base, lid, to);
    if (p->form == MESH_FAN_3) put_fan(p, 3, p->side[0], base, lid, to);
}

// The last patch before which there are no more than `unit` units: the one that has it.
static inline uint patch_of_unit(global const mesh_offset* offsets, uint patches, ulong unit) {
    uint least = 0u, most = patches - 1u;
    while (least < most) {
        uint middle = most - (most - least) / 2u;
        if (offsets[middle].units <= unit)
            least = middle;
        else
            most = middle - 1u;
    }
    return least;
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void mesh_indices(mesh_piece piece, global const mesh_offset* offsets,
                                                                            global const mesh_pattern* patterns, global uint* indices) {
    uint lid = (uint)get_local_id(0);
    ulong step = (ulong)get_num_groups(0) * MESH_INDEX_UNITS;
    for (ulong run = (ulong)get_group_id(0) * MESH_INDEX_UNITS; run < piece.units; run += step) {
        ulong unit = piece.first_unit + run, end = piece.first_unit + min(run + MESH_INDEX_UNITS, piece.units);
        for (uint patch = patch_of_unit(offsets, piece.patches, unit); unit < end; ++patch) {
            mesh_pattern p = patterns[patch];
            mesh_offset here = offsets[patch];
            uint parts = mesh_units(&p);
            for (uint part = (uint)(unit - here.units); part < parts && unit < end; ++part, ++unit) {
                mesh_offset before = mesh_units_before(&p, part);
                ulong vertex = here.vertices + before.vertices - piece.first_vertex;
                ulong triangle = here.triangles + before.triangles - piece.first_triangle;
                put_unit(&p, mesh_unit_of(&p, part), (uint)vertex, lid, indices + 3ul * triangle);
            }
        }
    }
}
