// The program `tessera`: reads the command line, runs the subcommand, turns errors into one line and an exit code.
#include "commands.h"
#include "console.h"
#include "tessera/renderer.h"

#include <CLI/CLI.hpp>
#include <array>
#include <csignal>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <string_view>

namespace {

using namespace tessera::program;

constexpr int kExitFailure = 1;
constexpr int kExitUsage = 2;

// `argument` as a shell would have to be given it.
std::string quoted(std::string_view argument) {
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./,=:+@%";
    if (!argument.empty() && argument.find_first_not_of(plain) == std::string_view::npos) return std::string(argument);
    std::string text = "'";
    for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

std::string commandLineText(std::span<char*> arguments) {
    std::string text = "tessera";
    for (const char* argument : arguments.subspan(1)) text += " " + quoted(argument);
    return text;
}

std::string helpHint(const CLI::App& app) {
    for (const CLI::App* command : app.get_subcommands()) return "see 'tessera " + command->get_name() + " --help'";
    return "see 'tessera --help'";
}

int usageFailure(const CLI::App& app, std::string_view what) {
    printError(std::string(what) + "; " + helpHint(app));
    return kExitUsage;
}

int run(const CLI::App& app, std::span<const Command> commands) {
    try {
        for (const Command& command : commands) {
            if (command.app->parsed()) command.run();
        }
        return 0;
    } catch (const UsageError& error) {
        return usageFailure(app, error.what());
    } catch (const std::bad_alloc&) {
        printError("the host is out of memory: try a smaller --size or fewer --pixel-samples");
    } catch (const std::exception& error) {
        printError(error.what());
    }
    return kExitFailure;
}

int parseAndRun(int argc, char** argv) {
    CLI::App app("Tessera renders smooth surfaces as micropolygons on OpenCL devices.", "tessera");
    app.set_version_flag("--version", "tessera " + std::string(tessera::versionString()), "Print the version and exit");
    app.set_help_flag("-h,--help", "Print this help and exit");
    app.require_subcommand(0, 1);
    app.footer("Example: tessera render teapot -o teapot.png\n'tessera COMMAND --help' tells a command's options.");
    const std::array commands{addRenderCommand(app, commandLineText({argv, static_cast<std::size_t>(argc)})), addTessellateCommand(app),
                              addInfoCommand(app), addGenerateCommand(app), addDevicesCommand(app)};
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) {
        return app.exit(success);
    } catch (const CLI::ParseError& error) {
        return usageFailure(app, error.what());
    }
    if (app.get_subcommands().empty()) return usageFailure(app, "no command given: render, tessellate, info, generate or devices");
    return run(app, commands);
}

}  // namespace

int main(int argc, char** argv) {
    // A file beyond the limit on sizes is an error of its write then, which is told.
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        return parseAndRun(argc, argv);
    } catch (const std::exception& error) {
        printError(error.what());
        return kExitFailure;
    }
}
