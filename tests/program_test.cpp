// The program `tessera` as its users meet it: what it prints and writes.
#include "program_fixture.h"
#include "tessera/options.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

namespace tessera::test {

namespace {

using nlohmann::json;

struct PictureSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

// From the header that every PNG file begins with.
PictureSize pngSize(const std::string& bytes) {
    const auto number = [&bytes](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = at; i < at + 4; ++i) value = value << 8U | static_cast<unsigned char>(bytes.at(i));
        return value;
    };
    EXPECT_EQ(bytes.substr(1, 3), "PNG");
    return {number(16), number(20)};
}

TEST_F(Program, HelpTellsEveryOptionWithItsDefault) {
    const Outcome outcome = run({"render", "--help"});
    expectSuccess(outcome);
    for (const std::string option :
         {"--output", "--size",        "--camera",         "--look-at",         "--fov",           "--method",
          "--batch",  "--mode",        "--shading-rate",   "--grid-size",       "--dicing-camera", "--weld-tolerance",
          "--flat",   "--split-bound", "--dice-rate",      "--max-depth",       "--background",    "--pixel-samples",
          "--crop",   "--aov",         "--device",         "--threads",         "--frames",        "--stats",
          "--trace",  "--quiet",       "--cull-backfaces", "--emulate-atomics", "--cache-dir",     "--memory",
          "--bucket", "--no-occlusion"}) {
        EXPECT_NE(outcome.out.find(option), std::string::npos) << option;
    }
    const RenderOptions defaults;
    EXPECT_NE(outcome.out.find("=" + std::to_string(defaults.width) + "x" + std::to_string(defaults.height)), std::string::npos);
    EXPECT_NE(outcome.out.find("=" + std::to_string(defaults.batch)), std::string::npos);
    EXPECT_NE(outcome.out.find("=" + std::string(name(defaults.method))), std::string::npos);
    EXPECT_NE(outcome.out.find("=" + std::string(name(defaults.mode))), std::string::npos);
}

// What stands under a heading of the help: up to the next empty line.
std::string helpUnder(const std::string& help, const std::string& heading) {
    const std::size_t from = help.find("\n" + heading + ":\n");
    return from == std::string::npos ? "" : help.substr(from, help.find("\n\n", from) - from);
}

TEST_F(Program, HelpTellsWhichOptionsBelongToWhichMode) {
    const std::string help = run({"render", "--help"}).out;
    for (const std::string option : {"--shading-rate", "--grid-size", "--dicing-camera"}) {
        EXPECT_NE(helpUnder(help, "Watertight mode").find(option), std::string::npos) << option;
    }
    for (const std::string option : {"--split-bound", "--dice-rate", "--max-depth"}) {
        EXPECT_NE(helpUnder(help, "Classical mode").find(option), std::string::npos) << option;
    }
}

TEST_F(Program, EveryCommandHasHelpAndTheProgramAVersion) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--help"}, {"info", "--help"}, {"devices", "-h"}, {"--version"}}) {
        const Outcome outcome = run(arguments);
        expectSuccess(outcome);
        EXPECT_FALSE(outcome.out.empty());
        EXPECT_EQ(outcome.err, "");
    }
}

TEST_F(Program, InfoTellsWhatASceneHolds) {
    const Outcome outcome = run({"info", "teapot", "--json"});
    expectSuccess(outcome);
    const json info = json::parse(outcome.out);
    const Scene teapot = builtinScene("teapot");
    EXPECT_EQ(info.at("patches"), teapot.placedPatchCount());
    EXPECT_EQ(info.at("patch_types").at("bezier"), teapot.placedPatchCount());
    EXPECT_EQ(info.at("cameras").size(), teapot.cameras.size());
    EXPECT_EQ(info.at("lights").size(), teapot.lights.size());
    EXPECT_EQ(info.at("objects").size(), teapot.objects.size());
    EXPECT_FLOAT_EQ(info.at("bounds").at("upper").at(1).get<float>(), worldBounds(teapot).upper.y);
    const Outcome text = run({"info", "teapot"});
    expectSuccess(text);
    EXPECT_NE(text.out.find("'" + teapot.cameras.front().name + "'"), std::string::npos) << text.out;
}

TEST_F(Program, InfoKeepsNamesFromDrivingTheTerminal) {
    Scene scene = builtinScene("teapot");
    scene.cameras.front().name = "a\nb\x1b[2Jc";
    write("odd.mscene", scene);
    const Outcome text = run({"info", "odd.mscene"});
    expectSuccess(text);
    EXPECT_EQ(text.out.find('\x1b'), std::string::npos);
    EXPECT_EQ(text.out.find("a\nb"), std::string::npos);
    EXPECT_TRUE(json::accept(run({"info", "odd.mscene", "--json"}).out));
}

TEST_F(Program, InfoTellsThePlanThatTheOptionsLeadTo) {
    const std::vector<std::string> arguments{"info",   "teapot",   "--plan", "--size",  "640x360",  "--pixel-samples",
                                             "3",      "--memory", "100",    "--batch", "500",      "--bucket",
                                             "100x64", "--aov",    "Z",      "--crop",  "0,1,0,0.5"};
    std::vector<std::string> asJson = arguments;
    asJson.emplace_back("--json");
    const Outcome outcome = run(asJson);
    expectSuccess(outcome);
    const json plan = json::parse(outcome.out).at("plan");
    EXPECT_EQ(plan.at("budget"), 100U << 20);
    EXPECT_EQ(plan.at("batch"), 500);
    EXPECT_EQ(plan.at("stack_capacity"), 25 * 500);
    EXPECT_EQ(plan.at("bucket_width"), 102);
    EXPECT_EQ(plan.at("bucket_height"), 66);
    EXPECT_EQ(plan.at("buckets_x"), 7);
    EXPECT_EQ(plan.at("buckets_y"), 3);
    EXPECT_EQ(plan.at("chunks"), 1);
    EXPECT_EQ(plan.at("device_bytes").at("picture"), 102 * 66 * 5 * 4);
    std::uint64_t sum = 0;
    for (const auto& [purpose, bytes] : plan.at("device_bytes").items()) sum += bytes.get<std::uint64_t>();
    EXPECT_EQ(plan.at("bytes"), sum);
    EXPECT_FALSE(json::parse(run({"info", "teapot", "--json"}).out).contains("plan"));
    const Outcome text = run(arguments);
    expectSuccess(text);
    EXPECT_NE(text.out.find("budget of 100.0 MiB"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("7x3 buckets of at most 102x66 pixels"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("resident"), std::string::npos) << text.out;
}

TEST_F(Program, TheLeastMemoryThatAnErrorNamesDoes) {
    const std::vector<std::string> frame{"info", "teapot", "--plan", "--json", "--batch", "40000", "--memory"};
    const auto planned = [&](const std::string& mebibytes) {
        std::vector<std::string> arguments = frame;
        arguments.push_back(mebibytes);
        return run(arguments);
    };
    const Outcome refused = planned("2");
    expectOneLineError(refused, 1);
    const std::size_t from = refused.err.find("--memory ") + 9;
    const int least = std::stoi(refused.err.substr(from));
    expectSuccess(planned(std::to_string(least)));
    expectOneLineError(planned(std::to_string(least - 1)), 1);
}

TEST_F(Program, DevicesListsADefaultDevice) {
    const Outcome outcome = run({"devices", "--json"});
    expectSuccess(outcome);
    const json devices = json::parse(outcome.out).at("devices");
    EXPECT_EQ(std::count_if(devices.begin(), devices.end(), [](const json& device) { return device.at("default").get<bool>(); }), 1);
    expectSuccess(run({"devices"}));
}

TEST_F(Program, WithoutAnyDeviceItSaysWhatToInstall) {
    const RunningProgram::Environment noDrivers{{"OCL_ICD_VENDORS", folder_.path().string()}};
    const Outcome listed = run({"devices"}, noDrivers);
    expectOneLineError(listed, 1);
    EXPECT_NE(listed.err.find("pocl-opencl-icd"), std::string::npos);
    expectOneLineError(run({"render", "teapot", "-o", "k.png"}, noDrivers), 1);
    EXPECT_EQ(json::parse(run({"devices", "--json"}, noDrivers).out).at("devices").size(), 0U);
    EXPECT_EQ(folder_.fileNames().size(), 0U);
}

TEST_F(Program, StatsHoldEveryPromisedField) {
    expectSuccess(renderTeapot({"-o", "k.png", "--frames", "3", "--stats", "stats.json", "--batch", "5000"}));
    const json stats = json::parse(file("stats.json"));
    for (const std::string field : {"device", "mode", "method", "scene", "camera", "version"})
        EXPECT_TRUE(stats.at(field).is_string()) << field;
    for (const std::string field : {"width",           "height",           "shading_rate",  "grid_size",         "batch",
                                    "patches",         "ranges_processed", "ranges_diced",  "ranges_culled",     "stack_peak",
                                    "iterations",      "batches",          "micropolygons", "pixels_covered",    "pixel_samples",
                                    "split_ms",        "frame_ms",         "build_ms",      "device_bytes_peak", "device_bytes_budget",
                                    "ranges_occluded", "patches_skipped",  "buckets",       "bucket_width",      "bucket_height",
                                    "chunks",          "streamed_bytes",   "stack_growths", "launches",          "host_waits"}) {
        EXPECT_TRUE(stats.at(field).is_number()) << field;
    }
    EXPECT_EQ(stats.at("width"), 96);
    EXPECT_EQ(stats.at("height"), 54);
    EXPECT_EQ(stats.at("batch"), 5000);
    EXPECT_EQ(stats.at("method"), "bounded");
    EXPECT_EQ(stats.at("patches"), 32);
    EXPECT_GT(stats.at("pixels_covered").get<int>(), 0);
    EXPECT_FALSE(stats.at("kernel_ms").empty());
    EXPECT_TRUE(stats.at("group_ranges").is_array());
    EXPECT_TRUE(stats.at("device_bytes").is_object());
}

TEST_F(Program, FramesReportTheMedianFrame) {
    const Outcome outcome = renderTeapot({"-o", "k.png", "--frames", "5", "--stats", "-"});
    expectSuccess(outcome);
    const json stats = json::parse(outcome.out);
    auto times = stats.at("frame_ms_all").get<std::vector<double>>();
    ASSERT_EQ(times.size(), 5U);
    std::sort(times.begin(), times.end());
    EXPECT_EQ(stats.at("frame_ms").get<double>(), times[2]);
}

TEST_F(Program, TraceHoldsEveryKernelOnTracksWithoutOverlap) {
    expectSuccess(renderTeapot({"-o", "k.png", "--trace", "trace.json", "--stats", "stats.json"}));
    const json events = json::parse(file("trace.json")).at("traceEvents");
    std::map<int, std::vector<std::pair<double, double>>> tracks;
    std::set<std::string> executed;
    std::set<std::string> trackNames;
    for (const json& event : events) {
        if (event.at("ph") == "M") trackNames.insert(event.at("args").at("name"));
        if (event.at("ph") != "X") continue;
        const double start = event.at("ts");
        tracks[event.at("tid")].emplace_back(start, start + event.at("dur").get<double>());
        if (event.at("cat") != "queue") executed.insert(event.at("name"));
    }
    for (const std::string wanted : {"queue", "kernels", "transfers"}) EXPECT_TRUE(trackNames.contains(wanted)) << wanted;
    const json stats = json::parse(file("stats.json"));
    for (const auto& [kernel, milliseconds] : stats.at("kernel_ms").items()) EXPECT_TRUE(executed.contains(kernel)) << kernel;
    for (auto& [track, slices] : tracks) {
        std::sort(slices.begin(), slices.end());
        for (std::size_t i = 1; i < slices.size(); ++i) EXPECT_LE(slices[i - 1].second, slices[i].first + 0.002) << "track " << track;
    }
}

TEST_F(Program, CropWritesTheWindowAlone) {
    expectSuccess(renderTeapot({"-o", "k.png", "--crop", "0.25,0.75,0.5,1"}));
    const PictureSize size = pngSize(file("k.png"));
    EXPECT_EQ(size.width, 48U);
    EXPECT_EQ(size.height, 27U);
}

TEST_F(Program, QuietPrintsNothing) {
    Scene scene = builtinScene("teapot");
    scene.cameras.clear();
    write("blind.mscene", scene);
    // From no caches at all: a driver's compiler must have nothing to say about the kernels either.
    const ScratchFolder cold;
    const RunningProgram::Environment noCaches{{"TESSERA_CACHE", cold.path().string()}, {"POCL_CACHE_DIR", cold.path().string()}};
    const Outcome quiet = run({"render", "blind.mscene", "-o", "k.png", "--size", "32x18", "--aov", "Z", "--quiet"}, noCaches);
    expectSuccess(quiet);
    EXPECT_EQ(quiet.out + quiet.err, "");
    // And without it, the same has something to tell.
    const Outcome told = run({"render", "blind.mscene", "-o", "k.png", "--size", "32x18", "--aov", "Z"});
    expectSuccess(told);
    EXPECT_EQ(told.errorLines(), 3U) << told.err;
    EXPECT_NE(told.err.find("no camera"), std::string::npos) << told.err;
    EXPECT_NE(told.err.find("32x18"), std::string::npos) << told.err;
}

TEST_F(Program, LookAtMovesTheCameraAndNegativeNumbersAreNoOptions) {
    expectSuccess(renderTeapot({"-o", "front.png", "--stats", "front.json"}));
    expectSuccess(renderTeapot({"-o", "away.png", "--look-at", "-.5,20,0,-1,40,0", "--stats", "away.json"}));
    EXPECT_GT(json::parse(file("front.json")).at("pixels_covered"), 0);
    EXPECT_EQ(json::parse(file("away.json")).at("pixels_covered"), 0);
    EXPECT_EQ(json::parse(file("away.json")).at("camera"), "look-at");
}

TEST_F(Program, FovOverridesTheCameras) {
    expectSuccess(renderTeapot({"-o", "a.png", "--stats", "narrow.json"}));
    expectSuccess(renderTeapot({"-o", "b.png", "--stats", "wide.json", "--fov", "100"}));
    EXPECT_GT(json::parse(file("narrow.json")).at("pixels_covered"), json::parse(file("wide.json")).at("pixels_covered"));
}

TEST_F(Program, ASceneWithoutPatchesGivesTheBackgroundAndANote) {
    Scene scene = builtinScene("teapot");
    scene.objects.clear();
    write("bare.mscene", scene);
    const Outcome outcome = run({"render", "bare.mscene", "-o", "k.png", "--size", "32x18"});
    expectSuccess(outcome);
    EXPECT_NE(outcome.err.find("no patches"), std::string::npos) << outcome.err;
    EXPECT_EQ(pngSize(file("k.png")).width, 32U);
    EXPECT_EQ(folder_.fileNames(), (std::set<std::string>{"bare.mscene", "k.png"}));
}

TEST_F(Program, AFailedRenderLeavesTheOldPictureAlone) {
    writeFile(folder_.path() / "k.png", "old");
    expectOneLineError(renderTeapot({"-o", "k.png", "--camera", "none such"}), 1);
    EXPECT_EQ(file("k.png"), "old");
    EXPECT_EQ(folder_.fileNames().size(), 1U);
}

TEST_F(Program, InterruptEndsItWithoutFiles) {
    RunningProgram program = start({"render", "teapot", "-o", "k.png", "--frames", "100000", "--stats", "s.json"});
    // Long enough to be within a frame on any machine; where it is not, the outcome is the same.
    std::this_thread::sleep_for(std::chrono::seconds(1));
    program.send(SIGINT);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.signal, SIGINT) << outcome.err;
    EXPECT_EQ(folder_.fileNames().size(), 0U);
}

}  // namespace

}  // namespace tessera::test
