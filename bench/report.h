// What tessera_bench prints.
#pragma once

#include <benchmark/benchmark.h>

#include <vector>

namespace tessera::bench {

// Google Benchmark's table with a row a benchmark: the median over its runs, or the run where there is only one.
// Files written by --benchmark_out still hold all runs.
class MedianReporter : public benchmark::ConsoleReporter {
public:
    MedianReporter() : ConsoleReporter(OO_Tabular) {}
    void ReportRuns(const std::vector<Run>& runs) override;

    [[nodiscard]] bool failed() const { return failed_; }

private:
    bool failed_ = false;
};

}  // namespace tessera::bench
