// What the command lines of the measuring programs share: the error of a wrong one, and whole numbers.
#pragma once

#include <charconv>
#include <limits>
#include <stdexcept>
#include <string>
#include <system_error>

namespace tessera::bench {

// A command line that cannot be followed; the message is one line without the program's name.
class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// The whole of `text` as a number from `least` to `most`. Throws UsageError.
[[nodiscard]] inline int wholeNumber(const std::string& option, const std::string& text, int least,
                                     int most = std::numeric_limits<int>::max()) {
    int value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc() || result.ptr != text.data() + text.size() || value < least || value > most) {
        const std::string end = most == std::numeric_limits<int>::max() ? "" : " to " + std::to_string(most);
        throw UsageError(option + ": '" + text + "' is no whole number from " + std::to_string(least) + end);
    }
    return value;
}

}  // namespace tessera::bench
