// The `cpu` method: bound and split on the host, depth first, several threads. The reference for the others.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/frame_shared.h"
#include "split/quad_host.h"
#include "split/range_shared.h"

namespace tessera {

struct HostSplitCounts {
    std::uint64_t processed = 0;
    std::uint64_t diced = 0;
    std::uint64_t culled = 0;
    std::uint64_t micropolygons = 0;
    std::uint64_t stackPeak = 0;  // ranges on one thread's stack
};

// What a mode does with a range: pushes its children on the stack, or itself on `ready`, or neither; counts all but `processed`.
class ClassicalRule {
public:
    using Range = range_t;
    // `eyePoints`: as place_patches writes them.
    ClassicalRule(const frame_params& frame, std::vector<float> eyePoints) : frame_(frame), eyePoints_(std::move(eyePoints)) {}

    [[nodiscard]] const frame_params& frame() const { return frame_; }
    [[nodiscard]] static Range whole(std::uint32_t patch) { return {patch, 0, 0}; }
    void step(const Range& range, std::vector<Range>& stack, std::vector<Range>& ready, HostSplitCounts& counts) const;

private:
    frame_params frame_;
    std::vector<float> eyePoints_;
};

class WatertightRule {
public:
    using Range = quad_range;
    WatertightRule(const frame_params& frame, HostPatches patches) : frame_(frame), patches_(std::move(patches)) {}

    [[nodiscard]] const frame_params& frame() const { return frame_; }
    [[nodiscard]] Range whole(std::uint32_t patch) const { return wholePatch(frame_, patch); }
    void step(const Range& range, std::vector<Range>& stack, std::vector<Range>& ready, HostSplitCounts& counts) const;

private:
    frame_params frame_;
    HostPatches patches_;
};

template <typename Rule>
class HostSplit {
public:
    using Range = typename Rule::Range;

    // Thread t of T feeds on patches t, t + T, ... ; 0 threads = one a core.
    HostSplit(Rule rule, unsigned threads);

    // The next diceable ranges, at most about `limit` and at least one a thread while any are left; empty when all is done.
    // The order depends on the number of threads, nothing else. Throws Error where no thread can be had.
    [[nodiscard]] std::vector<Range> next(std::size_t limit);

    [[nodiscard]] HostSplitCounts counts() const;
    [[nodiscard]] double fractionFed() const;

private:
    struct Worker {
        std::vector<Range> stack;
        std::vector<Range> ready;
        std::uint32_t nextPatch = 0;
        HostSplitCounts counts;
    };
    void run(Worker& worker, std::size_t limit) const;
    void runAll(std::size_t limit);

    Rule rule_;
    std::vector<Worker> workers_;
};

extern template class HostSplit<ClassicalRule>;
extern template class HostSplit<WatertightRule>;

}  // namespace tessera
