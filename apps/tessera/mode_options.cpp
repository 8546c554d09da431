// The options that choose a mode, and those that only one mode looks at.
#include "mode_options.h"

#include "add_options.h"
#include "commands.h"
#include "console.h"

#include <functional>
#include <utility>

namespace tessera::program {

namespace {

// Adds options of one mode, which are remembered when they are given.
class ModeGroup {
public:
    ModeGroup(CLI::App& app, RenderArguments& arguments, DiceMode mode, std::string heading)
        : app_(app), arguments_(arguments), mode_(mode), heading_(std::move(heading)) {}

    CLI::Option* add(const std::string& option, std::function<void(const std::string&)> read, const std::string& description) const {
        const auto noted = [&arguments = arguments_, mode = mode_, option, read = std::move(read)](const std::string& text) {
            read(text);
            arguments.modeOptions.emplace_back(option, mode);
        };
        return addParsed(app_, option, noted, description)->group(heading_);
    }

    void addFlag(const std::string& option, std::function<void()> set, const std::string& description) const {
        const auto noted = [&arguments = arguments_, mode = mode_, option, set = std::move(set)] {
            set();
            arguments.modeOptions.emplace_back(option, mode);
        };
        app_.add_flag_callback(option, noted, description)->group(heading_);
    }

    template <typename Number>
    CLI::Option* addWhole(const std::string& option, Number& value, Range range, const std::string& description) const {
        const auto read = [&value, range](const std::string& text) {
            value = static_cast<Number>(parseWhole(text, range.least, range.most));
        };
        return add(option, read, description)->default_str(std::to_string(value));
    }

private:
    CLI::App& app_;
    RenderArguments& arguments_;
    DiceMode mode_;
    std::string heading_;
};

void addShadingRate(const ModeGroup& group, RenderOptions& options) {
    group
        .add(
            "--shading-rate", [&options](const std::string& text) { options.shadingRate = parseNumber(text); },
            "Greatest area of a micropolygon in pixels, 0.0625 to 65536")
        ->type_name("A")
        ->default_str(shortest(options.shadingRate));
}

void addSplitBound(const ModeGroup& group, RenderOptions& options) {
    group
        .add(
            "--split-bound", [&options](const std::string& text) { options.splitBound = parseNumber(text); },
            "Pixels, 0.25 to 65536: a range no longer than this either way is diced")
        ->type_name("PX")
        ->default_str(shortest(options.splitBound));
}

void addWatertightOptions(const ModeGroup& group, RenderArguments& arguments, ModeOptions which) {
    RenderOptions& options = arguments.options;
    if (which == ModeOptions::all) addShadingRate(group, options);
    group.addWhole("--grid-size", options.gridSize, {1, 32}, "Most micropolygons along an edge of a range: 1, 2, 4, 8, 16 or 32")
        ->type_name("N");
    group
        .add(
            "--dicing-camera", [&arguments](const std::string& text) { arguments.dicingCamera = text; },
            "A camera of the scene that micropolygons are made for; without it the\none that the picture is taken by")
        ->type_name("NAME");
    group.addFlag(
        "--no-occlusion", [&options] { options.occlusion = false; }, "Split what lies behind what is drawn already, too: the same picture");
}

void addClassicalOptions(const ModeGroup& group, RenderOptions& options, ModeOptions which) {
    if (which == ModeOptions::all) addSplitBound(group, options);
    group.addWhole("--dice-rate", options.diceRate, {1, 32}, "Micropolygons along each side of a range, 1 to 32")->type_name("N");
    group.addWhole("--max-depth", options.maxDepth, {0, 24}, "Splits after which a range is diced whatever its size, 0 to 24")
        ->type_name("K");
}

}  // namespace

void addModeOptions(CLI::App& app, RenderArguments& arguments, ModeOptions which) {
    RenderOptions& options = arguments.options;
    addParsed(
        app, "--mode", [&options](const std::string& text) { options.mode = parseMode(text); },
        "What splitting and dicing decide by: watertight (rates that neighbours\nshare along their edges: no cracks), classical (halves at "
        "one fixed\nrate, as Micropolis did)")
        ->type_name("NAME")
        ->default_str(std::string(name(options.mode)));
    addWatertightOptions({app, arguments, DiceMode::watertight, "Watertight mode"}, arguments, which);
    addClassicalOptions({app, arguments, DiceMode::classical, "Classical mode"}, options, which);
}

void checkModeOptions(const RenderArguments& arguments) {
    const DiceMode chosen = arguments.options.mode;
    for (const auto& [option, mode] : arguments.modeOptions) {
        if (mode == chosen) continue;
        const std::string own(name(mode));
        throw UsageError(option + " belongs to " + own + " mode and does nothing in " + std::string(name(chosen)) +
                         " mode: leave it out, or choose --mode " + own);
    }
}

}  // namespace tessera::program
