// What was measured, as CSV files.
#include "evaluation/results.h"

#include "tessera/error.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <locale>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

namespace tessera::bench {

namespace {

std::string numberText(double value) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(6);
    text << value;
    return text.str();
}

// Kernels are told by their station's prefix: their number and names may change.
double kernelMs(const Statistics& statistics, std::string_view prefix) {
    double sum = 0.0;
    for (const auto& [kernel, milliseconds] : statistics.kernelMs) {
        if (kernel.starts_with(prefix)) sum += milliseconds;
    }
    return sum;
}

double stagesMs(const Statistics& s) {
    return s.splitMs + kernelMs(s, "place_") + kernelMs(s, "dice_") + kernelMs(s, "resolve_") + kernelMs(s, "shade_");
}

double medianOf(const Measured& measured, const std::function<double(const Statistics&)>& value) {
    std::vector<double> values;
    for (const Statistics& frame : measured.frames) values.push_back(value(frame));
    return median(std::move(values));
}

using Asked = std::function<std::string(const Measured&)>;
using Time = std::function<double(const Statistics&)>;
using Count = std::function<std::uint64_t(const Statistics&)>;

struct AskedColumn {
    std::string name;
    Asked text;
};
struct TimeColumn {
    std::string name;
    Time milliseconds;
};
struct CountColumn {
    std::string name;
    Count count;
};

const std::vector<AskedColumn>& askedColumns() {
    static const std::vector<AskedColumn> columns{
        {"figure", [](const Measured& m) { return m.trial.figure; }},
        {"scene", [](const Measured& m) { return m.trial.view.scene; }},
        {"camera", [](const Measured& m) { return m.trial.view.camera; }},
        {"along", [](const Measured& m) { return m.trial.along ? numberText(*m.trial.along) : std::string(); }},
        {"mode", [](const Measured& m) { return std::string(name(m.trial.options.mode)); }},
        {"method", [](const Measured& m) { return std::string(name(m.trial.options.method)); }},
        {"asked_batch", [](const Measured& m) { return std::to_string(m.trial.options.batch); }},
        {"asked_MiB", [](const Measured& m) { return std::to_string(m.trial.options.memoryBytes >> 20U); }},
        {"width", [](const Measured& m) { return std::to_string(m.trial.options.width); }},
        {"height", [](const Measured& m) { return std::to_string(m.trial.options.height); }},
        {"pixel_samples", [](const Measured& m) { return std::to_string(m.trial.options.pixelSamples); }},
        {"asked_bucket_width", [](const Measured& m) { return std::to_string(m.trial.options.bucketWidth); }},
        {"asked_bucket_height", [](const Measured& m) { return std::to_string(m.trial.options.bucketHeight); }},
        {"occlusion", [](const Measured& m) { return std::string(m.trial.options.occlusion ? "1" : "0"); }},
        {"frames", [](const Measured& m) { return std::to_string(m.frames.size()); }},
    };
    return columns;
}

const std::vector<TimeColumn>& timeColumns() {
    static const std::vector<TimeColumn> columns{
        {"frame_ms", [](const Statistics& s) { return s.frameMs; }},
        {"split_ms", [](const Statistics& s) { return s.splitMs; }},
        {"place_ms", [](const Statistics& s) { return kernelMs(s, "place_"); }},
        {"dice_ms", [](const Statistics& s) { return kernelMs(s, "dice_"); }},
        {"resolve_ms", [](const Statistics& s) { return kernelMs(s, "resolve_"); }},
        {"shade_ms", [](const Statistics& s) { return kernelMs(s, "shade_"); }},
        {"other_ms", [](const Statistics& s) { return kernelMs(s, "") - stagesMs(s); }},
        // Of a device that splits while it dices the stages' sum may pass the frame.
        {"idle_ms", [](const Statistics& s) { return s.frameMs - kernelMs(s, ""); }},
    };
    return columns;
}

std::uint64_t purposeBytes(const Statistics& statistics, const std::string& purpose) {
    const auto found = statistics.deviceBytes.find(purpose);
    return found == statistics.deviceBytes.end() ? 0 : found->second;
}

const std::vector<CountColumn>& countColumns() {
    static const std::vector<CountColumn> columns{
        {"patches", [](const Statistics& s) { return s.patches; }},
        {"processed", [](const Statistics& s) { return s.rangesProcessed; }},
        {"diced", [](const Statistics& s) { return s.rangesDiced; }},
        {"culled", [](const Statistics& s) { return s.rangesCulled; }},
        {"occluded", [](const Statistics& s) { return s.rangesOccluded; }},
        {"patches_skipped", [](const Statistics& s) { return s.patchesSkipped; }},
        {"micropolygons", [](const Statistics& s) { return s.micropolygons; }},
        {"stack_peak", [](const Statistics& s) { return s.stackPeak; }},
        {"batch", [](const Statistics& s) { return s.batch; }},
        {"iterations", [](const Statistics& s) { return s.iterations; }},
        {"batches", [](const Statistics& s) { return s.batches; }},
        {"launches", [](const Statistics& s) { return s.launches; }},
        {"stack_growths", [](const Statistics& s) { return s.stackGrowths; }},
        {"host_waits", [](const Statistics& s) { return s.hostWaits; }},
        {"buckets", [](const Statistics& s) { return s.buckets; }},
        {"bucket_width", [](const Statistics& s) { return static_cast<std::uint64_t>(s.bucketWidth); }},
        {"bucket_height", [](const Statistics& s) { return static_cast<std::uint64_t>(s.bucketHeight); }},
        {"chunks", [](const Statistics& s) { return s.chunks; }},
        {"streamed_bytes", [](const Statistics& s) { return s.streamedBytes; }},
        {"budget_bytes", [](const Statistics& s) { return s.deviceBytesBudget; }},
        {"device_bytes", [](const Statistics& s) { return s.deviceBytesPeak; }},
        {"scene_bytes", [](const Statistics& s) { return purposeBytes(s, "scene"); }},
        {"queue_bytes", [](const Statistics& s) { return purposeBytes(s, "queues"); }},
        {"film_bytes", [](const Statistics& s) { return purposeBytes(s, "film"); }},
        {"picture_bytes", [](const Statistics& s) { return purposeBytes(s, "picture"); }},
    };
    return columns;
}

const std::vector<std::string>& loadColumns() {
    static const std::vector<std::string> columns{"figure", "scene", "camera", "mode", "group", "ranges", "device"};
    return columns;
}

// A row a work-group of the trial's last frame.
std::string loadLines(const Measured& measured, const std::string& device) {
    if (measured.frames.empty()) return {};
    std::string lines;
    const Trial& trial = measured.trial;
    std::size_t group = 0;
    for (const std::uint64_t ranges : measured.frames.back().groupRanges) {
        const std::vector<std::string> fields{trial.figure,
                                              trial.view.scene,
                                              trial.view.camera,
                                              std::string(name(trial.options.mode)),
                                              std::to_string(group++),
                                              std::to_string(ranges),
                                              device};
        lines += csvLine(fields);
    }
    return lines;
}

}  // namespace

std::string csvLine(std::span<const std::string> fields) {
    std::string line;
    for (const std::string& field : fields) {
        if (&field != fields.data()) line += ',';
        if (field.find_first_of(",\"\r\n") == std::string::npos) {
            line += field;
            continue;
        }
        line += '"';
        for (const char letter : field) line += letter == '"' ? std::string("\"\"") : std::string(1, letter);
        line += '"';
    }
    return line + '\n';
}

std::vector<std::string> resultColumns() {
    std::vector<std::string> names;
    for (const AskedColumn& column : askedColumns()) names.push_back(column.name);
    for (const TimeColumn& column : timeColumns()) names.push_back(column.name);
    names.insert(names.end(), {"frame_ms_least", "frame_ms_most"});
    for (const CountColumn& column : countColumns()) names.push_back(column.name);
    names.insert(names.end(), {"device", "error"});
    return names;
}

std::vector<std::string> resultRow(const Measured& measured, const std::string& device) {
    std::vector<std::string> row;
    for (const AskedColumn& column : askedColumns()) row.push_back(column.text(measured));
    if (measured.frames.empty()) {
        row.resize(resultColumns().size() - 2);
    } else {
        for (const TimeColumn& column : timeColumns()) row.push_back(numberText(medianOf(measured, column.milliseconds)));
        std::vector<double> frames;
        for (const Statistics& frame : measured.frames) frames.push_back(frame.frameMs);
        const auto [least, most] = std::minmax_element(frames.begin(), frames.end());
        row.insert(row.end(), {numberText(*least), numberText(*most)});
        for (const CountColumn& column : countColumns()) row.push_back(std::to_string(column.count(measured.frames.back())));
    }
    row.insert(row.end(), {device, measured.error});
    return row;
}

ResultFiles::ResultFiles(std::filesystem::path folder, DeviceInfo device, std::span<const std::pair<std::string, std::string>> settings)
    : folder_(std::move(folder)), device_(std::move(device)) {
    std::error_code failed;
    std::filesystem::create_directories(folder_, failed);
    if (failed) throw Error(folder_.string() + ": the folder cannot be made: " + failed.message() + "; use another --out");
    std::string lines;
    const auto line = [&](const std::string& key, const std::string& value) { lines += csvLine(std::vector<std::string>{key, value}); };
    line("device", device_.name);
    line("type", device_.type);
    line("platform", device_.platform);
    line("driver", device_.driverVersion);
    line("compute_units", std::to_string(device_.computeUnits));
    line("memory_MiB", std::to_string(device_.globalBytes >> 20U));
    for (const auto& [key, value] : settings) line(key, value);
    append("machine.csv", std::vector<std::string>{"name", "value"}, lines);
}

void ResultFiles::add(std::span<const Measured> rows) {
    for (const Measured& measured : rows) {
        append(measured.trial.figure + ".csv", resultColumns(), csvLine(resultRow(measured, device_.name)));
        if (measured.trial.load) append(measured.trial.figure + "_load.csv", loadColumns(), loadLines(measured, device_.name));
    }
}

void ResultFiles::append(const std::string& file, std::span<const std::string> columns, const std::string& lines) {
    const std::filesystem::path path = folder_ / file;
    const bool first = begun_.insert(file).second;
    std::ofstream stream(path, first ? std::ios::trunc : std::ios::app);
    if (first) stream << csvLine(columns);
    stream << lines;
    stream.close();
    if (!stream) throw Error(path.string() + ": cannot be written; use another --out");
}

}  // namespace tessera::bench
