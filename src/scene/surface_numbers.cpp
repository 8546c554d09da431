// Messages about the parameters of surfaces.
#include "scene/surface_numbers.h"

#include "scene/text.h"
#include "tessera/error.h"

#include <array>
#include <charconv>
#include <cmath>

namespace tessera {

namespace {

constexpr double kLargestNumber = 1e9;

}  // namespace

void SurfaceLabel::fail(const std::string& what) const { throw Error(std::string(kind) + " " + quotedName(name) + ": " + what); }

void SurfaceLabel::requireFinite(std::string_view parameter, double value) const {
    // Written so that NaN fails.
    if (std::abs(value) <= kLargestNumber) return;
    fail(std::string(parameter) + " " + numberText(value) + " is not finite or beyond 1e9; give a smaller number");
}

void SurfaceLabel::requirePositive(std::string_view parameter, double value) const {
    requireFinite(parameter, value);
    if (value <= 0.0) fail(std::string(parameter) + " " + numberText(value) + " gives no surface; give more than 0");
}

void SurfaceLabel::requireRising(std::string_view lowName, double low, std::string_view highName, double high) const {
    requireFinite(lowName, low);
    requireFinite(highName, high);
    if (low < high) return;
    fail(std::string(lowName) + " " + numberText(low) + " is not below " + std::string(highName) + " " + numberText(high) +
         ", which gives no surface; give them in rising order");
}

std::string numberText(double value) {
    std::array<char, 32> text{};
    const std::to_chars_result end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

}  // namespace tessera
