// local_book: ends a launch of the local method (local.clh). One group: what the groups left and counted -> ranks, the split stage's
// counts.
#include "split/local.clh"

// What the groups did in a launch.
typedef struct {
    chunk_sum sum;
    uint processed;
    uint peak;  // of all stacks, each when it was fullest
} launch_sum;

static inline void add_group(launch_sum* launch, global const local_group* group) {
    add_sum(&launch->sum, group->sum);
    launch->processed += group->processed;
    launch->peak += group->peak;
}

// Entry k of the ranks: level by level, a group each.
static inline uint count_left(uint k, global const local_group* groups, local_limits shape) {
    global const uint* starts = groups[k % shape.groups].starts + k / shape.groups;
    return starts[1] - starts[0];
}

// Writes ranks [begin, end), and begins with `rank`.
static inline void write_ranks(uint begin, uint end, uint rank, global const local_group* groups, local_limits shape,
                               global local_rank* ranks) {
    for (uint k = begin; k < end; ++k) {
        uint g = k % shape.groups;
        ranks[k].first = rank;
        ranks[k].shift = g * stack_room(shape) + groups[g].starts[k / shape.groups] - rank;
        rank += count_left(k, groups, shape);
    }
}

static inline void book_launch(launch_sum launch, uint left, global split_state* state, global local_run* run) {
    split_state next = *state;
    next.stack_peak = max(next.stack_peak, launch.peak);
    next.stack_count = left;
    add_counts(&next, launch.processed, run->fed, launch.sum);
    *state = next;
    run->turn = 1u - run->turn;
    run->fed = 0u;
    run->diced = 0u;
}

kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void local_book(split_limits limits, local_limits shape,
                                                                          global split_state* state, global local_run* run,
                                                                          global const local_group* groups, global local_rank* ranks) {
    local uint counts[GROUP];
    local launch_sum partial[GROUP];
    uint lid = (uint)get_local_id(0);
    // As the launch had them: nothing that decides them has changed.
    uint rounds = plan_rounds(state, limits, shape);
    uint entries = rounds > 0u ? LOCAL_LEVELS * shape.groups : 0u;
    uint length = (entries + GROUP - 1u) / GROUP;
    uint begin = min(lid * length, entries), end = min(begin + length, entries);
    uint count = 0u;
    for (uint k = begin; k < end; ++k) count += count_left(k, groups, shape);
    counts[lid] = count;
    launch_sum mine = {no_ranges(), 0u, 0u};
    for (uint g = lid; g < shape.groups; g += GROUP) add_group(&mine, groups + g);
    partial[lid] = mine;
    barrier(CLK_LOCAL_MEM_FENCE);
    uint before = 0u;
    for (uint k = 0; k < lid; ++k) before += counts[k];
    write_ranks(begin, end, before, groups, shape, ranks);
    if (lid != GROUP - 1u || rounds == 0u) return;
    launch_sum all = {no_ranges(), 0u, 0u};
    for (uint k = 0; k < GROUP; ++k) {
        add_sum(&all.sum, partial[k].sum);
        all.processed += partial[k].processed;
        all.peak += partial[k].peak;
    }
    book_launch(all, before + count, state, run);
}
