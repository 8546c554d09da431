// Runs the local method of the split stage alone, one launch at a time, in either mode, and judges what each launch leaves.
#pragma once

#include "split/local_queues.h"
#include "split/queues.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tessera::splitting {

// What a method finds of a scene.
template <typename Range>
struct LocalFound {
    std::vector<Range> diced;
    std::uint64_t processed = 0;
    std::uint64_t culled = 0;
    std::uint64_t micropolygons = 0;
    std::uint32_t launches = 0;  // with work
    std::uint64_t peak = 0;      // ranges on one group's stack
    std::vector<std::uint64_t> groupRanges;
};

struct LocalRun {
    LocalShape shape;
    std::uint32_t readyCapacity = 0;
    std::uint32_t mostRounds = 1;
    std::uint32_t levels = 0;  // K: the deepest that a range on a stack may lie
};

// One pass over what `rig` has placed.
template <typename Range, typename Rig>
class LocalPass {
public:
    LocalPass(Rig& rig, DiceMode mode, const LocalRun& run)
        : rig_(rig),
          run_(run),
          limits_{run.shape.batch(), run.readyCapacity, run.shape.batch()},
          queues_(rig.session()),
          local_(rig.session()) {
        queues_.setMode(mode);
        queues_.reserve({0, run.readyCapacity, 0}, 0);
        local_.reserve(run.shape, mode);
        queues_.restart();
        local_.restart();
        queues_.enqueueFeed(rig.frame(), rig.patches());
        state_ = queues_.readState();
    }

    // Launches until all is diced, and takes what is ready whenever it is too full.
    [[nodiscard]] LocalFound<Range> findAll() {
        LocalFound<Range> found;
        while (!splitOver(state_) && !::testing::Test::HasFatalFailure()) {
            launch();
            if (isFull()) {
                expectNoLaunch();
                take(found);
            }
        }
        take(found);
        expectNoLaunch();
        found.processed = wide(state_.processed_low, state_.processed_high);
        found.culled = wide(state_.culled_low, state_.culled_high);
        found.micropolygons = wide(state_.micropolygons_low, state_.micropolygons_high);
        found.launches = state_.iterations;
        found.peak = peak_;
        found.groupRanges = local_.groupRanges();
        EXPECT_EQ(wide(state_.diced_low, state_.diced_high), found.diced.size());
        EXPECT_NEAR(static_cast<double>(state_.area_done), rig_.patches().patches, 0.01);
        return found;
    }

private:
    [[nodiscard]] bool isFull() const { return limits_.ready_capacity - state_.ready_count < limits_.batch; }

    void enqueue() {
        local_.enqueueLaunch(rig_.frame(), limits_, rig_.patches(), rig_.patches().eyePoints.cl(), queues_, run_.mostRounds);
        state_ = queues_.readState();
    }

    void launch() {
        const split_state before = state_;
        enqueue();
        ASSERT_EQ(state_.iterations, before.iterations + 1) << "a launch that could work did not";
        ASSERT_LE(state_.next_input, state_.feed_count);
        ASSERT_LE(state_.ready_count, limits_.ready_capacity);
        const std::uint64_t processed = wide(state_.processed_low, state_.processed_high);
        const std::uint64_t diced = wide(state_.diced_low, state_.diced_high), culled = wide(state_.culled_low, state_.culled_high);
        ASSERT_EQ(state_.next_input + 2 * (processed - diced - culled), processed + state_.stack_count) << "ranges were lost or made";
        expectSoundGroups(before);
    }

    // Every stack within its bound in this launch, at each level; and no group did more than twice what waited for each: whatever
    // came to run first.
    void expectSoundGroups(const split_state& before) {
        const std::uint64_t waited = std::uint64_t{before.stack_count} + (before.feed_count - before.next_input);
        const std::uint64_t share = waited / run_.shape.groups;
        std::uint64_t left = 0, did = 0;
        for (const local_group& group : local_.readGroups()) {
            ASSERT_LE(group.peak, (run_.levels + 1) * run_.shape.width);
            for (std::uint32_t level = 0; level < LOCAL_LEVELS; ++level) {
                ASSERT_LE(group.starts[level], group.starts[level + 1]);
                ASSERT_LE(group.starts[level + 1], (level + 1) * run_.shape.width) << "of level " << level << " or less";
            }
            ASSERT_LE(group.processed, std::max(2 * share, share + 2));
            peak_ = std::max<std::uint64_t>(peak_, group.peak);
            left += group.starts[LOCAL_LEVELS];
            did += group.processed;
        }
        ASSERT_EQ(left, state_.stack_count);
        ASSERT_EQ(did, wide(state_.processed_low, state_.processed_high) - wide(before.processed_low, before.processed_high));
    }

    // Where `ready` is too full or nothing is left, a launch must change nothing.
    void expectNoLaunch() {
        const split_state before = state_;
        enqueue();
        EXPECT_EQ(state_.iterations, before.iterations);
        EXPECT_EQ(state_.stack_count, before.stack_count);
        EXPECT_EQ(state_.next_input, before.next_input);
        EXPECT_EQ(state_.ready_count, before.ready_count);
    }

    void take(LocalFound<Range>& found) {
        const std::size_t had = found.diced.size();
        found.diced.resize(had + state_.ready_count);
        if (state_.ready_count > 0)
            rig_.session().timeline.read(queues_.ready(), found.diced.data() + had, state_.ready_count * sizeof(Range));
        state_.ready_count = 0;
        queues_.writeState(state_);
    }

    Rig& rig_;
    LocalRun run_;
    split_limits limits_;
    SplitQueues queues_;
    LocalQueues local_;
    split_state state_{};
    std::uint64_t peak_ = 0;
};

}  // namespace tessera::splitting
