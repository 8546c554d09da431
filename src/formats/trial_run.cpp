#include "formats/trial_run.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>

namespace tessera {
namespace {

// In the forked process: never returns.
[[noreturn]] void runChild(const std::function<void()>& work, unsigned seconds) {
    // No handler of the program's may run here, nor the user's terminal see what a dying reader says.
    for (const int signal : std::array{SIGINT, SIGTERM, SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGXCPU}) std::signal(signal, SIG_DFL);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
    const rlimit processor{seconds, seconds + 1};
    setrlimit(RLIMIT_CPU, &processor);
    const rlimit core{0, 0};
    setrlimit(RLIMIT_CORE, &core);
    try {
        work();
    } catch (...) {
        // The run that counts meets it again and tells it.
        _exit(0);
    }
    _exit(0);
}

}  // namespace

std::string trialRun(const std::function<void()>& work, unsigned seconds) {
    const pid_t child = fork();
    if (child < 0) return {};
    if (child == 0) runChild(work, seconds);
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) return {};
    }
    if (WIFSIGNALED(status)) {
        const int signal = WTERMSIG(status);
        if (signal == SIGXCPU || signal == SIGKILL) return "it took more than " + std::to_string(seconds) + " seconds";
        return "it crashed (signal " + std::to_string(signal) + ")";
    }
    // A sanitizer's report ends a process with a status of its own.
    if (WEXITSTATUS(status) != 0) return "it crashed (status " + std::to_string(WEXITSTATUS(status)) + ")";
    return {};
}

}  // namespace tessera
