// First stage of a tessellation: how finely each patch and each of its sides is cut.
// mesh_factors
// In:  frame (patch counts), view, points (nets and records' curves in world space, place.cl), patches, records, turned.
// Out: patterns: one a patch.
// A work-item takes LANES patches in turn, all of one kind.
#include "core/frame_shared.h"
#include "mesh/factor_cull.clh"
#include "mesh/triangle_factors.clh"

typedef struct {
    factor_span span;  // of all control points, world space
    vfloat tolerance;  // of the patch, world units
    vint outside;      // whether the view is elsewhere
} patch_measure;

// Control points alone: curves of records that draw the patch's sides reach on in `reach` later.
static inline patch_measure patch_measure_of(const mesh_view* view, const factor_net* net, int kind, factor_reach* reach) {
    patch_measure measure;
    factor_span eye;
    for (int k = 0; k < factor_points(kind); ++k) {
        vpoint p = factor_true_point(net, kind == KIND_RATIONAL, k);
        measure.span = k == 0 ? factor_span_of(p) : factor_span_with(measure.span, p);
        if (!view->view) continue;
        vpoint q = factor_eye(view, p);
        eye = k == 0 ? factor_span_of(q) : factor_span_with(eye, q);
        factor_reach_to(view, reach, p, q);
    }
    measure.outside = (vint)(0);
    measure.tolerance = factor_tolerance(view, view->view ? factor_depth(view, eye) : (vfloat)(1.0f));
    if (view->view && view->cull) measure.outside = factor_outside(view, reach);
    return measure;
}

static inline vint side_degenerate(global const placed_patch* patches, factor_run run, int side) {
    int flags[LANES];
    for (int lane = 0; lane < LANES; ++lane) flags[lane] = patches[factor_patch(run, lane)].flags & (SIDE_DEGENERATE << side) ? -1 : 0;
    return load_lanes(flags);
}

// Rates of a side: `own` is of the patch's own border, `side` of what draws it.
static inline vint side_segments(const frame_params* frame, const mesh_view* view, global const float* points,
                                 global const placed_patch* patches, global const edge_info* records, factor_run run, const factor_net* net,
                                 int s, edge_rate* own, edge_rate* side, factor_reach* reach) {
    edge_curve curve = edge_of_net(net, run.kind, s);
    *own = *side = edge_rate_of(view, &curve);
    vint segments = vto_int(fmin(own->segments, (vfloat)(16777216.0f)));
    edge_records drawn = edge_records_of(frame, points, patches, records, run, s, curve);
    if (vany(drawn.here)) {
        *side = edge_rate_of(view, &drawn.curve);
        segments = vselect(segments, edge_part(side->segments, drawn.level, drawn.cuts), drawn.here);
        for (int k = 0; k < 4 && view->view; ++k) {
            vpoint p = edge_true_point(&drawn.curve, k);
            factor_reach_to(view, reach, p, factor_eye(view, p));
        }
    }
    return vselect(segments, (vint)(0), side_degenerate(patches, run, s));
}

static inline void store_patterns(const factor_pattern* p, factor_run run, global mesh_pattern* patterns) {
    int words[12 * LANES];
    const vint values[12] = {p->form,    p->side[0], p->side[1], p->side[2], p->side[3], p->cells_u,
                             p->cells_v, p->low_u,   p->high_u,  p->low_v,   p->high_v,  p->refused};
    for (int k = 0; k < 12; ++k) store_lanes(values[k], words + k * LANES);
    for (int lane = 0; lane < LANES && run.first + (uint)lane <= run.last; ++lane) {
        global uint* to = (global uint*)(patterns + run.first + (uint)lane);
        for (int k = 0; k < 12; ++k) to[k] = (uint)words[k * LANES + lane];
    }
}

// `turned`: a bit a placed patch of the scene, 32 a word (orientation.h).
static inline void store_turned(const mesh_view* view, factor_run run, global const uint* turned, global mesh_pattern* patterns) {
    for (int lane = 0; lane < LANES && run.first + (uint)lane <= run.last; ++lane) {
        uint placed = view->first_patch + run.first + (uint)lane;
        patterns[run.first + (uint)lane].turned = (turned[placed / 32u] >> (placed % 32u)) & 1u;
    }
}

static inline bool run_is_recorded(global const placed_patch* patches, factor_run run) {
    uint flags = 0u;
    for (int lane = 0; lane < LANES; ++lane) flags |= patches[factor_patch(run, lane)].flags;
    return flags >= SIDE_RECORDED;
}

static inline void store_nothing(factor_run run, global mesh_pattern* patterns) {
    const mesh_pattern nothing = {.form = MESH_NOTHING};
    for (int lane = 0; lane < LANES && run.first + (uint)lane <= run.last; ++lane) patterns[run.first + (uint)lane] = nothing;
}

// What lies outside the view takes no part, and asks for nothing that could be refused.
static inline void keep_seen(factor_pattern* p, vint outside) {
    vint seen = ~(outside | veq(p->form, (vint)(MESH_NOTHING)));
    p->form &= seen;
    for (int s = 0; s < 4; ++s) p->side[s] &= seen;
    p->cells_u &= seen;
    p->cells_v &= seen;
    p->low_u &= seen;
    p->high_u &= seen;
    p->low_v &= seen;
    p->high_v &= seen;
    p->refused &= ~outside;
}

// A call, for PoCL keeps what a kernel's own body has on its stack once for every work-item of the group: megabytes of it.
static __attribute__((noinline)) void factors_of_run(const frame_params* frame, const mesh_view* view, global const float* points,
                                                     global const placed_patch* patches, global const edge_info* records,
                                                     global const uint* turned, global mesh_pattern* patterns, factor_run run) {
    factor_net net;
    factor_gather(frame, points, run, &net);
    factor_pattern pattern;
    edge_rate own[4], sides[4];
    factor_reach reach = factor_reach_of_nothing();
    patch_measure measure = patch_measure_of(view, &net, run.kind, &reach);
    // Curves of records may reach into the view where the net does not.
    if (!vany(~measure.outside) && !run_is_recorded(patches, run)) {
        store_nothing(run, patterns);
        return;
    }
    vint most = (vint)((int)MESH_RATE_MOST);
    pattern.refused = (vint)(0);
    for (int s = 0; s < 4; ++s) {
        pattern.side[s] = (vint)(0);
        vint segments = side_segments(frame, view, points, patches, records, run, &net, s, own + s, sides + s, &reach);
        if (run.kind == KIND_PN && s == 2) continue;
        pattern.refused |= vlt(most, segments) & 1;
        pattern.side[s] = min(segments, most);
    }
    if (view->view && view->cull) measure.outside = factor_outside(view, &reach);
    vpoint low = measure.span.low, high = measure.span.high;
    vfloat size = factor_length(high.x - low.x, high.y - low.y, high.z - low.z);
    if (run.kind == KIND_PN) {
        triangle_bounds bounds;
        triangle_bounds_of(&net, measure.tolerance, &bounds);
        triangle_pattern(&bounds, own, sides, measure.tolerance, size, &pattern);
    } else {
        second_bounds bounds;
        second_settle_blends(&net, run.kind);
        second_bounds_of(&net, run.kind, measure.span, measure.tolerance, &bounds);
        quad_pattern(&bounds, own, sides, measure.tolerance, size, &pattern);
    }
    keep_seen(&pattern, measure.outside);
    store_patterns(&pattern, run, patterns);
    store_turned(view, run, turned, patterns);
}

kernel void mesh_factors(frame_params frame, mesh_view view, global const float* points, global const placed_patch* patches,
                         global const edge_info* records, global const uint* turned, global mesh_pattern* patterns) {
    factor_run run;
    for (uint block = (uint)get_global_id(0); factor_run_at(&frame, block, &run); block += (uint)get_global_size(0))
        factors_of_run(&frame, &view, points, patches, records, turned, patterns, run);
}
