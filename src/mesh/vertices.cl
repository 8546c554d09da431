// Third stage of a tessellation: the vertices of a run of units, into one buffer.
// In:  offsets (exclusive scan over the patches, piece.patches + 1 of them), patterns, points (world-space nets, by kind, and the records'
//      curves behind them), patches, records, objects. Of `frame` the counts of patches by kind.
// Out: vertices: mesh_vertex, or three floats where piece.positions_only; nothing outside the run's.
// A group a run of units; its work-items share each unit's vertices.
#include "core/frame_shared.h"
#include "mesh/vertex_units.clh"

// The patch that has a unit: the last one before which are no more.
static inline uint mesh_patch_of(global const mesh_offset* offsets, uint patches, ulong unit) {
    uint low = 0u, high = patches;
    while (high - low > 1u) {
        uint middle = low + (high - low) / 2u;
        if (offsets[middle].units <= unit)
            low = middle;
        else
            high = middle;
    }
    return low;
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void mesh_vertices(
    frame_params frame, mesh_piece piece, global const mesh_offset* restrict offsets, global const mesh_pattern* restrict patterns,
    global const float* restrict points, global const placed_patch* restrict patches, global const edge_info* restrict records,
    global const placed_object* restrict objects, global float* restrict vertices) {
    ulong group = get_group_id(0), groups = get_num_groups(0);
    ulong unit = piece.first_unit + piece.units * group / groups, end = piece.first_unit + piece.units * (group + 1u) / groups;
    bool positions_only = piece.positions_only != 0u;
    uint words = positions_only ? 3u : MESH_VERTEX_WORDS;
    uint patch = unit < end ? mesh_patch_of(offsets, piece.patches, unit) : 0u;
    for (; unit < end; ++patch) {
        mesh_offset before = offsets[patch];
        ulong patch_end = min(offsets[patch + 1u].units, end);
        if (unit >= patch_end) continue;
        mesh_pattern pattern = patterns[patch];
        placed_patch placed = patches[patch];
        mesh_source source = mesh_source_of(patch_at(&frame, points, patches, records, patch), &pattern, placed, objects[placed.object].id);
        uint k = (uint)(unit - before.units);
        ulong at = before.vertices + mesh_units_before(&pattern, k).vertices - piece.first_vertex;
        for (; unit < patch_end; ++unit, ++k) {
            mesh_part part = mesh_part_of(&pattern, mesh_unit_of(&pattern, k));
            global float* to = vertices + at * words;
            if (source.quick)
                mesh_quick_unit(&source, &pattern, part, positions_only, to);
            else
                mesh_any_unit(&source, &pattern, part, positions_only, to);
            at += part.outer + part.inner;
        }
    }
}
