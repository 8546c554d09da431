// A frame's statistics as JSON.
#pragma once

#include "tessera/statistics.h"

#include <span>
#include <string>

namespace tessera::program {

// One object: counts, times in milliseconds ("..._ms"), memory in bytes. `frameMs` holds the time of every frame that
// was rendered, in order; `statistics` are those of the median one.
[[nodiscard]] std::string statsJson(const Statistics& statistics, const std::string& scene, const std::string& camera,
                                    std::span<const double> frameMs);

}  // namespace tessera::program
