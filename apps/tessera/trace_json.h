// A frame's kernels and transfers as a trace for Perfetto and chrome://tracing.
#pragma once

#include "tessera/statistics.h"

#include <string>

namespace tessera::program {

// The trace event format: complete events ("ph": "X"), times in microseconds since the frame's first command.
// Tracks: "queue" (when the host enqueued what), "kernels", "transfers".
[[nodiscard]] std::string traceJson(const Statistics& statistics, const std::string& scene);

}  // namespace tessera::program
