// Numbers in, JSON out.
#include "mesh/comparator.h"

#include <charconv>
#include <exception>
#include <iomanip>
#include <iostream>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace tessera::bench {

std::map<std::string, double> numberOptions(int count, char** words, std::map<std::string, double> options) {
    const std::vector<std::string_view> given(words + 1, words + count);
    for (std::size_t i = 0; i < given.size(); i += 2) {
        const auto option = given[i].starts_with("--") ? options.find(std::string(given[i].substr(2))) : options.end();
        if (option == options.end()) throw std::invalid_argument("unknown option '" + std::string(given[i]) + "'");
        if (i + 1 == given.size()) throw std::invalid_argument(std::string(given[i]) + " needs a number");
        const std::string_view text = given[i + 1];
        const auto result = std::from_chars(text.data(), text.data() + text.size(), option->second);
        if (result.ec != std::errc() || result.ptr != text.data() + text.size() || !(option->second > 0.0)) {
            throw std::invalid_argument(std::string(given[i]) + ": '" + std::string(text) + "' is no number above 0");
        }
    }
    return options;
}

std::vector<double> secondsOf(int runs, const std::function<void()>& work) {
    work();
    std::vector<double> seconds;
    for (int run = 0; run < runs; ++run) {
        const auto start = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
        seconds.push_back(taken.count());
    }
    return seconds;
}

void printRuns(const std::string& name, const std::map<std::string, double>& counts, const std::vector<double>& seconds) {
    std::cout << std::setprecision(9) << R"({"name": ")" << name << "\"";
    for (const auto& [count, value] : counts) std::cout << ", \"" << count << "\": " << value;
    std::cout << ", \"seconds\": [";
    for (std::size_t i = 0; i < seconds.size(); ++i) std::cout << (i == 0 ? "" : ", ") << seconds[i];
    std::cout << "]}" << std::endl;
}

int guarded(const std::string& program, const std::function<void()>& work) {
    try {
        work();
        return 0;
    } catch (const std::exception& error) {
        std::cerr << program << ": error: " << error.what() << "\n";
        return 1;
    }
}

}  // namespace tessera::bench
