// Runs the split stage of a frame by one of its methods and has every full batch hidden.
#pragma once

#include "film/film.h"
#include "split/queues.h"
#include "tessera/options.h"
#include "tessera/progress.h"

namespace tessera {

struct SplitLoop {
    DeviceSession& session;
    SplitQueues& queues;
    Film& film;
    const frame_params& frame;
    const PatchSet& patches;
    const cl::Buffer& dicingPoints;  // the patches in the dicing camera's space; patches.eyePoints where it is the frame's own
    const RenderOptions& options;
    const Progress& progress;
};

// What the split stage counted; `hostMs` is the time the cpu method spent on the host.
struct SplitResult {
    split_state state{};
    std::uint64_t stackPeak = 0;
    double hostMs = 0;
};

// p ranges at a time, and room for several batches of diceable ones, as far as 32 bits can number their micropolygons.
[[nodiscard]] split_limits boundedLimits(const RenderOptions& options);
// The bound on the stack, (K + 1) p for K cuts at most, for any number of patches (DESIGN.md, "Bounded split without the N").
[[nodiscard]] std::uint64_t boundedStack(const RenderOptions& options);

// Requires queues reserved for boundedLimits() and boundedStack(). Leaves the state buffer for shade_tiles' count.
[[nodiscard]] SplitResult runBounded(const SplitLoop& loop);
// Grows the queues as it goes. Throws Error where the device holds no more.
[[nodiscard]] SplitResult runBreadth(const SplitLoop& loop);
[[nodiscard]] SplitResult runCpu(const SplitLoop& loop);

}  // namespace tessera
