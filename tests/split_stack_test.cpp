// The stack of the split stage under decisions made to do harm: its order, its bound of (K + 1) p, and that nothing is lost.
#include "split_adversary.h"
#include "split_rig.h"

#include "sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace tessera::splitting {
namespace {

using reference::Random;

std::uint32_t below(Random& random, std::uint32_t end) { return static_cast<std::uint32_t>(random.unit() * end); }

template <typename T>
T oneOf(Random& random, const std::vector<T>& values) {
    return values[below(random, static_cast<std::uint32_t>(values.size()))];
}

// When the ready ranges are taken: after every iteration, or only when the device waits for room.
enum class Diner { eager, late };

struct Trial {
    Plan plan;
    std::uint32_t readyRoom = 0;  // at least plan.batch
    Diner diner = Diner::late;

    [[nodiscard]] std::string text() const {
        return "p " + std::to_string(plan.batch) + ", K " + std::to_string(plan.depth) + ", N " + std::to_string(plan.plots.size()) +
               ", seed " + std::to_string(plan.seed) + ", room for " + std::to_string(readyRoom) + " ready";
    }
};

// Every plot alone, and mixtures. A full tree has 2^(K + 1) ranges a patch, so those are for small K.
std::vector<Plot> randomPlots(Random& random, std::size_t patches, int depth) {
    std::vector<Plot> cast{Plot::coin, Plot::burst, Plot::first, Plot::last, Plot::tightest, Plot::cullAll, Plot::diceAll};
    if (depth <= 6) cast.push_back(Plot::everything);
    if (random.unit() < 0.4) cast = {oneOf(random, cast)};
    std::vector<Plot> plots(patches);
    for (Plot& plot : plots) plot = oneOf(random, cast);
    return plots;
}

Trial randomTrial(Random& random, const std::vector<std::uint32_t>& batches) {
    Trial trial;
    const std::uint32_t p = oneOf(random, batches);
    trial.plan.batch = p;
    trial.plan.depth = oneOf<int>(random, {0, 1, 2, 3, 6, 11, 17, 23, 24});
    const std::vector<std::uint32_t> counts{0, 1, p, p + 1, 3 * p, 10 * p, below(random, 10 * p + 1), below(random, 10 * p + 1)};
    trial.plan.plots = randomPlots(random, oneOf(random, counts), trial.plan.depth);
    trial.plan.seed = below(random, 1U << 24U);
    trial.readyRoom = oneOf(random, std::vector<std::uint32_t>{p, p + p / 2, 2 * p, 3 * p});
    trial.diner = random.unit() < 0.5 ? Diner::eager : Diner::late;
    return trial;
}

RenderOptions optionsOf(const Plan& plan) {
    RenderOptions options;
    options.mode = DiceMode::classical;
    options.maxDepth = plan.depth;
    options.batch = plan.batch;
    return options;
}

// What a trial showed, over all iterations.
struct Report {
    StackVerdict verdict;
    std::uint64_t largest = 0;  // stack
    std::uint64_t iterations = 0;
    std::vector<range_t> diced;

    void add(const std::vector<range_t>& stack, const Plan& plan) {
        const StackVerdict now = judge(stack, plan.batch, plan.depth);
        verdict.ordered = verdict.ordered && now.ordered;
        verdict.bounded = verdict.bounded && now.bounded;
        verdict.summed = verdict.summed && now.summed;
        verdict.shallow = verdict.shallow && now.shallow;
        largest = std::max<std::uint64_t>(largest, stack.size());
    }
};

// A frame's sums of areas are floats: exact while a patch's smallest parts of all patches fit 24 bits, else each iteration rounds.
double areaTolerance(const Plan& plan, std::uint64_t iterations) {
    const auto patches = static_cast<double>(plan.plots.size());
    if (patches * std::exp2(plan.depth) <= 0x1p24) return 0.0;
    return static_cast<double>(iterations + plan.batch) * patches * 0x1p-24;
}

// What holds after each iteration whatever the order of the stack: each range is somewhere, once.
void expectConserved(const SplitPass& pass, const std::vector<range_t>& stack, const Trial& trial, std::uint64_t iterations) {
    const split_state& state = pass.state();
    const std::uint64_t splits = pass.processed() - pass.diced() - pass.culled();
    ASSERT_EQ(state.next_input + 2 * splits, pass.processed() + stack.size());
    const double unfed = static_cast<double>(trial.plan.plots.size()) - state.next_input;
    ASSERT_NEAR(state.area_done + areaOf(stack) + unfed, static_cast<double>(trial.plan.plots.size()),
                areaTolerance(trial.plan, iterations));
    ASSERT_LE(state.ready_count, trial.readyRoom);
    ASSERT_LE(state.next_input, trial.plan.plots.size());
}

// One iteration of the trial: it works on at least one range, or finds too little room and changes nothing.
void iterate(SplitPass& pass, const Trial& trial, Report& report) {
    const split_state before = pass.state();
    const std::uint64_t processedBefore = pass.processed();
    const std::uint64_t waited = before.stack_count + (trial.plan.plots.size() - before.next_input);
    pass.step();
    const bool room = trial.readyRoom - before.ready_count >= trial.plan.batch;
    const std::uint64_t worked = pass.processed() - processedBefore;
    ASSERT_EQ(worked, room ? std::min<std::uint64_t>(trial.plan.batch, waited) : 0U);
    if (!room) {
        ASSERT_EQ(pass.state().stack_count, before.stack_count);
        ASSERT_EQ(pass.state().ready_count, before.ready_count);
        ASSERT_EQ(pass.state().next_input, before.next_input);
    }
    if (trial.diner == Diner::late && room) return;
    const std::vector<range_t> ready = pass.takeReady();
    report.diced.insert(report.diced.end(), ready.begin(), ready.end());
}

// Runs the trial to its end. `outgrow`: the stack may pass its bound (of broken kernels), so it is given room before each iteration.
Report run(SplitRig& rig, const Trial& trial, bool outgrow = false) {
    rig.place(sceneOf(trial.plan), Camera{}, optionsOf(trial.plan));
    const Outcome expected = depthFirst(rig.patches().patches, decisionsOf(trial.plan));
    SplitPass pass(rig, {trial.plan.batch, trial.readyRoom, trial.plan.batch}, 2 * std::uint64_t{trial.plan.batch});
    Report report;
    while (!pass.over() && pass.processed() <= expected.processed && !::testing::Test::HasFatalFailure()) {
        if (outgrow) pass.growStack(pass.state().stack_count + 3 * std::uint64_t{trial.plan.batch});
        iterate(pass, trial, report);
        ++report.iterations;
        const std::vector<range_t> stack = pass.stack();
        report.add(stack, trial.plan);
        expectConserved(pass, stack, trial, report.iterations);
    }
    const std::vector<range_t> rest = pass.takeReady();
    report.diced.insert(report.diced.end(), rest.begin(), rest.end());
    EXPECT_TRUE(outgrow || pass.spareUntouched()) << "an iteration wrote behind the stack's bound";
    EXPECT_EQ(pass.processed(), expected.processed);
    EXPECT_EQ(pass.culled(), expected.culled);
    EXPECT_EQ(pass.diced(), expected.diced.size());
    EXPECT_TRUE(same(sorted(report.diced), sorted(expected.diced))) << "ranges were lost, or came twice";
    return report;
}

void expectSound(const Report& report) {
    EXPECT_TRUE(report.verdict.ordered) << "a level fell towards the stack's end";
    EXPECT_TRUE(report.verdict.bounded) << "more than (K + 1) p ranges on the stack: " << report.largest;
    EXPECT_TRUE(report.verdict.summed) << "more than (i + 1) p ranges of some level i or less";
    EXPECT_TRUE(report.verdict.shallow) << "a range was split more than K times";
}

void expectSoundTrials(Shape shape, std::uint64_t seed, int trials, const std::vector<std::uint32_t>& batches) {
    SplitRig rig(adversarialKernels(), shape);
    Random random(seed);
    std::uint64_t iterations = 0;
    for (int k = 0; k < trials && !::testing::Test::HasFailure(); ++k) {
        const Trial trial = randomTrial(random, batches);
        SCOPED_TRACE(trial.text());
        const Report report = run(rig, trial);
        expectSound(report);
        iterations += report.iterations;
    }
    EXPECT_GT(iterations, 1000U);
    ::testing::Test::RecordProperty("iterations", std::to_string(iterations));
}

TEST(SplitStack, OrderAndBoundHoldAfterEveryIterationOfSmallBatches) {
    expectSoundTrials(Shape::native, 1, 300, {1, 2, 3, 5, 8, 13, 16, 17, 64});
}

TEST(SplitStack, OrderAndBoundHoldAfterEveryIterationOfLargeBatches) {
    expectSoundTrials(Shape::native, 2, 60, {255, 256, 257, 1000, 1024, 4000});
}

TEST(SplitStack, OrderAndBoundHoldInTheShapeOfGpus) { expectSoundTrials(Shape::gpu, 3, 50, {1, 3, 64, 100, 256, 1000}); }

// The bound is reached, to the range: no smaller stack would do, and a plan of less would be seen to fail.
TEST(SplitStack, TightestPlotFillsTheStackToItsBound) {
    SplitRig rig(adversarialKernels());
    for (const std::uint32_t p : {1U, 2U, 7U, 256U, 1500U}) {
        for (const int depth : {1, 2, 9, 24}) {
            Trial trial;
            trial.plan = {std::vector<Plot>(2 * p + 1, Plot::tightest), 7, p, depth};
            trial.readyRoom = 2 * p;
            SCOPED_TRACE(trial.text());
            const Report report = run(rig, trial);
            expectSound(report);
            EXPECT_EQ(report.largest, (static_cast<std::uint64_t>(depth) + 1) * p);
        }
    }
}

// Range for range: what the stack and the ready ranges hold, and in which order.
TEST(SplitStack, EachIterationIsThatOfTheAlgorithmOnPaper) {
    SplitRig rig(adversarialKernels());
    Random random(4);
    for (int k = 0; k < 30; ++k) {
        Trial trial = randomTrial(random, {1, 2, 3, 16, 33, 256, 700});
        SCOPED_TRACE(trial.text());
        rig.place(sceneOf(trial.plan), Camera{}, optionsOf(trial.plan));
        SplitPass pass(rig, {trial.plan.batch, trial.plan.batch, trial.plan.batch}, 0);
        BoundedModel model(rig.patches().patches, trial.plan.batch, decisionsOf(trial.plan));
        while (!model.over()) {
            pass.step();
            const std::vector<range_t> ready = model.step();
            ASSERT_TRUE(same(pass.takeReady(), ready));
            ASSERT_TRUE(same(pass.stack(), model.stack()));
        }
        ASSERT_TRUE(pass.over());
    }
}

// Kernels that place ranges in another order, each of which loses nothing: what fails is the order, or the bound, alone.
struct Breakage {
    std::string name;
    std::vector<Replacement> replacements;
};

constexpr const char* splitKernels = "split/split.cl";

constexpr const char* childSlot = "uint child_slot = plan.stack_base + 2u * before.splits;";

// All of an iteration's splits, which the kernels themselves need not know at that place.
constexpr const char* allSplits = "uint all = 0u; for (uint j = 0; j < plan.count; ++j) all += actions[j] >= ACTION_SPLIT_U ? 1u : 0u; ";

// The children of a batch stand on the stack in the reverse order of their parents.
Breakage reversedParents() {
    return {"reversed parents",
            {{splitKernels, childSlot, std::string(allSplits) + "uint child_slot = plan.stack_base + 2u * (all - 1u - before.splits);"},
             {splitKernels, "child_slot += 2u;", "child_slot -= 2u;"}}};
}

// First all lower halves, then all upper ones: NONINTERLEAVED in the thesis, figure 4.4.
Breakage halvesApart() {
    return {"halves apart",
            {{splitKernels, childSlot, std::string(allSplits) + "uint child_slot = plan.stack_base + before.splits;"},
             {splitKernels, "child_slot += 2u;", "child_slot += 1u;"},
             {splitKernels, "place_children(batch[i], action, stack, child_slot);",
              "place_children(batch[i], action, stack, child_slot, all);"},
             {splitKernels, "global range_t* stack, uint slot)", "global range_t* stack, uint slot, uint apart)"},
             {splitKernels, "stack[slot + k] = box_child(parent, action, k);", "stack[slot + k * apart] = box_child(parent, action, k);"}}};
}

// Fresh patches stand above the ranges of the stack in the batch, not below.
Breakage freshAbove() {
    return {
        "fresh above",
        {{splitKernels, "if (i < from.plan.fresh) {", "if (i >= from.plan.count - from.plan.fresh) {"},
         {splitKernels, "range.patch_index = from.fresh[i];", "range.patch_index = from.fresh[i - (from.plan.count - from.plan.fresh)];"},
         {splitKernels, "from.stack[from.plan.stack_base + (i - from.plan.fresh)]", "from.stack[from.plan.stack_base + i]"}}};
}

// Fresh patches are pushed on the others while there are any: half of a batch is fresh though the stack could fill it.
Breakage hastyFeed() {
    return {"hasty feed",
            {{"split/plan.clh", "uint taken = min(limits.batch, state->stack_count);",
              "uint hasty = min(limits.batch / 2u, left); uint taken = min(limits.batch - hasty, state->stack_count);"}}};
}

// Mixtures of deep and shallow trees, with many patches.
std::vector<Trial> disturbingTrials() {
    std::vector<Trial> trials;
    Random random(5);
    for (int k = 0; k < 12; ++k) {
        Trial trial;
        const auto p = oneOf<std::uint32_t>(random, {16, 100, 300});
        trial.plan = {{}, below(random, 1U << 24U), p, oneOf<int>(random, {3, 6, 12})};
        trial.plan.plots = randomPlots(random, 10 * std::size_t{p}, trial.plan.depth);
        if (k % 3 == 0) trial.plan.plots.assign(10 * std::size_t{p}, Plot::coin);
        trial.readyRoom = 2 * p;
        trials.push_back(std::move(trial));
    }
    return trials;
}

StackVerdict verdictOver(const KernelSources& kernels, const std::vector<Trial>& trials) {
    SplitRig rig(kernels);
    Report all;
    for (const Trial& trial : trials) {
        SCOPED_TRACE(trial.text());
        const Report report = run(rig, trial, true);
        all.verdict.ordered = all.verdict.ordered && report.verdict.ordered;
        all.verdict.bounded = all.verdict.bounded && report.verdict.bounded;
    }
    return all.verdict;
}

TEST(SplitStack, TrialsWouldSeeABrokenOrderOfPlacement) {
    const std::vector<Trial> trials = disturbingTrials();
    const StackVerdict sound = verdictOver(adversarialKernels(), trials);
    EXPECT_TRUE(sound.ordered && sound.bounded);
    for (const Breakage& breakage : {reversedParents(), halvesApart(), freshAbove()}) {
        SCOPED_TRACE(breakage.name);
        EXPECT_FALSE(verdictOver(replaced(adversarialKernels(), breakage.replacements), trials).ordered);
    }
}

TEST(SplitStack, TrialsWouldSeeABrokenBound) {
    const std::vector<Trial> trials = disturbingTrials();
    const StackVerdict broken = verdictOver(replaced(adversarialKernels(), hastyFeed().replacements), trials);
    EXPECT_FALSE(broken.ordered);
    EXPECT_FALSE(broken.bounded);
}

}  // namespace
}  // namespace tessera::splitting
