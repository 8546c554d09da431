// What is told of a mesh file that is being read: lines that begin with its name, and names that are used once.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace tessera {

class MeshNotes {
public:
    MeshNotes(std::string file, std::vector<std::string>* warnings);

    [[nodiscard]] const std::string& file() const { return file_; }
    [[noreturn]] void fail(const std::string& what) const;  // throws Error
    void warn(const std::string& what) const;               // the first fifty

private:
    std::string file_;
    std::vector<std::string>* warnings_;
    std::size_t warned_;  // lines that were there before
};

// `text` in one line, for messages of others: white space becomes single spaces, nothing at the ends, of bounded length.
[[nodiscard]] std::string oneLine(std::string_view text);

// Hands out each name once, in UTF-8.
class UniqueNames {
public:
    explicit UniqueNames(std::string fallback) : fallback_(std::move(fallback)) {}

    // `wanted`, or the fallback where it is empty or no text; with a number behind where that is taken.
    [[nodiscard]] std::string make(std::string_view wanted);

private:
    std::string fallback_;
    std::unordered_set<std::string> taken_;
    std::unordered_map<std::string, std::size_t> next_;  // numbers tried so far
};

}  // namespace tessera
