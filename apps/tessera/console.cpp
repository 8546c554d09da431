// What the program says on the terminal: one line a message, and numbers as text.
#include "console.h"

#include "tessera/error.h"

#include <array>
#include <charconv>
#include <cstddef>
#include <iostream>

namespace tessera::program {

std::string oneLine(std::string_view text) {
    std::string line(text);
    for (char& c : line) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x20 || code == 0x7F) c = '?';
    }
    return line;
}

namespace {

// One write a message: lines of several processes on one terminal do not mix.
void printLine(std::string_view prefix, std::string_view text) { std::cerr << std::string(prefix) + oneLine(text) + "\n" << std::flush; }

}  // namespace

void printError(std::string_view text) { printLine("tessera: error: ", text); }

void printNote(std::string_view text) { printLine("tessera: note: ", text); }

void printSummary(std::string_view text) { printLine("tessera: ", text); }

void printResult(std::string_view text) {
    std::cout << text << std::flush;
    if (!std::cout) throw Error("cannot write to standard output: check where it goes and the space left there");
}

namespace {

template <typename... How>
std::string digitsOf(How... how) {
    std::array<char, 64> digits{};
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), how...);
    return {digits.data(), result.ptr};
}

}  // namespace

std::string shortest(float value) { return digitsOf(value); }
std::string shortest(double value) { return digitsOf(value); }

std::string about(double value) { return digitsOf(value, std::chars_format::general, 3); }

std::string fixed(double value, int decimals) {
    // Room for the largest double written out in full.
    std::array<char, 400> digits{};
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, decimals);
    return {digits.data(), result.ptr};
}

std::string byteText(std::uint64_t bytes) {
    constexpr std::array<std::string_view, 5> units{"B", "KiB", "MiB", "GiB", "TiB"};
    auto value = static_cast<double>(bytes);
    std::size_t unit = 0;
    while (value >= 1024.0 && unit + 1 < units.size()) {
        value /= 1024.0;
        ++unit;
    }
    return fixed(value, unit == 0 ? 0 : 1) + " " + std::string(units[unit]);
}

std::string counted(std::uint64_t count, std::string_view singular, std::string_view plural) {
    return std::to_string(count) + " " + std::string(count == 1 ? singular : plural);
}

}  // namespace tessera::program
