#include "render/run_ahead.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "tessera/error.h"

namespace tessera {
namespace {

// How iterations are enqueued: so many between two tries to hide, and so many such rounds at first, beside those that it takes to feed all
// patches: as many as a scene of small patches needs. Those behind the last one find nothing to do, and cost a launch each.
struct Pace {
    std::uint32_t iterations;
    std::uint32_t firstRounds;
};
constexpr Pace boundedPace{2, 6};
// Its iterations are launches, of a few ranges each at first.
constexpr Pace localPace{8, 10};
constexpr std::uint32_t mostRounds = 4096;
// Most rounds of a launch of the local method; the device takes fewer where less is left (local.clh). More make no launch fewer.
constexpr std::uint32_t roundsPerLaunch = 32;
// Looks at the counts in one burst, for the progress that a user sees. Nothing waits for them.
constexpr std::uint32_t looksPerBurst = 16;

// Waits for pending reads before their memory goes, also when an exception passes.
class Looks {
public:
    Looks() = default;
    Looks(const Looks&) = delete;
    Looks& operator=(const Looks&) = delete;
    ~Looks() {
        for (const Look& look : looks_) clWaitForEvents(1, &look.event());
    }

    void add(SplitQueues& queues) {
        auto state = std::make_unique<split_state>();
        cl::Event event = queues.readStateLater(*state);
        looks_.push_back({std::move(event), std::move(state)});
    }
    // Shows each look's counts as soon as they are there; returns the last ones.
    template <typename See>
    split_state wait(const See& see) {
        split_state last{};
        for (const Look& look : looks_) {
            if (look.event.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>() != CL_COMPLETE) look.event.wait();
            last = *look.state;
            see(last);
        }
        looks_.clear();
        return last;
    }

private:
    struct Look {
        cl::Event event;
        std::unique_ptr<split_state> state;
    };
    std::vector<Look> looks_;
};

// Rounds that what is left may need, by what those before brought about; at least twice as many as the last time, so that a frame of any
// number of iterations takes few bursts.
std::uint32_t roundsLeft(const split_state& state, double patches, std::uint32_t last, const Pace& pace) {
    const double done = std::clamp(static_cast<double>(state.area_done) / std::max(1.0, patches), 1e-6, 1.0);
    const double rounds = std::ceil(1.25 * state.run_iterations * (1.0 - done) / done / pace.iterations);
    return static_cast<std::uint32_t>(std::clamp(rounds, std::min(2.0 * last, double{mostRounds}), double{mostRounds}));
}

bool isDrawn(const split_state& state) { return splitOver(state) && state.hidden == state.ready_count; }

// Throws Error when a burst has changed nothing: a faulty device must not keep the host enqueuing for ever.
void requireProgress(const split_state& before, const split_state& after) {
    if (before.iterations != after.iterations || before.batches != after.batches) return;
    throw Error("splitting stands still on the device; try --method cpu or another --device");
}

// Iterations that feed what a bucket is expected to see of the patches, `each` in one. To find nothing to do for all patches of a large
// scene would take many times as long as a small bucket.
std::uint32_t iterationsToFeed(const SplitLoop& loop, std::uint32_t each) {
    return loop.patches.patches / static_cast<std::uint32_t>(loop.buckets) / each;
}

template <typename Iteration>
SplitReport runAhead(const SplitLoop& loop, const Pace& pace, std::uint32_t feeding, const Iteration& enqueueIteration) {
    std::uint32_t rounds = pace.firstRounds + feeding / pace.iterations;
    SplitReport report;
    Looks looks;
    split_state before{};
    const double patches = loop.patches.patches;
    while (true) {
        rounds = std::min(rounds, mostRounds);
        const std::uint32_t stride = loop.report ? std::max(1U, rounds / looksPerBurst) : rounds;
        for (std::uint32_t k = 1; k <= rounds; ++k) {
            for (std::uint32_t i = 0; i < pace.iterations; ++i) enqueueIteration();
            enqueueHide(loop, loop.limits);
            if (k % stride == 0 || k == rounds) looks.add(loop.queues);
        }
        loop.session.timeline.flush();
        if (loop.meanwhile && report.hostWaits == 0) loop.meanwhile();
        const auto see = [&](const split_state& state) {
            if (loop.report) loop.report(std::min(1.0, static_cast<double>(state.area_done) / std::max(1.0, patches)));
        };
        // With nobody to show it to, the counts are there when what comes last is.
        if (loop.finish && !loop.report) loop.finish();
        const split_state after = looks.wait(see);
        if (loop.finish && loop.report) loop.finish();
        ++report.hostWaits;
        if (isDrawn(after)) return report;
        requireProgress(before, after);
        rounds = roundsLeft(after, patches, rounds, pace);
        before = after;
    }
}

}  // namespace

SplitReport runBounded(const SplitLoop& loop) {
    const std::uint32_t feeding = iterationsToFeed(loop, loop.limits.batch);
    return runAhead(loop, boundedPace, feeding,
                    [&] { loop.queues.enqueueIteration(loop.frame, loop.limits, loop.patches, loop.film.coarse()); });
}

SplitReport runLocal(const SplitLoop& loop, LocalQueues& local) {
    const std::uint32_t feeding = iterationsToFeed(loop, loop.limits.batch * roundsPerLaunch);
    return runAhead(loop, localPace, feeding,
                    [&] { local.enqueueLaunch(loop.frame, loop.limits, loop.patches, loop.film.coarse(), loop.queues, roundsPerLaunch); });
}

}  // namespace tessera
