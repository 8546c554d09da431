// Child processes with their output in files, so that no pipe can fill up and block them.
#include "run_program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace tessera::test {

namespace {

// In the child: no way back but the exit code.
void sendTo(const std::filesystem::path& path, int descriptor) {
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || dup2(file, descriptor) < 0) _exit(126);
    close(file);
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> all;
    all.reserve(texts.size() + 1);
    for (std::string& text : texts) all.push_back(text.data());
    all.push_back(nullptr);
    return all;
}

}  // namespace

std::size_t Outcome::errorLines() const { return static_cast<std::size_t>(std::count(err.begin(), err.end(), '\n')); }

ScratchFolder::ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tessera-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder like " + name);
    path_ = name;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::set<std::string> ScratchFolder::fileNames() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) names.insert(entry.path().filename().string());
    return names;
}

std::string readFile(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read " + path.string());
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void writeFile(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream file(path, std::ios::binary);
    file << bytes;
    if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

RunningProgram::RunningProgram(const std::string& program, const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                               const Environment& environment) {
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const std::vector<char*> argv = pointers(words);
    process_ = fork();
    if (process_ < 0) throw std::runtime_error("cannot start " + program);
    if (process_ > 0) return;
    // A test runner in the background ignores interrupts, and children inherit that.
    std::signal(SIGINT, SIG_DFL);
    for (const auto& [key, value] : environment) setenv(key.c_str(), value.c_str(), 1);
    sendTo(said_.path() / "out", STDOUT_FILENO);
    sendTo(said_.path() / "err", STDERR_FILENO);
    if (chdir(folder.c_str()) != 0) _exit(126);
    execv(program.c_str(), argv.data());
    _exit(127);
}

RunningProgram::~RunningProgram() {
    if (process_ <= 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
}

void RunningProgram::send(int signal) const { kill(process_, signal); }

Outcome RunningProgram::wait() {
    int status = 0;
    if (waitpid(process_, &status, 0) != process_) throw std::runtime_error("cannot wait for the program");
    process_ = -1;
    Outcome outcome;
    if (WIFEXITED(status)) outcome.exitCode = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    outcome.out = readFile(said_.path() / "out");
    outcome.err = readFile(said_.path() / "err");
    return outcome;
}

}  // namespace tessera::test
