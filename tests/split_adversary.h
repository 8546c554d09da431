// Split decisions made to do harm, in place of the real bounding: the same in a kernel and on the host.
#pragma once

#include "split_model.h"

#include "device/kernel_sources.h"
#include "tessera/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tessera::splitting {

// How the ranges of a patch decide. Those that don't split are diced or culled at random, but for the last two.
enum class Plot : std::uint32_t {
    everything,  // splits to the depth limit
    coin,        // splits a little more often than not
    burst,       // splits like the coin, and without fail on the last five levels
    first,       // only the range at (0, 0) splits: a deep, thin tree
    last,        // only the range at (1, 1) splits
    tightest,    // splits the p last ranges of each level, which fills the stack to its bound
    cullAll,
    diceAll,
};

// A scene's patches and what each of them is told.
struct Plan {
    std::vector<Plot> plots;  // of each patch
    std::uint32_t seed = 0;   // below 2^24
    std::uint32_t batch = 1;  // p, for Plot::tightest
    int depth = 0;            // the most splits, K
};

// The kernels with "split/bound.clh" replaced by one that follows the plan written into the scene's control points.
[[nodiscard]] KernelSources adversarialKernels();
// A scene whose control points hold the plan, to be seen by Camera{}.
[[nodiscard]] Scene sceneOf(const Plan& plan);
// What that kernel decides. `plan` must outlive the result.
[[nodiscard]] Decide decisionsOf(const Plan& plan);

// An exact text to be replaced, which must occur once.
struct Replacement {
    std::string file;
    std::string from;
    std::string to;
};

// Throws std::runtime_error naming the text where it does not occur exactly once: the kernels have changed, and the test must follow.
[[nodiscard]] KernelSources replaced(KernelSources sources, const std::vector<Replacement>& replacements);

}  // namespace tessera::splitting
