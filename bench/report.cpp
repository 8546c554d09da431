// What tessera_bench prints: medians alone.
#include "report.h"

namespace tessera::bench {

void MedianReporter::ReportRuns(const std::vector<Run>& runs) {
    std::vector<Run> wanted;
    for (const Run& run : runs) {
        failed_ = failed_ || run.error_occurred;
        const bool median = run.run_type == Run::RT_Aggregate && run.aggregate_name == "median";
        const bool alone = run.run_type == Run::RT_Iteration && run.repetitions == 1;
        // Of a benchmark that fails there are no aggregates: its first run tells why.
        if (!(median || alone || (run.error_occurred && run.repetition_index == 0))) continue;
        wanted.push_back(run);
        // The same for all: left out of the names.
        wanted.back().run_name.iterations.clear();
        wanted.back().run_name.time_type.clear();
    }
    if (!wanted.empty()) ConsoleReporter::ReportRuns(wanted);
}

}  // namespace tessera::bench
