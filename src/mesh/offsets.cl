// Second stage of a tessellation: what each patch's vertices and triangles come to, and where they go, by an exclusive scan.
// In:     patterns: one a patch.
// Out:    offsets: what lies before each patch, and behind the last all of it; totals.
// Passes: mesh_sums     patterns -> sums (of each block of MESH_SCAN_BLOCK patches)
//         mesh_scan     sums -> their exclusive sums; totals; the last offset. One group
//         mesh_offsets  patterns, sums -> offsets
// A work-item takes a run of a block; the result is the same whatever the shape of the device.
#include "device/lanes.clh"
#include "mesh/pattern.clh"

static inline mesh_totals no_totals(uint patches) {
    mesh_totals none = {{0u, 0u, 0u}, 0u, 0u, 0u, patches};
    return none;
}

static inline void add_offset(mesh_offset* sum, mesh_offset more) {
    sum->units += more.units;
    sum->vertices += more.vertices;
    sum->triangles += more.triangles;
}

static inline void add_totals(mesh_totals* sum, mesh_totals more) {
    add_offset(&sum->sum, more.sum);
    sum->distinct += more.distinct;
    sum->nothing += more.nothing;
    sum->refused += more.refused;
    sum->first_refused = min(sum->first_refused, more.first_refused);
}

static inline void add_pattern(mesh_totals* sum, mesh_pattern p, uint patch_index) {
    add_offset(&sum->sum, mesh_units_before(&p, mesh_units(&p)));
    sum->distinct += mesh_vertex_count(&p);
    sum->nothing += p.form == MESH_NOTHING ? 1u : 0u;
    sum->refused += p.refused;
    if (p.refused) sum->first_refused = min(sum->first_refused, (ulong)patch_index);
}

// The work-item's run of a block.
typedef struct {
    uint begin;
    uint end;
} patch_run;

static inline patch_run run_of_block(uint block, uint lid, uint patches) {
    uint run = (MESH_SCAN_BLOCK + GROUP - 1u) / GROUP;
    uint block_begin = block * MESH_SCAN_BLOCK;
    uint block_end = block_begin + min(MESH_SCAN_BLOCK, patches - block_begin);
    patch_run own;
    own.begin = min(block_begin + lid * run, block_end);
    own.end = min(own.begin + run, block_end);
    return own;
}

static inline uint scan_blocks(uint patches) { return patches / MESH_SCAN_BLOCK + (patches % MESH_SCAN_BLOCK ? 1u : 0u); }

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void mesh_sums(uint patches, global const mesh_pattern* patterns,
                                                                         global mesh_totals* sums) {
    local mesh_totals partial[GROUP];
    uint lid = (uint)get_local_id(0);
    for (uint block = (uint)get_group_id(0); block < scan_blocks(patches); block += (uint)get_num_groups(0)) {
        patch_run own = run_of_block(block, lid, patches);
        mesh_totals sum = no_totals(patches);
        for (uint i = own.begin; i < own.end; ++i) add_pattern(&sum, patterns[i], i);
        partial[lid] = sum;
        barrier(CLK_LOCAL_MEM_FENCE);
        if (lid == 0u) {
            for (uint k = 1u; k < GROUP; ++k) add_totals(&sum, partial[k]);
            sums[block] = sum;
        }
        barrier(CLK_LOCAL_MEM_FENCE);
    }
}

// One group: each work-item adds up a run of blocks, then turns the run into exclusive sums.
kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void mesh_scan(uint patches, global mesh_totals* sums,
                                                                         global mesh_offset* offsets, global mesh_totals* totals) {
    local mesh_totals partial[GROUP];
    uint lid = (uint)get_local_id(0);
    uint blocks = scan_blocks(patches);
    uint run = (blocks + GROUP - 1u) / GROUP;
    uint begin = min(lid * run, blocks);
    uint end = min(begin + run, blocks);
    mesh_totals sum = no_totals(patches);
    for (uint i = begin; i < end; ++i) add_totals(&sum, sums[i]);
    partial[lid] = sum;
    barrier(CLK_LOCAL_MEM_FENCE);
    mesh_totals before = no_totals(patches);
    for (uint k = 0u; k < lid; ++k) add_totals(&before, partial[k]);
    for (uint i = begin; i < end; ++i) {
        mesh_totals here = sums[i];
        sums[i] = before;
        add_totals(&before, here);
    }
    // The last work-item's sum is the total: those behind the last block hold it too.
    if (lid == GROUP - 1u) {
        *totals = before;
        offsets[patches] = before.sum;
    }
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void mesh_offsets(uint patches, global const mesh_pattern* patterns,
                                                                            global const mesh_totals* sums, global mesh_offset* offsets) {
    local mesh_offset partial[GROUP];
    uint lid = (uint)get_local_id(0);
    for (uint block = (uint)get_group_id(0); block < scan_blocks(patches); block += (uint)get_num_groups(0)) {
        patch_run own = run_of_block(block, lid, patches);
        // The run's own sums first, which what lies before it then raises.
        mesh_offset sum = {0u, 0u, 0u};
        for (uint i = own.begin; i < own.end; ++i) {
            mesh_pattern p = patterns[i];
            offsets[i] = sum;
            add_offset(&sum, mesh_units_before(&p, mesh_units(&p)));
        }
        partial[lid] = sum;
        barrier(CLK_LOCAL_MEM_FENCE);
        mesh_offset before = sums[block].sum;
        for (uint k = 0u; k < lid; ++k) add_offset(&before, partial[k]);
        for (uint i = own.begin; i < own.end; ++i) {
            mesh_offset here = offsets[i];
            add_offset(&here, before);
            offsets[i] = here;
        }
        barrier(CLK_LOCAL_MEM_FENCE);
    }
}
