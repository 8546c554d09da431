// A frame's statistics as JSON, and where --stats puts such texts.
#pragma once

#include "tessera/statistics.h"
#include "tessera/subdivision.h"

#include <span>
#include <string>

namespace tessera::program {

// One object: counts, times in milliseconds ("..._ms"), memory in bytes. `frameMs` holds the time of every frame that
// was rendered, in order; `statistics` are those of the median one. `cages`: what the scene's became ("subdivision").
[[nodiscard]] std::string statsJson(const Statistics& statistics, const std::string& scene, const std::string& camera,
                                    std::span<const double> frameMs, std::span<const CageReport> cages);

// Throws Error where writeStats() could not write `path`.
void checkStatsFile(const std::string& path);

// Writes `json` to the file `path`; to standard output where it is "-", nowhere where it is empty. Throws Error.
void writeStats(const std::string& path, const std::string& json);

}  // namespace tessera::program
