// The lines of OBJ and MTL files as words.
#include "formats/obj_lines.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace tessera {

namespace {

constexpr std::string_view kBlanks = " \t\r\f\v";

template <typename Number>
std::optional<Number> numberOf(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return value;
}

}  // namespace

bool ObjLines::next() {
    words_.clear();
    while (words_.empty() && !text_.empty()) {
        first_ = lines_ + 1;
        while (takeLine() && !text_.empty()) {
        }
    }
    return !words_.empty();
}

bool ObjLines::takeLine() {
    std::string_view line = text_.substr(0, text_.find('\n'));
    text_.remove_prefix(std::min(line.size() + 1, text_.size()));
    ++lines_;
    const std::size_t comment = line.find('#');
    line = line.substr(0, comment);
    const std::size_t last = line.find_last_not_of(kBlanks);
    const bool joined = comment == std::string_view::npos && last != std::string_view::npos && line[last] == '\\';
    if (joined) line = line.substr(0, last);
    while (true) {
        line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
        if (line.empty()) return joined;
        words_.push_back(line.substr(0, line.find_first_of(kBlanks)));
        line.remove_prefix(words_.back().size());
    }
}

std::string ObjLines::rest() const {
    std::string text;
    for (std::size_t i = 1; i < words_.size(); ++i) text += (i == 1 ? "" : " ") + std::string(words_[i]);
    return text;
}

std::optional<double> objNumber(std::string_view word) { return numberOf<double>(word); }

std::optional<long long> objInteger(std::string_view word) { return numberOf<long long>(word); }

}  // namespace tessera
