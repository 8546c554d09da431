// One iteration of bound and split in the watertight mode. Queues, counters and passes are those of split.cl, with ranges of 44 bytes:
//   quad_bound    stack, patches -> batch (edges measured, grids sized), actions, cuts (rates of a split's new edges), chunk_sums
//   split_scan    (split.cl)
//   quad_scatter  batch, actions, cuts, chunk_sums -> stack, ready
// A work-group takes QUAD_GROUP ranges at a time through phases in local memory: points of hulls and samples of edges are spread over
// lanes and work-items, decisions are a work-item a range.
// Bounds: QUAD_GROUP * QUAD_SAMPLES places for points, 20 bytes each.
#include "device/lanes.clh"
#include "split/plan.clh"
#include "split/quad_measure.clh"

#define QUAD_PLACES (QUAD_GROUP * QUAD_SAMPLES)

// The group's ranges, and their points' places: u, v, then pixels x, y, then lengths to the next place (along) and the fourth
// (across). A vector may read a few places behind the last.
typedef struct {
    local quad_range* quad;
    local int* action;  // QUAD_*
    local int* u;
    local int* v;
    local float* x;
    local float* y;
    local float* along;
    local float* across;
    local int* outside;  // of hull points
} quad_work;

typedef struct {
    global const float* eye_points;
    global const float* dicing_points;  // the same in the dicing camera's space
    global const placed_patch* patches;
    global const edge_info* records;
} quad_source;

static inline patch_ref source_patch(const frame_params* frame, quad_source source, uint patch_index) {
    return patch_at(frame, source.eye_points, source.patches, source.records, patch_index);
}

static inline patch_ref dicing_patch(const frame_params* frame, quad_source source, uint patch_index) {
    return patch_at(frame, source.dicing_points, source.patches, source.records, patch_index);
}

// A patch as a range: its square, or its triangle with the corner C twice.
static inline quad_range whole_patch(const frame_params* frame, uint patch_index) {
    bool triangle = patch_kind(frame, patch_index) == KIND_PN;
    quad_range quad = {patch_index, 0u, 0u, {0u, UNIT, triangle ? 0u : UNIT, 0u}, {0u, 0u, UNIT, UNIT}};
    for (int k = 0; k < 4; ++k) quad.rates = quad_with_byte(quad.rates, k, RATE_UNKNOWN);
    return quad;
}

static inline void fetch_quads(const frame_params* frame, split_plan plan, global const split_state* state, global const quad_range* stack,
                               uint first, uint count, quad_work work) {
    for (uint k = (uint)get_local_id(0); k < count; k += GROUP) {
        uint i = first + k;
        work.quad[k] = i < plan.fresh ? whole_patch(frame, state->next_input + i) : stack[plan.stack_base + (i - plan.fresh)];
    }
}

static inline void place_hulls(const frame_params* frame, quad_source source, uint count, quad_work work) {
    for (int i = (int)get_local_id(0) * LANES; i < (int)count * QUAD_HULL; i += GROUP * LANES) {
        local const quad_range* quad = work.quad + i / QUAD_HULL;
        patch_ref patch = source_patch(frame, source, quad->patch_index);
        hull_lanes hull = quad_hull(patch, quad, i % QUAD_HULL);
        store_lanes(hull_outside(frame, hull, hull_rounding(patch)), work.outside + i);
        if (frame->dicing_apart) hull = quad_hull(dicing_patch(frame, source, quad->patch_index), quad, i % QUAD_HULL);
        vfloat scale = dicing_scale(frame, hull.x, hull.y, hull.z, hull.w);
        store_lanes(hull.x * scale, work.x + i);
        store_lanes(hull.y * scale, work.y + i);
    }
}

static inline vfloat place_distance(quad_work work, int i, int step) {
    vfloat dx = load_lanes(work.x + i + step) - load_lanes(work.x + i);
    vfloat dy = load_lanes(work.y + i + step) - load_lanes(work.y + i);
    return sqrt(dx * dx + dy * dy);
}

static inline void measure_places(int places, quad_work work, bool both) {
    for (int i = (int)get_local_id(0) * LANES; i < places; i += GROUP * LANES) {
        store_lanes(place_distance(work, i, 1), work.along + i);
        if (both) store_lanes(place_distance(work, i, 4), work.across + i);
    }
}

// QUAD_CULL where a range lies wholly beyond one plane, by its hull and by what else draws its borders.
static inline int judge_hull(const frame_params* frame, quad_source source, local const quad_range* quad, local const int* outside) {
    int out = outside[0];
    for (int k = 1; k < QUAD_HULL; ++k) out &= outside[k];
    if (out == 0) return QUAD_DICE;
    patch_ref patch = source_patch(frame, source, quad->patch_index);
    if (patch.flags >= SIDE_RECORDED) out &= records_outside(frame, patch, quad, hull_rounding(patch));
    return out != 0 ? QUAD_CULL : QUAD_DICE;
}

static inline void note_samples(quad_edge edge, int k, quad_work work, int base) {
    quad_edge canonical = canonical_edge(edge);
    for (int s = 0; s < EDGE_SAMPLES; ++s) {
        quad_point p = edge_sample(canonical, s);
        work.u[base + EDGE_SAMPLES * k + s] = p.u;
        work.v[base + EDGE_SAMPLES * k + s] = p.v;
    }
}

// Gives the places left over a point of the patch, lest they hold any.
static inline void fill_samples(int used, quad_work work, int base) {
    for (int s = used; s < QUAD_SAMPLES; ++s) {
        work.u[base + s] = work.u[base];
        work.v[base + s] = work.v[base];
    }
}

// Places the samples of ranges that `action` marks: their points in pixels.
static inline void place_samples(const frame_params* frame, quad_source source, uint count, quad_work work, int least_action) {
    for (int i = (int)get_local_id(0) * LANES; i < (int)count * QUAD_SAMPLES; i += GROUP * LANES) {
        if (work.action[i / QUAD_SAMPLES] < least_action) continue;
        local const quad_range* quad = work.quad + i / QUAD_SAMPLES;
        vpoint p = patch_vertex(dicing_patch(frame, source, quad->patch_index), load_lanes(work.u + i), load_lanes(work.v + i));
        vfloat scale = dicing_scale(frame, p.x, p.y, p.z, (vfloat)(1.0f));
        store_lanes(p.x * scale, work.x + i);
        store_lanes(p.y * scale, work.y + i);
    }
}

// The rate of an edge whose samples begin at a place.
static inline uint sampled_rate(const frame_params* frame, patch_ref patch, quad_edge edge, quad_work work, int place) {
    float parts[4];
    for (int k = 0; k < 4; ++k) parts[k] = work.along[place + k];
    float dx = work.x[place + 2] - 0.5f * (work.x[place] + work.x[place + 4]);
    float dy = work.y[place + 2] - 0.5f * (work.y[place] + work.y[place + 4]);
    return edge_rate(frame, patch, edge, parts, sqrt(dx * dx + dy * dy));
}

// Ranges that have just been fed and may be seen: notes the samples of their edges.
static inline void note_fresh(uint count, quad_work work) {
    for (uint k = (uint)get_local_id(0); k < count; k += GROUP) {
        if (work.action[k] == QUAD_CULL) continue;
        for (int e = 0; e < 4; ++e) note_samples(quad_own_edge(work.quad + k, e), e, work, (int)k * QUAD_SAMPLES);
        fill_samples(4 * EDGE_SAMPLES, work, (int)k * QUAD_SAMPLES);
    }
}

// Gives them their edges' rates.
static inline void rate_fresh(const frame_params* frame, quad_source source, uint count, quad_work work) {
    for (uint k = (uint)get_local_id(0); k < count; k += GROUP) {
        if (work.action[k] == QUAD_CULL) continue;
        patch_ref patch = dicing_patch(frame, source, work.quad[k].patch_index);
        uint rates = 0u;
        for (int e = 0; e < 4; ++e) {
            int place = (int)k * QUAD_SAMPLES + EDGE_SAMPLES * e;
            rates = quad_with_byte(rates, e, sampled_rate(frame, patch, quad_own_edge(work.quad + k, e), work, place));
        }
        work.quad[k].rates = rates;
    }
}

static inline void note_cut(local const quad_range* quad, int direction, quad_work work, int base) {
    quad_edge edges[5];
    quad_cut_edges(quad, direction, edges);
    for (int e = 0; e < 5; ++e) note_samples(edges[e], e, work, base);
    fill_samples(5 * EDGE_SAMPLES, work, base);
}

static inline quad_cut measured_cut(const frame_params* frame, patch_ref patch, local const quad_range* quad, int direction, quad_work work,
                                    int place) {
    quad_cut cut = {0u, 0u};
    quad_edge edges[5];
    quad_cut_edges(quad, direction, edges);
    for (int e = 0; e < 5; ++e) {
        uint rate = quad_cut_measures(quad, direction, e) ? sampled_rate(frame, patch, edges[e], work, place + EDGE_SAMPLES * e)
                                                          : quad_cut_share(quad, direction, e);
        if (e < 4)
            cut.halves = quad_with_byte(cut.halves, e, rate);
        else
            cut.inner = rate;
    }
    return cut;
}

static inline void add_quad(chunk_sum* sum, uint action, uint sizes) {
    sum->splits += action >= QUAD_SPLIT ? 1u : 0u;
    sum->dices += action == QUAD_DICE ? 1u : 0u;
    sum->micropolygons += action == QUAD_DICE ? 1u << (quad_byte(sizes, 2) + quad_byte(sizes, 3)) : 0u;
    // Each cut halves a range's share of its patch.
    uint cuts = quad_byte(sizes, 0) + quad_byte(sizes, 1);
    sum->area += action < QUAD_SPLIT ? as_float((127u - cuts) << 23) : 0.0f;
}

// Decides the ranges, and writes all but the cuts.
static inline void decide_quads(const frame_params* frame, uint first, uint count, local const quad_interior* interiors, quad_work work,
                                global quad_range* batch, global uchar* actions, chunk_sum* sum) {
    for (uint k = (uint)get_local_id(0); k < count; k += GROUP) {
        local quad_range* quad = work.quad + k;
        int action = work.action[k];
        if (action != QUAD_CULL) action = quad_decide(quad, interiors[k], frame->grid_bits, frame->level_most);
        quad_range kept = *quad;
        if (action == QUAD_DICE) kept = quad_diced(quad, interiors[k], frame->grid_bits);
        work.action[k] = action;
        batch[first + k] = kept;
        actions[first + k] = (uchar)action;
        add_quad(sum, (uint)action, kept.sizes);
        if (action >= QUAD_SPLIT) note_cut(quad, action - QUAD_SPLIT, work, (int)k * QUAD_SAMPLES);
    }
}

// Takes `count` ranges of the iteration from `first` on through all phases.
static inline void bound_quads(const frame_params* frame, split_plan plan, global const split_state* state, quad_source source,
                               global const quad_range* stack, uint first, uint count, quad_work work, local quad_interior* interiors,
                               global quad_range* batch, global uchar* actions, global quad_cut* cuts, chunk_sum* sum) {
    uint lid = (uint)get_local_id(0);
    fetch_quads(frame, plan, state, stack, first, count, work);
    barrier(CLK_LOCAL_MEM_FENCE);
    place_hulls(frame, source, count, work);
    barrier(CLK_LOCAL_MEM_FENCE);
    measure_places((int)count * QUAD_HULL, work, true);
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint k = lid; k < count; k += GROUP) {
        work.action[k] = judge_hull(frame, source, work.quad + k, work.outside + k * QUAD_HULL);
        interiors[k] =
            quad_interior_of(frame, patch_kind(frame, work.quad[k].patch_index), work.along + k * QUAD_HULL, work.across + k * QUAD_HULL);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    // Barriers stand in no branch, lest PoCL's groups of many work-items go wrong: mostly nothing is fresh here.
    uint fresh = first < plan.fresh ? min(count, plan.fresh - first) : 0u;
    note_fresh(fresh, work);
    barrier(CLK_LOCAL_MEM_FENCE);
    place_samples(frame, source, fresh, work, QUAD_DICE);
    barrier(CLK_LOCAL_MEM_FENCE);
    measure_places((int)fresh * QUAD_SAMPLES, work, false);
    barrier(CLK_LOCAL_MEM_FENCE);
    rate_fresh(frame, source, fresh, work);
    barrier(CLK_LOCAL_MEM_FENCE);
    decide_quads(frame, first, count, interiors, work, batch, actions, sum);
    barrier(CLK_LOCAL_MEM_FENCE);
    place_samples(frame, source, count, work, QUAD_SPLIT);
    barrier(CLK_LOCAL_MEM_FENCE);
    measure_places((int)count * QUAD_SAMPLES, work, false);
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint k = lid; k < count; k += GROUP) {
        if (work.action[k] < QUAD_SPLIT) continue;
        patch_ref patch = dicing_patch(frame, source, work.quad[k].patch_index);
        cuts[first + k] = measured_cut(frame, patch, work.quad + k, work.action[k] - QUAD_SPLIT, work, (int)k * QUAD_SAMPLES);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void quad_bound(
    frame_params frame, split_limits limits, global const float* eye_points, global const float* dicing_points,
    global const placed_patch* patches, global const edge_info* records, global const quad_range* stack, global quad_range* batch,
    global uchar* actions, global quad_cut* cuts, global chunk_sum* chunk_sums, global const split_state* state) {
    local quad_range quads[QUAD_GROUP];
    local quad_interior interiors[QUAD_GROUP];
    local int action[QUAD_GROUP], outside[QUAD_GROUP * QUAD_HULL], u[QUAD_PLACES], v[QUAD_PLACES];
    local float x[QUAD_PLACES + 2 * LANES + 4], y[QUAD_PLACES + 2 * LANES + 4], along[QUAD_PLACES], across[QUAD_GROUP * QUAD_HULL];
    local chunk_sum partial[GROUP];
    quad_work work = {quads, action, u, v, x, y, along, across, outside};
    quad_source source = {eye_points, dicing_points, patches, records};
    uint lid = (uint)get_local_id(0);
    split_plan plan = plan_iteration(&frame, state, limits);
    for (uint chunk = (uint)get_group_id(0); chunk * SPLIT_CHUNK < plan.count; chunk += (uint)get_num_groups(0)) {
        chunk_sum sum = no_ranges();
        uint begin = chunk * SPLIT_CHUNK;
        uint end = min(begin + SPLIT_CHUNK, plan.count);
        for (uint i = begin; i < end; i += QUAD_GROUP) {
            bound_quads(&frame, plan, state, source, stack, i, min((uint)QUAD_GROUP, end - i), work, interiors, batch, actions, cuts, &sum);
        }
        partial[lid] = sum;
        barrier(CLK_LOCAL_MEM_FENCE);
        if (lid == 0) {
            for (uint k = 1; k < GROUP; ++k) add_sum(&sum, partial[k]);
            chunk_sums[chunk] = sum;
        }
        barrier(CLK_LOCAL_MEM_FENCE);
    }
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void quad_scatter(global const quad_range* batch, global const uchar* actions,
                                                                            global const quad_cut* cuts, global const chunk_sum* chunk_sums,
                                                                            global const split_state* state, global quad_range* stack,
                                                                            global quad_range* ready) {
    local chunk_sum partial[GROUP];
    local quad_range parents[GROUP];
    uint lid = (uint)get_local_id(0);
    uint count = state->batch_count;
    for (uint chunk = (uint)get_group_id(0); chunk * SPLIT_CHUNK < count; chunk += (uint)get_num_groups(0)) {
        uint run = SPLIT_CHUNK / GROUP;
        uint begin = min(chunk * SPLIT_CHUNK + lid * run, count);
        uint end = min(begin + run, count);
        chunk_sum sum = no_ranges();
        for (uint i = begin; i < end; ++i) add_quad(&sum, actions[i], 0u);
        partial[lid] = sum;
        barrier(CLK_LOCAL_MEM_FENCE);
        chunk_sum before = chunk_sums[chunk];
        for (uint k = 0; k < lid; ++k) add_sum(&before, partial[k]);
        uint child_slot = state->stack_base + 2u * before.splits;
        uint ready_slot = state->ready_base + before.dices;
        for (uint i = begin; i < end; ++i) {
            int action = actions[i];
            if (action >= QUAD_SPLIT) {
                parents[lid] = batch[i];
                for (int k = 0; k < 2; ++k) stack[child_slot + k] = quad_child(parents + lid, action - QUAD_SPLIT, cuts[i], k);
                child_slot += 2u;
            } else if (action == QUAD_DICE) {
                ready[ready_slot++] = batch[i];
            }
        }
        barrier(CLK_LOCAL_MEM_FENCE);
    }
}
