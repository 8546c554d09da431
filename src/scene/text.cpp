// Names and numbers as they stand in messages.
#include "scene/text.h"

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>

namespace tessera {

namespace {

constexpr std::size_t kLongestName = 80;

// Bytes in the UTF-8 sequence that `lead` begins; 0 where it begins none.
std::size_t sequenceLength(std::uint8_t lead) {
    if (lead < 0x80) return 1;
    if (lead >= 0xC2 && lead <= 0xDF) return 2;
    if (lead >= 0xE0 && lead <= 0xEF) return 3;
    if (lead >= 0xF0 && lead <= 0xF4) return 4;
    return 0;
}

// Overlong forms, surrogates and values past U+10FFFF all show in the second byte's range.
bool secondByteFits(std::uint8_t lead, std::uint8_t second) {
    if (lead == 0xE0) return second >= 0xA0;
    if (lead == 0xED) return second <= 0x9F;
    if (lead == 0xF0) return second >= 0x90;
    if (lead == 0xF4) return second <= 0x8F;
    return true;
}

}  // namespace

std::string quotedName(std::string_view name) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string result = "'";
    for (const char c : name.substr(0, kLongestName)) {
        const auto byte = static_cast<std::uint8_t>(c);
        if (byte >= 0x20 && byte != 0x7F) {
            result += c;
        } else {
            result += "\\x";
            result += kDigits[byte >> 4U];
            result += kDigits[byte & 15U];
        }
    }
    return result + (name.size() > kLongestName ? "...'" : "'");
}

std::string numberText(float value) {
    std::array<char, 64> buffer{};
    const std::to_chars_result end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return {buffer.data(), end.ptr};
}

bool isUtf8(std::string_view text) {
    const auto byteAt = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = sequenceLength(byteAt(i));
        if (length == 0 || length > text.size() - i) return false;
        for (std::size_t k = 1; k < length; ++k) {
            if ((byteAt(i + k) & 0xC0U) != 0x80U) return false;
        }
        if (length > 1 && !secondByteFits(byteAt(i), byteAt(i + 1))) return false;
        i += length;
    }
    return true;
}

}  // namespace tessera
