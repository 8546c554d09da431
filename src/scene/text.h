// Names and numbers as they stand in messages: one line, printable, of bounded length.
#pragma once

#include <string>
#include <string_view>

namespace tessera {

// `name` between single quotes, control characters as \xNN, cut after some eighty bytes.
[[nodiscard]] std::string quotedName(std::string_view name);

// The shortest decimal text that reads back as `value`.
[[nodiscard]] std::string numberText(float value);

// Whether `text` is well-formed UTF-8: no overlong forms, no surrogates, nothing beyond U+10FFFF.
[[nodiscard]] bool isUtf8(std::string_view text);

}  // namespace tessera
