// Frames of trials taken in turn.
#pragma once

#include "evaluation/plan.h"
#include "tessera/statistics.h"

#include <functional>
#include <string>
#include <vector>

namespace tessera::bench {

struct Measured {
    Trial trial;
    std::vector<Statistics> frames;  // those measured
    std::string error;               // what ended the trial; empty when nothing did
};

using TakeFrame = std::function<Statistics(const Trial&)>;

// Gives the group's trials up to `runs` turns: round by round, so that a machine whose speed drifts is as fast for one as for the other. A
// turn is a frame that is thrown away and one that is kept; of a trial with `once`, one frame in all. After `limitSeconds` no further round
// begins, but the first is always whole. A trial whose frame throws gets no further turn.
[[nodiscard]] std::vector<Measured> measure(const Group& group, int runs, double limitSeconds, const TakeFrame& take);

// Of an even number the mean of the middle two. Requires a value.
[[nodiscard]] double median(std::vector<double> values);

}  // namespace tessera::bench
