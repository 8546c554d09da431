// What was measured, as CSV files (RFC 4180, with plain line feeds).
#pragma once

#include "evaluation/measure.h"
#include "tessera/device.h"

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tessera::bench {

// The fields with commas between them, in quotes where they need it, and a line feed.
[[nodiscard]] std::string csvLine(std::span<const std::string> fields);

// Columns of a figure's file. Times are milliseconds and medians over the frames, each for itself; counts are the last frame's.
[[nodiscard]] std::vector<std::string> resultColumns();

// A row of them. Where no frame came to its end all but what was asked for, and `error`, are empty.
[[nodiscard]] std::vector<std::string> resultRow(const Measured& measured, const std::string& device);

// The files of one evaluation in a folder: FIGURE.csv, FIGURE_load.csv where the load of work-groups is wanted, and machine.csv.
class ResultFiles {
public:
    // Makes the folder and writes machine.csv: pairs of name and value, the device's first. Throws Error where it cannot be written.
    ResultFiles(std::filesystem::path folder, DeviceInfo device, std::span<const std::pair<std::string, std::string>> settings);

    // Appends the rows to their figures' files, which are begun anew with the first. On disk when it returns. Throws Error.
    void add(std::span<const Measured> rows);

private:
    void append(const std::string& file, std::span<const std::string> columns, const std::string& lines);

    std::filesystem::path folder_;
    DeviceInfo device_;
    std::set<std::string> begun_;
};

}  // namespace tessera::bench
