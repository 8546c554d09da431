// What may crash on damaged input is tried in a process of its own.
#include "formats/trial_run.h"

#include "formats/mesh_file.h"
#include "tessera/error.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace tessera {
namespace {

TEST(TrialRun, TellsOfADeathAndNothingElse) {
    EXPECT_EQ(trialRun([] {}, 60), "");
    EXPECT_EQ(trialRun([] { throw std::runtime_error("told by the run that counts"); }, 60), "");
    const std::string crash = trialRun([] { std::raise(SIGSEGV); }, 60);
    EXPECT_NE(crash.find("crashed"), std::string::npos) << crash;
    const std::string abortion = trialRun([] { std::abort(); }, 60);
    EXPECT_NE(abortion.find("crashed"), std::string::npos) << abortion;
}

TEST(TrialRun, EndsWhatNeverEnds) {
    const std::string death = trialRun(
        [] {
            volatile unsigned turns = 0;
            while (true) turns = turns + 1;
        },
        1);
    EXPECT_NE(death.find("more than 1 seconds"), std::string::npos) << death;
}

TEST(TrialRun, LeavesNoTrace) {
    int value = 1;
    EXPECT_EQ(trialRun([&] { value = 2; }, 60), "");
    EXPECT_EQ(value, 1);
}

// On this OFF file, whose face counts are none, Assimp 5.2 crashes; later versions may refuse it.
TEST(TrialRun, SavesMeshFilesFromReadersThatCrash) {
    const std::filesystem::path path = std::filesystem::temp_directory_path() / ("tessera_trial_" + std::to_string(getpid()) + ".off");
    std::ofstream(path)
        << "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1 colorsd\nf 1 2 3 4\no wing\nv 0 0 1\nv 1 0 1\n\1plv y\n1 1 1\nus\n3 0 2 1\n"
           "3 0 1 3\n3 0 3 2\n3 1 2 `3\n";
    try {
        static_cast<void>(readMeshFile(path, false));
        ADD_FAILURE() << "a damaged file was read";
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_EQ(message.rfind(path.string() + ": ", 0), 0U) << message;
    }
    std::filesystem::remove(path);
}

}  // namespace
}  // namespace tessera
