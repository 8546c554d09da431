// The evaluation without a device: which trials there are, who takes turns, what is written of them.
#include "evaluation/camera_path.h"
#include "evaluation/measure.h"
#include "evaluation/results.h"
#include "run_program.h"
#include "tessera/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>

namespace tessera::bench {

namespace {

std::vector<Group> allGroups() { return planGroups(evaluationScenes("", GeneratedCounts{}), PlanSizes{}, ""); }

std::vector<std::string> namesOf(const std::vector<Group>& groups) {
    std::vector<std::string> names;
    for (const Group& group : groups) {
        for (const Trial& trial : group.trials) names.push_back(name(trial));
    }
    return names;
}

// The fields of a CSV file, row by row, quotes taken off.
std::vector<std::vector<std::string>> readCsv(const std::string& text) {
    std::vector<std::vector<std::string>> rows;
    std::vector<std::string> row(1);
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char letter = text[i];
        if (quoted && letter == '"' && i + 1 < text.size() && text[i + 1] == '"') {
            row.back() += text[++i];
        } else if (letter == '"') {
            quoted = !quoted;
        } else if (!quoted && letter == ',') {
            row.emplace_back();
        } else if (!quoted && letter == '\n') {
            rows.push_back(std::exchange(row, {""}));
        } else {
            row.back() += letter;
        }
    }
    return rows;
}

Group twoTrials() {
    Trial breadth{.figure = "figure", .view = {"scene", ""}, .along = {}, .options = {}};
    breadth.options.method = SplitMethod::breadth;
    Trial bounded = breadth;
    bounded.options.method = SplitMethod::bounded;
    return {"figure", {"scene", ""}, {breadth, bounded}};
}

TEST(EvaluationPlan, NamesEveryTrialOnce) {
    const std::vector<std::string> names = namesOf(allGroups());
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
}

TEST(EvaluationPlan, HoldsEveryFigureOfThePapers) {
    std::set<std::string> figures;
    for (const Group& group : allGroups()) figures.insert(group.figure);
    EXPECT_EQ(figures,
              (std::set<std::string>{"thesis_table_7_2", "thesis_figure_7_1", "thesis_figure_7_2_3", "thesis_figure_7_4",
                                     "thesis_figure_7_5", "patney_figure_6", "patney_figure_7", "patney_figure_8", "occlusion", "budget"}));
}

TEST(EvaluationPlan, LoadsEverySceneOnlyOnce) {
    std::set<std::string> left;
    std::string current;
    for (const Group& group : allGroups()) {
        if (group.view.scene == current) continue;
        EXPECT_TRUE(left.insert(group.view.scene).second) << group.view.scene;
        current = group.view.scene;
    }
}

TEST(EvaluationPlan, AsksForFramesThatTheRendererAccepts) {
    for (const bool quick : {false, true}) {
        const EvaluationScenes scenes = evaluationScenes("", quick ? quickCounts() : GeneratedCounts{});
        for (const Group& group : planGroups(scenes, quick ? quickSizes() : PlanSizes{}, "")) {
            for (const Trial& trial : group.trials) EXPECT_NO_THROW(trial.options.validate()) << name(trial);
        }
    }
}

TEST(EvaluationPlan, MeasuresTheTableInBothModesWithTheThesisBatchSizes) {
    std::map<DiceMode, std::set<std::pair<SplitMethod, std::uint32_t>>> found;
    for (const Group& group : allGroups()) {
        if (group.figure != "thesis_table_7_2" || group.view != View{"city", "spike"}) continue;
        for (const Trial& trial : group.trials) found[trial.options.mode].emplace(trial.options.method, trial.options.batch);
    }
    const std::set<std::pair<SplitMethod, std::uint32_t>> expected{
        {SplitMethod::breadth, 0}, {SplitMethod::bounded, 10000}, {SplitMethod::bounded, 40000}, {SplitMethod::bounded, 200000}};
    EXPECT_EQ(found[DiceMode::classical], expected);
    EXPECT_EQ(found[DiceMode::watertight], expected);
}

TEST(EvaluationPlan, FiltersTrialsByName) {
    const std::vector<std::string> all = namesOf(allGroups());
    const std::vector<std::string> some = namesOf(planGroups(evaluationScenes("", GeneratedCounts{}), PlanSizes{}, "^budget/.*/64MiB$"));
    EXPECT_EQ(some.size(), 3U);
    for (const std::string& wanted : some) EXPECT_NE(std::find(all.begin(), all.end(), wanted), all.end()) << wanted;
}

TEST(EvaluationMeasure, LetsTrialsTakeTurns) {
    std::vector<SplitMethod> order;
    const auto measured = measure(twoTrials(), 2, 1e9, [&](const Trial& trial) {
        order.push_back(trial.options.method);
        Statistics statistics;
        statistics.frameMs = static_cast<double>(order.size());
        return statistics;
    });
    const SplitMethod a = SplitMethod::breadth;
    const SplitMethod b = SplitMethod::bounded;
    EXPECT_EQ(order, (std::vector<SplitMethod>{a, a, b, b, a, a, b, b}));
    // The second frame of a turn is the one that counts.
    ASSERT_EQ(measured[0].frames.size(), 2U);
    EXPECT_EQ(measured[0].frames[0].frameMs, 2.0);
    EXPECT_EQ(measured[1].frames[1].frameMs, 8.0);
}

TEST(EvaluationMeasure, GivesEachTrialOneTurnWhateverTheLimit) {
    const auto measured = measure(twoTrials(), 5, 0.0, [](const Trial&) { return Statistics{}; });
    EXPECT_EQ(measured[0].frames.size(), 1U);
    EXPECT_EQ(measured[1].frames.size(), 1U);
}

TEST(EvaluationMeasure, TakesASingleFrameWhereCountsAreWanted) {
    Group group = twoTrials();
    group.trials[0].once = true;
    int frames = 0;
    static_cast<void>(measure(group, 3, 1e9, [&](const Trial& trial) {
        frames += trial.once ? 1 : 0;
        return Statistics{};
    }));
    EXPECT_EQ(frames, 1);
}

TEST(EvaluationMeasure, GoesOnAfterATrialThatFails) {
    int failures = 0;
    const auto measured = measure(twoTrials(), 3, 1e9, [&](const Trial& trial) {
        if (trial.options.method == SplitMethod::breadth) {
            ++failures;
            throw Error("out of memory: needs 3 GiB, \"really\"");
        }
        return Statistics{};
    });
    EXPECT_EQ(failures, 1);
    EXPECT_EQ(measured[0].error, "out of memory: needs 3 GiB, \"really\"");
    EXPECT_EQ(measured[1].frames.size(), 3U);
}

TEST(EvaluationMeasure, TakesTheMiddleAsTheMedian) {
    EXPECT_EQ(median({5.0, 1.0, 100.0}), 5.0);
    EXPECT_EQ(median({4.0, 1.0, 100.0, 2.0}), 3.0);
}

TEST(EvaluationResults, KeepCommasQuotesAndLineBreaksInsideAField) {
    const std::vector<std::string> fields{"plain", "a,b", "say \"this\"", "two\nlines", ""};
    const auto rows = readCsv(csvLine(fields));
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows.front(), fields);
    EXPECT_EQ(csvLine(std::vector<std::string>{"", "b"}), ",b\n");
}

std::string field(const std::vector<std::string>& row, const std::string& column) {
    const std::vector<std::string> columns = resultColumns();
    const auto place = std::find(columns.begin(), columns.end(), column);
    return place == columns.end() ? "no column " + column : row.at(static_cast<std::size_t>(place - columns.begin()));
}

TEST(EvaluationResults, WriteMediansOfTimesAndTheStagesShares) {
    Measured measured{twoTrials().trials.back(), {}, {}};
    for (const double frameMs : {30.0, 10.0, 20.0}) {
        Statistics statistics;
        statistics.frameMs = frameMs;
        statistics.splitMs = 3.0;
        statistics.kernelMs = {{"split_bound", 3.0}, {"dice_hide", 4.0}, {"shade_tiles", 1.0}, {"read", 0.5}};
        statistics.rangesProcessed = 12345678901;
        statistics.deviceBytes = {{"queues", 77}};
        measured.frames.push_back(statistics);
    }
    const std::vector<std::string> row = resultRow(measured, "a device");
    ASSERT_EQ(row.size(), resultColumns().size());
    EXPECT_EQ(field(row, "frame_ms"), "20");
    EXPECT_EQ(field(row, "frame_ms_least"), "10");
    EXPECT_EQ(field(row, "frame_ms_most"), "30");
    EXPECT_EQ(field(row, "dice_ms"), "4");
    EXPECT_EQ(field(row, "other_ms"), "0.5");
    EXPECT_EQ(field(row, "idle_ms"), "11.5");
    EXPECT_EQ(field(row, "processed"), "12345678901");
    EXPECT_EQ(field(row, "queue_bytes"), "77");
    EXPECT_EQ(field(row, "device"), "a device");
    EXPECT_EQ(field(row, "error"), "");
}

TEST(EvaluationResults, WriteAFailedTrialWithItsErrorAndNoNumbers) {
    const Measured measured{twoTrials().trials.front(), {}, "out of memory: needs 3 GiB"};
    const std::vector<std::string> row = resultRow(measured, "a device");
    ASSERT_EQ(row.size(), resultColumns().size());
    EXPECT_EQ(field(row, "method"), "breadth");
    EXPECT_EQ(field(row, "frames"), "0");
    EXPECT_EQ(field(row, "frame_ms"), "");
    EXPECT_EQ(field(row, "picture_bytes"), "");
    EXPECT_EQ(field(row, "device"), "a device");
    EXPECT_EQ(field(row, "error"), "out of memory: needs 3 GiB");
}

TEST(EvaluationResults, WriteARowAWorkGroupWhereTheLoadIsWanted) {
    const test::ScratchFolder folder;
    Measured measured{twoTrials().trials.front(), {Statistics{}}, {}};
    measured.trial.load = true;
    measured.frames.back().groupRanges = {5, 9};
    ResultFiles files(folder.path(), DeviceInfo{}, {});
    files.add(std::vector<Measured>{measured, measured});
    const auto loads = readCsv(test::readFile(folder.path() / "figure_load.csv"));
    ASSERT_EQ(loads.size(), 5U);
    EXPECT_EQ(loads[0][5], "ranges");
    EXPECT_EQ(loads[2][4], "1");
    EXPECT_EQ(loads[2][5], "9");
    EXPECT_EQ(readCsv(test::readFile(folder.path() / "figure.csv")).size(), 3U);
}

TEST(CameraPath, PassesThroughItsCamerasAndBetweenThem) {
    std::array<Camera, 3> cameras;
    cameras[1].transform.translation = {2.0F, 0.0F, 0.0F};
    cameras[1].transform.rotation = glm::angleAxis(1.0F, glm::vec3(0.0F, 1.0F, 0.0F));
    cameras[1].fovy = 65.0F;
    cameras[2].transform.translation = {2.0F, 4.0F, 0.0F};
    for (const std::size_t i : {0U, 1U, 2U}) {
        const Camera camera = cameraAlong(cameras, 0.5 * static_cast<double>(i));
        EXPECT_EQ(camera.transform.translation, cameras.at(i).transform.translation) << i;
        EXPECT_EQ(camera.transform.rotation, cameras.at(i).transform.rotation) << i;
    }
    const Camera between = cameraAlong(cameras, 0.25);
    EXPECT_FLOAT_EQ(between.transform.translation.x, 1.0F);
    EXPECT_FLOAT_EQ(between.fovy, 55.0F);
    EXPECT_NEAR(glm::angle(between.transform.rotation), 0.5F, 1e-5F);
    EXPECT_FLOAT_EQ(cameraAlong(cameras, 0.75).transform.translation.y, 2.0F);
}

// The program as a whole, on the device that there is.
TEST(EvaluateProgram, WritesAFigureWithAllColumnsAndItsDevice) {
    const test::ScratchFolder folder;
    test::RunningProgram program(TESSERA_EVALUATE_PATH,
                                 {"--quick", "--filter", "^patney_figure_7/", "--scenes", "none", "--out", "results"}, folder.path(),
                                 {{"TESSERA_CACHE", TESSERA_TEST_CACHE}});
    const test::Outcome outcome = program.wait();
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto rows = readCsv(test::readFile(folder.path() / "results" / "patney_figure_7.csv"));
    ASSERT_EQ(rows.size(), 5U);
    EXPECT_EQ(rows.front(), resultColumns());
    const std::string device = readCsv(test::readFile(folder.path() / "results" / "machine.csv")).at(1).at(1);
    EXPECT_FALSE(device.empty());
    for (std::size_t i = 1; i < rows.size(); ++i) {
        EXPECT_EQ(field(rows[i], "device"), device);
        EXPECT_EQ(field(rows[i], "error"), "");
        EXPECT_GT(std::stod(field(rows[i], "frame_ms")), 0.0);
        EXPECT_GT(std::stoul(field(rows[i], "processed")), 0U);
    }
}

TEST(EvaluateProgram, RefusesBadOptionsInALine) {
    const test::ScratchFolder folder;
    const std::vector<std::vector<std::string>> bad{
        {"--runs", "0"}, {"--runs"}, {"--filter", "("}, {"--list", "--filter", "no such trial"}, {"--nonsense"}};
    for (const std::vector<std::string>& arguments : bad) {
        test::RunningProgram program(TESSERA_EVALUATE_PATH, arguments, folder.path(), {});
        const test::Outcome outcome = program.wait();
        EXPECT_EQ(outcome.exitCode, 2) << arguments.front();
        EXPECT_EQ(outcome.errorLines(), 1U) << outcome.err;
        EXPECT_TRUE(outcome.err.starts_with("tessera_evaluate: error: ")) << outcome.err;
    }
}

}  // namespace

}  // namespace tessera::bench
