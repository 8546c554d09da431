// What the program says on the terminal: errors and notes of one line each on stderr, results on stdout.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tessera::program {

// `text` with control characters replaced by '?', so that a name from a file can neither break a line nor drive the terminal.
[[nodiscard]] std::string oneLine(std::string_view text);

// "tessera: error: TEXT" on stderr.
void printError(std::string_view text);

// "tessera: note: TEXT" on stderr.
void printNote(std::string_view text);

// "tessera: TEXT" on stderr.
void printSummary(std::string_view text);

// Writes `text` to stdout and flushes. Throws Error when not all of it could be written (a full disk, say).
void printResult(std::string_view text);

// The shortest decimal text that reads back as `value`: "0.3", "8", "1e+20".
[[nodiscard]] std::string shortest(float value);
[[nodiscard]] std::string shortest(double value);

// `value` to three digits: "1.25e-06".
[[nodiscard]] std::string about(double value);

// `value` with `decimals` digits after the point.
[[nodiscard]] std::string fixed(double value, int decimals);

// Bytes for people, in powers of 1024: "640 B", "31.4 MiB".
[[nodiscard]] std::string byteText(std::uint64_t bytes);

// "1 patch", "2 patches": `count` and the word that goes with it.
[[nodiscard]] std::string counted(std::uint64_t count, std::string_view singular, std::string_view plural);

}  // namespace tessera::program
