// The program under memory budgets: what it refuses and how, what it accepts, and that an interrupted frame leaves nothing.
#include "program_fixture.h"

#include "device/memory.h"
#include "tessera/error.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <regex>
#include <set>
#include <string>
#include <thread>

namespace tessera::test {
namespace {

TEST_F(Program, ABudgetTooSmallIsRefusedWithTheLeastThatWouldDoAndThatDoes) {
    const std::vector<std::string> frame{"render", "teapot", "-o", "k.png", "--size", "320x180", "--batch", "5000", "--memory"};
    const auto within = [&](const std::string& mebibytes) {
        std::vector<std::string> arguments = frame;
        arguments.push_back(mebibytes);
        return run(arguments);
    };
    const Outcome refused = within("1");
    expectOneLineError(refused, 1);
    EXPECT_EQ(folder_.fileNames().size(), 0U);
    std::smatch found;
    ASSERT_TRUE(std::regex_search(refused.err, found, std::regex("--memory ([0-9]+) would do"))) << refused.err;
    const int least = std::stoi(found[1]);
    EXPECT_GT(least, 1);
    expectOneLineError(within(std::to_string(least - 1)), 1);
    EXPECT_EQ(folder_.fileNames().size(), 0U);
    expectSuccess(within(std::to_string(least)));
    EXPECT_EQ(folder_.fileNames(), std::set<std::string>{"k.png"});
}

TEST_F(Program, StatisticsNameTheBudgetAndThePeakByPurpose) {
    expectSuccess(renderTeapot({"-o", "k.png", "--stats", "s.json", "--memory", "64"}));
    const nlohmann::json stats = nlohmann::json::parse(file("s.json"));
    EXPECT_EQ(stats.at("device_bytes_budget"), 64 << 20);
    EXPECT_GT(stats.at("device_bytes_peak"), 0);
    EXPECT_LE(stats.at("device_bytes_peak"), 64 << 20);
}

TEST_F(Program, BucketsAndMethodsGiveTheSameFile) {
    expectSuccess(renderTeapot({"-o", "k.png"}));
    const std::string whole = file("k.png");
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--bucket", "32x16"},
                                                 {"--no-occlusion"},
                                                 {"--method", "local"},
                                                 {"--method", "cpu", "--bucket", "17x9"},
                                                 {"--method", "breadth"},
                                                 {"--memory", "8"}}) {
        SCOPED_TRACE(more[0] + " " + more.back());
        std::vector<std::string> arguments{"-o", "part.png"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expectSuccess(renderTeapot(arguments));
        EXPECT_TRUE(file("part.png") == whole);
    }
}

// Over a billion samples in 900 buckets, minutes of work: it ends at once or the test does not end in time.
TEST_F(Program, AFrameInBucketsThatIsInterruptedLeavesNoFile) {
    RunningProgram program = start({"render", "teapot", "-o", "k.png", "--size", "3840x3840", "--pixel-samples", "16", "--bucket",
                                    "128x128", "--stats", "s.json", "--trace", "t.json"});
    std::this_thread::sleep_for(std::chrono::seconds(2));
    program.send(SIGINT);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.signal, SIGINT) << outcome.err;
    EXPECT_EQ(folder_.fileNames().size(), 0U);
}

TEST(DeviceMemoryOfABudget, SaysWhatWasAskedForAndForWhatAndCountsNothingOfIt) {
    const OpenDevice device = openDevice(-1, 0);
    DeviceMemory memory(device);
    memory.setBudget(4096);
    const DeviceBuffer held = memory.allocate(Purpose::film, "the samples", 3000);
    try {
        static_cast<void>(memory.allocate(Purpose::queues, "the stack of ranges", 1097));
        FAIL() << "4097 bytes of 4096 were given";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("the stack of ranges"), std::string::npos) << text;
        EXPECT_NE(text.find("1097 bytes"), std::string::npos) << text;
        EXPECT_NE(text.find("3000 bytes"), std::string::npos) << text;
        EXPECT_NE(text.find("4096 bytes"), std::string::npos) << text;
        EXPECT_NE(text.find("--memory"), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos);
    }
    EXPECT_EQ(memory.bytes(), 3000U);
    EXPECT_EQ(memory.allocate(Purpose::queues, "the stack of ranges", 1096).bytes(), 1096U);
    EXPECT_EQ(memory.peakBytes(), 4096U);
    EXPECT_EQ(memory.peakUse().film, 3000U);
    EXPECT_EQ(memory.peakUse().queues, 1096U);
    EXPECT_EQ(memory.bytes(), 3000U);
}

// More than any device holds, whatever the budget.
TEST(DeviceMemoryOfABudget, ADeviceThatHoldsTooLittleIsNamed) {
    const OpenDevice device = openDevice(-1, 0);
    DeviceMemory memory(device);
    memory.setBudget(~std::uint64_t{0});
    try {
        static_cast<void>(memory.allocate(Purpose::scene, "the patches", std::uint64_t{1} << 60));
        FAIL() << "an exbibyte was given";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("the patches"), std::string::npos) << text;
        EXPECT_NE(text.find("1152921504606846976 bytes"), std::string::npos) << text;
        EXPECT_NE(text.find(device.info.name), std::string::npos) << text;
    }
    EXPECT_EQ(memory.bytes(), 0U);
}

}  // namespace
}  // namespace tessera::test
