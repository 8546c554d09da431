#include "render/split_loop.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <limits>
#include <memory>

#include "dice/dice.h"
#include "render/frame_setup.h"
#include "split/host_split.h"
#include "tessera/error.h"

namespace tessera {
namespace {

// Iterations enqueued between two tries to hide, and tries whose counts the host has not seen: enough that the device never waits
// for the host, few enough that the no-ops behind the last batch cost next to nothing.
constexpr int iterationsPerRound = 4;
constexpr std::size_t roundsAhead = 2;

// Room in `ready`, in batches: each time it is full the film is resolved, which costs a pass over the tiles touched; 12 bytes a range
// are cheap beside it.
constexpr std::uint64_t batchesReady = 8;

// Limits under which the device finds `ready` full whatever it holds, so that all of it is hidden.
constexpr split_limits hideWhatIsReady{std::numeric_limits<std::uint32_t>::max(), std::numeric_limits<std::uint32_t>::max() - 1};

struct Round {
    cl::Event event;
    std::unique_ptr<split_state> state;
};

// Waits for pending reads before their memory goes, also when an exception passes.
struct Rounds {
    std::deque<Round> queue;
    Rounds() = default;
    Rounds(const Rounds&) = delete;
    Rounds& operator=(const Rounds&) = delete;
    ~Rounds() {
        for (const Round& round : queue) clWaitForEvents(1, &round.event());
    }
    split_state waitForOldest() {
        const Round& round = queue.front();
        round.event.wait();
        const split_state state = *round.state;
        queue.pop_front();
        return state;
    }
};

// Rounds without an iteration or a batch after which something must be wrong: with p free places in `ready` an iteration runs, and
// without them a batch does.
constexpr int idleRoundsMost = 16;

// Throws Error when the counts have stood still for too long, lest a faulty device keep the host enqueuing for ever.
class Watch {
public:
    void look(const split_state& state) {
        idleRounds_ = state.iterations == iterations_ && state.batches == batches_ ? idleRounds_ + 1 : 0;
        iterations_ = state.iterations;
        batches_ = state.batches;
        if (idleRounds_ > idleRoundsMost) throw Error("splitting stands still on the device; try --method cpu or another --device");
    }

private:
    std::uint32_t iterations_ = 0;
    std::uint32_t batches_ = 0;
    int idleRounds_ = 0;
};

void report(const SplitLoop& loop, double fraction) {
    if (loop.progress) loop.progress("split and dice", std::min(fraction, 1.0));
}

// Ranges whose micropolygons 32 bits can number (film/batch.clh).
std::uint64_t mostNumbered(std::uint32_t bits) { return (std::uint64_t{1} << (32 - 2 * bits)) - 2; }

void requireIds(const SplitLoop& loop, std::uint64_t ranges) {
    if (ranges <= mostNumbered(loop.frame.rate_bits)) return;
    throw Error("breadth has " + std::to_string(ranges) +
                " ranges at once, more than 32 bits can number when they are diced; use --method bounded");
}

void hide(const SplitLoop& loop, const split_limits& limits) {
    enqueueDiceHide(loop.session, loop.frame, limits, loop.queues, loop.patches, loop.film, loop.options.emulateAtomics);
    loop.film.enqueueResolve(loop.frame, limits, loop.queues);
}

}  // namespace

split_limits boundedLimits(const RenderOptions& options) {
    const int rate = options.mode == DiceMode::watertight ? options.gridSize : options.diceRate;
    const std::uint64_t numbered = mostNumbered(rateBits(rate));
    return {options.batch, static_cast<std::uint32_t>(std::min<std::uint64_t>(batchesReady * std::uint64_t{options.batch}, numbered))};
}

std::uint64_t boundedStack(const RenderOptions& options) {
    const int depth = options.mode == DiceMode::watertight ? 2 * QUAD_LEVEL_MOST : options.maxDepth;
    return (static_cast<std::uint64_t>(depth) + 1) * options.batch;
}

SplitResult runBounded(const SplitLoop& loop) {
    const split_limits limits = boundedLimits(loop.options);
    loop.queues.restart();
    Rounds rounds;
    Watch watch;
    SplitResult result;
    bool over = loop.patches.patches == 0;
    while (!over) {
        for (int k = 0; k < iterationsPerRound; ++k) loop.queues.enqueueIteration(loop.frame, limits, loop.patches, loop.dicingPoints);
        hide(loop, limits);
        auto state = std::make_unique<split_state>();
        cl::Event event = loop.queues.readStateLater(*state);
        rounds.queue.push_back({std::move(event), std::move(state)});
        loop.session.timeline.flush();
        if (rounds.queue.size() <= roundsAhead) continue;
        const split_state seen = rounds.waitForOldest();
        report(loop, static_cast<double>(seen.area_done) / loop.patches.patches);
        over = splitOver(seen, loop.patches) && seen.ready_count == 0;
        if (!over) watch.look(seen);
    }
    while (!rounds.queue.empty()) result.state = rounds.waitForOldest();
    result.stackPeak = result.state.stack_peak;
    return result;
}

SplitResult runBreadth(const SplitLoop& loop) {
    loop.queues.reserve({1, 1}, 1);
    loop.queues.restart();
    SplitResult result;
    while (!splitOver(result.state, loop.patches)) {
        const std::uint64_t count = result.state.stack_count + (loop.patches.patches - result.state.next_input);
        requireIds(loop, count);
        const auto all = static_cast<std::uint32_t>(count);
        loop.queues.growStack(2 * count, result.state.stack_count);
        loop.queues.reserve({all, all}, 0);
        loop.queues.enqueueIteration(loop.frame, {all, all}, loop.patches, loop.dicingPoints);
        hide(loop, hideWhatIsReady);
        result.state = loop.queues.readState();
        report(loop, static_cast<double>(result.state.area_done) / loop.patches.patches);
    }
    result.stackPeak = result.state.stack_peak;
    return result;
}

namespace {

template <typename T>
std::vector<T> readAll(Timeline& timeline, const cl::Buffer& buffer, std::size_t count) {
    std::vector<T> values(count);
    if (count > 0) timeline.read(buffer, values.data(), count * sizeof(T));
    return values;
}

HostPatches readPatches(const SplitLoop& loop) {
    Timeline& timeline = loop.session.timeline;
    const PatchSet& patches = loop.patches;
    const std::size_t floats = patches.eyeBytes() / sizeof(float);
    HostPatches host;
    host.eyePoints = readAll<float>(timeline, patches.eyePoints.cl(), floats);
    if (loop.frame.dicing_apart != 0) host.dicingPoints = readAll<float>(timeline, loop.dicingPoints, floats);
    host.placed = readAll<placed_patch>(timeline, patches.placed.cl(), patches.patches);
    host.records = readAll<edge_info>(timeline, patches.records.cl(), patches.recordCount);
    return host;
}

void setCounts(split_state& state, const HostSplitCounts& counts) {
    const auto set = [](std::uint32_t& low, std::uint32_t& high, std::uint64_t count) {
        low = static_cast<std::uint32_t>(count);
        high = static_cast<std::uint32_t>(count >> 32);
    };
    set(state.processed_low, state.processed_high, counts.processed);
    set(state.diced_low, state.diced_high, counts.diced);
    set(state.culled_low, state.culled_high, counts.culled);
    set(state.micropolygons_low, state.micropolygons_high, counts.micropolygons);
}

template <typename Rule>
SplitResult runOnHost(const SplitLoop& loop, Rule rule) {
    using Clock = std::chrono::steady_clock;
    loop.queues.reserve({1, loop.options.batch + 1024}, 0);
    HostSplit<Rule> split(std::move(rule), loop.options.threads);
    // The device must take no batch for the last one: the state says that patches are left.
    SplitResult result;
    while (true) {
        const auto start = Clock::now();
        const std::vector<typename Rule::Range> ranges = split.next(loop.options.batch);
        result.hostMs += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        if (ranges.empty()) break;
        result.state.ready_count = static_cast<std::uint32_t>(ranges.size());
        loop.queues.writeReady(ranges);
        loop.queues.writeState(result.state);
        hide(loop, hideWhatIsReady);
        ++result.state.batches;
        report(loop, split.fractionFed());
    }
    result.state.ready_count = 0;
    setCounts(result.state, split.counts());
    loop.queues.writeState(result.state);
    result.stackPeak = split.counts().stackPeak;
    return result;
}

}  // namespace

SplitResult runCpu(const SplitLoop& loop) {
    HostPatches patches = readPatches(loop);
    if (loop.frame.watertight != 0) return runOnHost(loop, WatertightRule(loop.frame, std::move(patches)));
    return runOnHost(loop, ClassicalRule(loop.frame, std::move(patches.eyePoints)));
}

}  // namespace tessera
