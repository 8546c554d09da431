// `tessera render`: a scene to a picture file, with statistics and a trace where asked for.
#include "choose_camera.h"
#include "commands.h"
#include "console.h"
#include "formats/image_file.h"
#include "formats/output_file.h"
#include "interrupt.h"
#include "load_scene.h"
#include "parse_values.h"
#include "picture_metadata.h"
#include "progress_line.h"
#include "render_arguments.h"
#include "stats_json.h"
#include "tessera/renderer.h"
#include "trace_json.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace tessera::program {

namespace {

struct Rendering {
    Frame frame;                  // the last picture with the median frame's statistics
    std::vector<double> frameMs;  // of all frames, in order
};

// Before the render, which may be long. The checks make files and remove them again.
void checkOutputs(const RenderArguments& arguments, Interrupt& interrupt) {
    const auto whole = interrupt.files();
    checkImagePath(arguments.output);
    checkStatsFile(arguments.stats);
    if (!arguments.trace.empty()) checkOutputFile(arguments.trace);
}

void writeText(const std::string& path, const std::string& text) { writeOutputFile(path, std::as_bytes(std::span(text))); }

std::size_t medianIndex(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    // Of an even number the lower one: the report is of a frame that was rendered.
    return order[(order.size() - 1) / 2];
}

Rendering renderFrames(Renderer& renderer, const Camera& camera, const RenderArguments& arguments) {
    ProgressLine line(!arguments.quiet, arguments.frames);
    RenderOptions options = arguments.options;
    options.trace = !arguments.trace.empty();
    Rendering rendering;
    std::vector<Statistics> statistics;
    for (int i = 0; i < arguments.frames; ++i) {
        // Without a line to show, the renderer need not look at its counts in between.
        Progress progress;
        if (line.enabled()) progress = [&](std::string_view stage, double fraction) { line.update(i, stage, fraction); };
        rendering.frame = renderer.render(camera, options, progress);
        rendering.frameMs.push_back(rendering.frame.statistics.frameMs);
        statistics.push_back(std::move(rendering.frame.statistics));
    }
    rendering.frame.statistics = std::move(statistics[medianIndex(rendering.frameMs)]);
    return rendering;
}

void printNotes(const LoadedScene& loaded, const ChosenCamera& chosen, const RenderArguments& arguments) {
    if (arguments.quiet) return;
    for (const std::string& warning : loaded.warnings) printNote(warning);
    if (!chosen.note.empty()) printNote(chosen.note);
    if (arguments.options.aovs != Aov::none && lowerEnding(arguments.output) != ".exr") {
        printNote(arguments.output + " will hold the colours alone: --aov needs an .exr file");
    }
}

std::string summary(const Rendering& rendering, const RenderArguments& arguments) {
    const Frame& frame = rendering.frame;
    const std::string samples = std::to_string(frame.statistics.pixelSamples);
    std::string text = std::to_string(frame.width) + "x" + std::to_string(frame.height);
    if (frame.width != frame.fullWidth || frame.height != frame.fullHeight) {
        text += " of " + std::to_string(frame.fullWidth) + "x" + std::to_string(frame.fullHeight);
    }
    text += ", " + samples + "x" + samples + " samples, " + fixed(frame.statistics.frameMs, 1) + " ms";
    if (arguments.frames > 1) text += " (median of " + std::to_string(arguments.frames) + ")";
    text += ", " + counted(frame.statistics.micropolygons, "micropolygon", "micropolygons") + ", on " + frame.statistics.device;
    return text + ", wrote " + arguments.output;
}

void writeOutputs(const Rendering& rendering, const LoadedScene& loaded, const Camera& camera, const std::string& commandLine,
                  const RenderArguments& arguments) {
    const Statistics& statistics = rendering.frame.statistics;
    writeImage(arguments.output, rendering.frame, pictureMetadata(commandLine, camera, arguments));
    if (!arguments.trace.empty()) writeText(arguments.trace, traceJson(statistics, loaded.scene.name));
    writeStats(arguments.stats, statsJson(statistics, loaded.scene.name, camera.name, rendering.frameMs, loaded.cages));
}

std::string nothingInSight(DiceMode mode) {
    if (mode == DiceMode::watertight) return "nothing is in sight; choose a camera by --camera or --look-at";
    return "nothing is in sight; what lies wholly beyond 1000 units is culled, so a large scene must be made smaller";
}

void render(RenderArguments arguments, const std::string& commandLine) {
    checkRenderArguments(arguments);
    Interrupt interrupt;
    checkOutputs(arguments, interrupt);
    const LoadedScene loaded = loadScene(arguments.scene, arguments.quiet);
    const ChosenCamera chosen = chooseCamera(loaded.scene, arguments.camera);
    if (arguments.dicingCamera) arguments.options.dicingCamera = namedCamera(loaded.scene, *arguments.dicingCamera, "--dicing-camera");
    Renderer renderer(arguments.settings);
    renderer.setScene(loaded.scene);
    printNotes(loaded, chosen, arguments);
    const Rendering rendering = renderFrames(renderer, chosen.camera, arguments);
    {
        const auto whole = interrupt.files();
        writeOutputs(rendering, loaded, chosen.camera, commandLine, arguments);
    }
    if (arguments.quiet) return;
    const Statistics& statistics = rendering.frame.statistics;
    if (statistics.patches > 0 && statistics.pixelsCovered == 0) printNote(nothingInSight(arguments.options.mode));
    printSummary(summary(rendering, arguments));
}

}  // namespace

Command addRenderCommand(CLI::App& app, const std::string& commandLine) {
    CLI::App* command = app.add_subcommand("render", "Render a scene to a picture file");
    command->get_formatter()->column_width(34);
    command->footer("Example: tessera render teapot -o teapot.exr --size 1920x1080 --aov Z,N --stats stats.json");
    const auto arguments = std::make_shared<RenderArguments>();
    addRenderOptions(*command, *arguments);
    return {command, [arguments, commandLine] { render(*arguments, commandLine); }};
}

}  // namespace tessera::program
