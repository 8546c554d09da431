// The command line of tessera_evaluate.
#include "evaluation/arguments.h"

#include <cstddef>
#include <functional>
#include <map>
#include <regex>

namespace tessera::bench {

namespace {

std::string regularExpression(const std::string& text) {
    try {
        static_cast<void>(std::regex(text));
    } catch (const std::regex_error& error) {
        throw UsageError("--filter: '" + text + "' is no regular expression: " + error.what());
    }
    return text;
}

}  // namespace

EvaluationArguments parseEvaluationArguments(const std::vector<std::string>& words, const std::string& defaultScenes) {
    EvaluationArguments arguments;
    arguments.scenes = defaultScenes;
    arguments.out = "evaluation";
    bool runsGiven = false;
    const std::map<std::string, std::function<void(const std::string&)>> withValue{
        {"--filter", [&](const std::string& value) { arguments.filter = regularExpression(value); }},
        {"--runs",
         [&](const std::string& value) {
             arguments.runs = wholeNumber("--runs", value, 1, 1000);
             runsGiven = true;
         }},
        {"--limit", [&](const std::string& value) { arguments.limit = wholeNumber("--limit", value, 0, 86400); }},
        {"--city", [&](const std::string& value) { arguments.city = wholeNumber("--city", value, 20000, 20'000'000); }},
        {"--device", [&](const std::string& value) { arguments.device = wholeNumber("--device", value, 0, 1000); }},
        {"--scenes", [&](const std::string& value) { arguments.scenes = value; }},
        {"--out", [&](const std::string& value) { arguments.out = value; }},
        {"--cache-dir", [&](const std::string& value) { arguments.cache = value; }},
    };
    const std::map<std::string, bool*> flags{
        {"--quick", &arguments.quick}, {"--list", &arguments.list}, {"--help", &arguments.help}, {"-h", &arguments.help}};
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (const auto option = withValue.find(word); option != withValue.end()) {
            if (i + 1 == words.size()) throw UsageError(word + " needs a value");
            option->second(words[++i]);
        } else if (const auto flag = flags.find(word); flag != flags.end()) {
            *flag->second = true;
        } else {
            throw UsageError("unknown option '" + word + "'");
        }
    }
    if (arguments.quick && !runsGiven) arguments.runs = 1;
    return arguments;
}

std::string evaluationHelp(const std::string& defaultScenes) {
    return "tessera_evaluate measures again what the papers on Micropolis and on real-time Reyes subdivision measured,\n"
           "and writes a CSV file for each of their tables and figures. bench/evaluate.py makes tables and plots of them.\n"
           "\n"
           "  --list            List the trials: FIGURE/SCENE[@CAMERA]/MODE/METHOD/...\n"
           "  --filter REGEX    Run those whose name matches; with --list, list those\n"
           "  --runs N          Frames measured of each trial, 1 to 1000; medians are written [5; with --quick 1]\n"
           "  --limit SECONDS   Trials of one figure and view take turns; after so long none gets a further turn,\n"
           "                    but each has had one. The CSV tells how many frames were measured [10]\n"
           "  --quick           Small pictures and scenes: to see that the program works, not to measure\n"
           "  --city N          Patches of the city, about, 20000 to 20000000 [1000000; with --quick 20000]\n"
           "  --scenes DIR      Folder of .mscene files, if there is one\n"
           "                    [" +
           defaultScenes +
           "]\n"
           "  --device I        Number of the device in 'tessera devices' [the default one]\n"
           "  --out DIR         Folder of the CSV files, made if needed; files of the figures that run are replaced [evaluation]\n"
           "  --cache-dir DIR   Folder of compiled kernels [the user's]\n"
           "\n"
           "Each turn of a trial is a frame that is not measured and one that is, for a change of method or batch size moves\n"
           "buffers. A trial that fails is written with the error's text; the others go on.\n";
}

}  // namespace tessera::bench
