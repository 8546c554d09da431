// The subcommands of the program: each adds its options to the command line and says what to run.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>

namespace tessera::program {

// A subcommand. `run` is to be called once, after parsing, when `app->parsed()`; it throws tessera::Error or UsageError.
struct Command {
    CLI::App* app = nullptr;
    std::function<void()> run;
};

// Something that is wrong with the command line itself: exit code 2 and a hint to --help.
class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// `commandLine` is the whole command line as typed; it is kept in the pictures.
[[nodiscard]] Command addRenderCommand(CLI::App& app, const std::string& commandLine);
[[nodiscard]] Command addTessellateCommand(CLI::App& app);
[[nodiscard]] Command addInfoCommand(CLI::App& app);
[[nodiscard]] Command addGenerateCommand(CLI::App& app);
[[nodiscard]] Command addDevicesCommand(CLI::App& app);

}  // namespace tessera::program
