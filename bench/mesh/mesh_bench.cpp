// tessera_mesh_bench: times of the tessellator by stage, on the paper's scenes and on sheets of bicubic patches.
#include "mesh/mesh_measure.h"
#include "mesh/mesh_report.h"
#include "mesh/mesh_scenes.h"
#include "tessera/device.h"
#include "usage.h"

#include <algorithm>
#include <exception>
#include <iostream>
#include <regex>
#include <string>
#include <vector>

namespace {

using namespace tessera::bench;

struct Arguments {
    std::string filter;
    std::string json;
    std::string scenes = TESSERA_SHARED_SCENES;
    std::string cache;
    int device = -1;
    int runs = 7;
    bool list = false;
    bool help = false;
};

const char* const kHelp =
    "tessera_mesh_bench measures tessellations on an OpenCL device and reports medians, in milliseconds by stage.\n"
    "\n"
    "  --list           List what can be measured\n"
    "  --filter REGEX   Measure what matches ('^table1/' for the paper's table 1)\n"
    "  --runs N         Frames measured for each, at least 1 [7]; one before them is not measured\n"
    "  --json FILE      Also write all runs to FILE\n"
    "  --device I       Number of the device in 'tessera devices' [the default one]\n"
    "  --scenes DIR     Folder that may have killeroo.mscene\n"
    "                   [" TESSERA_SHARED_SCENES
    "]\n"
    "  --cache-dir DIR  Folder of compiled kernels [the user's]\n"
    "\n"
    "  table1, table2   scenes of Schwarz and Stamminger, 1024x768 pixels, half a pixel's error\n"
    "  sheet/RATE       smooth bicubic patches at a mean rate, about a million cells\n"
    "  equal/RATE       1024 of them, for comparison with slower programs at equal tolerance\n";

Arguments parse(const std::vector<std::string>& words) {
    Arguments arguments;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        const auto value = [&]() -> const std::string& {
            if (i + 1 == words.size()) throw UsageError(word + " needs a value");
            return words[++i];
        };
        if (word == "--list")
            arguments.list = true;
        else if (word == "--help" || word == "-h")
            arguments.help = true;
        else if (word == "--filter")
            arguments.filter = value();
        else if (word == "--json")
            arguments.json = value();
        else if (word == "--scenes")
            arguments.scenes = value();
        else if (word == "--cache-dir")
            arguments.cache = value();
        else if (word == "--device")
            arguments.device = wholeNumber("--device", value(), 0);
        else if (word == "--runs")
            arguments.runs = wholeNumber("--runs", value(), 1);
        else
            throw UsageError("unknown option '" + word + "'");
    }
    return arguments;
}

std::vector<MeshMeasurement> wanted(const Arguments& arguments) {
    std::vector<MeshMeasurement> all = meshMeasurements(arguments.scenes);
    const bool killeroo = std::any_of(all.begin(), all.end(), [](const MeshMeasurement& one) { return one.name == "table1/killeroo"; });
    if (!killeroo) std::cerr << "tessera_mesh_bench: no killeroo.mscene in '" << arguments.scenes << "': it and its herd are left out\n";
    try {
        const std::regex filter(arguments.filter);
        std::erase_if(all, [&filter](const MeshMeasurement& one) { return !std::regex_search(one.name, filter); });
    } catch (const std::regex_error&) {
        throw UsageError("--filter: '" + arguments.filter + "' is no regular expression");
    }
    if (all.empty()) throw UsageError("--filter: nothing matches '" + arguments.filter + "'; --list names all");
    return all;
}

int run(const std::vector<std::string>& words) {
    const Arguments arguments = parse(words);
    if (arguments.help) {
        std::cout << kHelp;
        return 0;
    }
    const std::vector<MeshMeasurement> all = wanted(arguments);
    if (arguments.list) {
        for (const MeshMeasurement& one : all) std::cout << one.name << "\n";
        return 0;
    }
    tessera::RendererSettings settings;
    settings.device = arguments.device;
    settings.cacheFolder = arguments.cache;
    tessera::Tessellator tessellator(settings);
    std::cout << "on " << tessellator.device().name << "\n";
    printHeading(std::cout);
    std::vector<MeshMeasured> done;
    bool failed = false;
    for (const MeshMeasurement& one : all) {
        done.push_back(measureMesh(tessellator, one, arguments.runs));
        printRow(std::cout, done.back());
        std::cout.flush();
        failed = failed || !done.back().error.empty();
    }
    if (!arguments.json.empty()) writeJson(arguments.json, tessellator.device().name, arguments.runs, done);
    return failed ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(std::vector<std::string>(argv + 1, argv + argc));
    } catch (const UsageError& error) {
        std::cerr << "tessera_mesh_bench: error: " << error.what() << "; see --help\n";
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "tessera_mesh_bench: error: " << error.what() << "\n";
        return 1;
    }
}
