// Frames of trials taken in turn.
#include "evaluation/measure.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <exception>

namespace tessera::bench {

namespace {

void turn(Measured& measured, const TakeFrame& take) {
    if (!measured.error.empty() || (measured.trial.once && !measured.frames.empty())) return;
    try {
        if (!measured.trial.once) static_cast<void>(take(measured.trial));
        measured.frames.push_back(take(measured.trial));
    } catch (const std::exception& error) {
        measured.error = error.what();
    }
}

}  // namespace

std::vector<Measured> measure(const Group& group, int runs, double limitSeconds, const TakeFrame& take) {
    std::vector<Measured> all;
    for (const Trial& trial : group.trials) all.push_back({trial, {}, {}});
    const auto start = std::chrono::steady_clock::now();
    for (int round = 0; round < runs; ++round) {
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        if (round > 0 && taken.count() >= limitSeconds) break;
        for (Measured& measured : all) turn(measured, take);
    }
    return all;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace tessera::bench
