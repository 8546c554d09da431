// What the comparators' programs share: their command lines, clock and the line of JSON they print.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tessera::bench {

// Options of numbers, `--name value`, each one of `options` with what it is without; throws std::invalid_argument on another.
[[nodiscard]] std::map<std::string, double> numberOptions(int count, char** words, std::map<std::string, double> options);

// Seconds of `runs` calls by the wall clock, after one that is not measured.
[[nodiscard]] std::vector<double> secondsOf(int runs, const std::function<void()>& work);

// One object on a line of its own: the name, counts, and seconds a run.
void printRuns(const std::string& name, const std::map<std::string, double>& counts, const std::vector<double>& seconds);

// Runs `work`, saying on the error stream under the program's name what it throws. Returns the exit code.
[[nodiscard]] int guarded(const std::string& program, const std::function<void()>& work);

}  // namespace tessera::bench
