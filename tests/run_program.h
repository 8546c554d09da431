// Runs a program as a user would and keeps what it says: for tests of the command line.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tessera::test {

struct Outcome {
    int exitCode = -1;  // -1 when a signal ended it
    int signal = 0;     // which one, or 0
    std::string out;    // stdout
    std::string err;    // stderr

    [[nodiscard]] std::size_t errorLines() const;
};

// A folder of its own for a test, removed with all it holds.
class ScratchFolder {
public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::set<std::string> fileNames() const;  // hidden ones too

private:
    std::filesystem::path path_;
};

std::string readFile(const std::filesystem::path& path);
void writeFile(const std::filesystem::path& path, const std::string& bytes);

// A program that runs; wait() ends the run. The destructor kills what still runs.
class RunningProgram {
public:
    using Environment = std::vector<std::pair<std::string, std::string>>;

    // Starts `program` in the folder `folder`, with `environment` added to this process's own.
    RunningProgram(const std::string& program, const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                   const Environment& environment);
    ~RunningProgram();
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    void send(int signal) const;
    [[nodiscard]] Outcome wait();

private:
    ScratchFolder said_;
    int process_ = -1;
};

}  // namespace tessera::test
