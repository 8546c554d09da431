// The lines of OBJ and MTL files as words.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

// Goes through a text line by line. A backslash at a line's end joins the next one to it; from # on a line is a comment.
class ObjLines {
public:
    // The text must stay.
    explicit ObjLines(std::string_view text) : text_(text) {}

    // Goes on to the next line that has words; false where there is none.
    bool next();

    [[nodiscard]] std::size_t number() const { return first_; }  // of the line, from 1; of joined lines the first one's
    [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }
    [[nodiscard]] std::string rest() const;  // the words after the first, with single spaces between

private:
    bool takeLine();  // whether the next line is joined to it

    std::string_view text_;  // what is left
    std::vector<std::string_view> words_;
    std::size_t first_ = 0;
    std::size_t lines_ = 0;  // taken so far
};

// Whole words as numbers; nothing where they are none.
[[nodiscard]] std::optional<double> objNumber(std::string_view word);
[[nodiscard]] std::optional<long long> objInteger(std::string_view word);

}  // namespace tessera
