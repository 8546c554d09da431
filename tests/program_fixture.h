// The program `tessera` run in a folder of its own, and what its outcome must be: what tests of the program share.
#pragma once

#include "formats/mscene.h"
#include "run_program.h"
#include "tessera/scene.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace tessera::test {

class Program : public testing::Test {
protected:
    [[nodiscard]] RunningProgram start(const std::vector<std::string>& arguments, RunningProgram::Environment environment = {}) const {
        // Kernels of the tests stay out of the user's own cache, and are compiled once for all tests.
        environment.emplace(environment.begin(), "TESSERA_CACHE", TESSERA_TEST_CACHE);
        return {TESSERA_PROGRAM_PATH, arguments, folder_.path(), environment};
    }

    [[nodiscard]] Outcome run(const std::vector<std::string>& arguments, const RunningProgram::Environment& environment = {}) const {
        return start(arguments, environment).wait();
    }

    // A small teapot: `more` options on top of it.
    [[nodiscard]] Outcome renderTeapot(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"render", "teapot", "--size", "96x54", "--pixel-samples", "1"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }

    [[nodiscard]] std::string file(const std::string& name) const { return readFile(folder_.path() / name); }

    void write(const std::string& name, const Scene& scene) const {
        const std::vector<std::byte> bytes = serializeMscene(scene);
        std::string text;
        for (const std::byte byte : bytes) text.push_back(static_cast<char>(byte));
        writeFile(folder_.path() / name, text);
    }

    ScratchFolder folder_;
};

inline void expectSuccess(const Outcome& outcome) {
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("error"), std::string::npos) << outcome.err;
}

inline void expectOneLineError(const Outcome& outcome, int exitCode) {
    EXPECT_EQ(outcome.signal, 0);
    EXPECT_EQ(outcome.exitCode, exitCode);
    EXPECT_EQ(outcome.errorLines(), 1U) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("tessera: error: ")) << outcome.err;
    EXPECT_EQ(outcome.out, "");
}

// A command line that must fail: `says` is a part of the message. NAME.mscene files are made by the fixture.
struct BadInput {
    std::string name;
    int exitCode = 1;
    std::vector<std::string> arguments;
    std::string says;
};

inline void PrintTo(const BadInput& bad, std::ostream* stream) { *stream << bad.name; }

// Of wrong command lines, not of wrong input, the message leads to the help.
inline void expectRefused(const Outcome& outcome, const BadInput& bad) {
    expectOneLineError(outcome, bad.exitCode);
    EXPECT_NE(outcome.err.find(bad.says), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.exitCode == 2, outcome.err.find("--help'") != std::string::npos) << outcome.err;
}

}  // namespace tessera::test
