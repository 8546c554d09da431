// Runs the split stage of a frame by one of its methods over the patches on the device, and has what is diceable hidden.
#pragma once

#include <functional>

#include "film/film.h"
#include "split/queues.h"
#include "tessera/options.h"

namespace tessera {

// What a run over one bucket and chunk works on.
struct SplitLoop {
    DeviceSession& session;
    SplitQueues& queues;  // reserved for `limits`
    Film& film;
    const frame_params& frame;
    const PatchSet& patches;  // fed already (SplitQueues::enqueueFeed)
    const RenderOptions& options;
    split_limits limits;
    std::function<void(double)> report;  // how far this run is, 0 to 1; may be empty
    // Called when the device has work, to prepare what comes next; may be empty.
    std::function<void()> meanwhile;
    // Enqueues what comes when all is hidden, and waits for it; the kernels in it do nothing before that. May be called several times.
    std::function<void()> finish;
    int buckets = 1;  // of the picture: about so many share what is fed of the patches
};

// What the device does not count.
struct SplitReport {
    double hostMs = 0;               // the cpu method's time on the host
    std::uint64_t stackGrowths = 0;  // breadth: times its buffers had to grow
    std::uint64_t hostWaits = 0;     // times that the host waited for the device before it could go on

    void add(const SplitReport& more) {
        hostMs += more.hostMs;
        stackGrowths += more.stackGrowths;
        hostWaits += more.hostWaits;
    }
};

// Enqueues dicing and hiding of what is ready, where the device finds it due.
void enqueueHide(const SplitLoop& loop, const split_limits& limits);

// Grows the queues as it goes. Throws Error where the budget or the device holds no more.
[[nodiscard]] SplitReport runBreadth(const SplitLoop& loop);
// On the host, while the device hides what came before.
[[nodiscard]] SplitReport runCpu(const SplitLoop& loop);

}  // namespace tessera
