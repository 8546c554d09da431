// The `cpu` method: bound and split on the host, depth first, several threads. The reference for the others.
#pragma once

#include <cstdint>
#include <vector>

#include "core/frame_shared.h"
#include "split/range_shared.h"
#include "surface/patch_shared.h"

namespace tessera {

struct HostSplitCounts {
    std::uint64_t processed = 0;
    std::uint64_t diced = 0;
    std::uint64_t culled = 0;
    std::uint64_t stackPeak = 0;  // ranges on one thread's stack
};

class HostSplit {
public:
    // `eyePoints`: as place_patches writes them. Thread t of T feeds on patches t, t + T, ... ; 0 threads = one a core.
    HostSplit(const frame_params& frame, std::vector<float> eyePoints, unsigned threads);

    // The next diceable ranges, at most about `limit` and at least one a thread while any are left; empty when all is done.
    // The order depends on the number of threads, nothing else.
    [[nodiscard]] std::vector<range_t> next(std::size_t limit);

    [[nodiscard]] HostSplitCounts counts() const;
    [[nodiscard]] double fractionFed() const;

private:
    struct Worker {
        std::vector<range_t> stack;
        std::vector<range_t> ready;
        std::uint32_t nextPatch = 0;
        HostSplitCounts counts;
    };
    void run(Worker& worker, std::size_t limit) const;
    void runAll(std::size_t limit);
    void step(Worker& worker, const range_t& range) const;

    frame_params frame_;
    std::vector<float> eyePoints_;
    std::vector<Worker> workers_;
};

}  // namespace tessera
