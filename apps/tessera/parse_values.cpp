// Strict readers for sizes, lists of numbers and lists of names on the command line.
#include "parse_values.h"

#include "console.h"
#include "tessera/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace tessera::program {

namespace {

struct NamedAov {
    std::string_view name;
    Aov aov;
};

constexpr std::array<NamedAov, 8> kAovs{{
    {"Z", Aov::z},
    {"N", Aov::normal},
    {"object.id", Aov::object},
    {"object", Aov::object},
    {"patch.id", Aov::patch},
    {"patch", Aov::patch},
    {"uv", Aov::uv},
    {"all", Aov::z | Aov::normal | Aov::object | Aov::patch | Aov::uv},
}};

constexpr std::array kMethods{SplitMethod::cpu, SplitMethod::breadth, SplitMethod::bounded, SplitMethod::local};
constexpr std::array kModes{DiceMode::watertight, DiceMode::classical};
constexpr std::array kSchemes{SubdivisionScheme::catmullClark, SubdivisionScheme::loop, SubdivisionScheme::bilinear,
                              SubdivisionScheme::none};

std::string inQuotes(std::string_view text) { return "'" + std::string(text) + "'"; }

std::vector<std::string_view> splitAtCommas(std::string_view text) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t comma = text.find(',');
        parts.push_back(text.substr(0, comma));
        if (comma == std::string_view::npos) return parts;
        text.remove_prefix(comma + 1);
    }
}

// A side of a picture. Too many digits for an int is out of range, not malformed.
int parseSide(std::string_view digits, std::string_view whole, int least) {
    if (digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos) {
        throw Error(inQuotes(whole) + " is no size: give WIDTHxHEIGHT in pixels, 1280x720 say");
    }
    int side = 0;
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), side);
    if (result.ec != std::errc() || side < least || side > kLargestSide) {
        throw Error(inQuotes(whole) + " is out of range: width and height must be " + std::to_string(least) + " to " +
                    std::to_string(kLargestSide) + " pixels");
    }
    return side;
}

template <typename Real>
Real parseFinite(std::string_view text) {
    Real value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec == std::errc::invalid_argument || result.ptr != text.data() + text.size()) {
        throw Error(inQuotes(text) + " is no number");
    }
    if (result.ec == std::errc() && std::isfinite(value)) return value;
    throw Error(inQuotes(text) + " is no finite number of " + std::to_string(8 * sizeof(Real)) + "-bit floating point");
}

// That of `all` whose name is `text`; `kind` is what an error calls it.
template <typename Named, std::size_t count>
Named parseNamed(std::string_view text, std::string_view kind, const std::array<Named, count>& all) {
    std::string names;
    for (const Named one : all) {
        if (name(one) == text) return one;
        names += (names.empty() ? "" : ", ") + std::string(name(one));
    }
    throw Error("unknown " + std::string(kind) + " " + inQuotes(text) + ": known are " + names);
}

Aov parseAov(std::string_view wanted) {
    for (const NamedAov& known : kAovs) {
        if (known.name == wanted) return known.aov;
    }
    throw Error("unknown output " + inQuotes(wanted) + ": known are " + aovNames());
}

}  // namespace

Size parseSize(std::string_view text, int least) {
    const std::size_t cross = text.find('x');
    if (cross == std::string_view::npos) return {parseSide("", text, least), 0};
    return {parseSide(text.substr(0, cross), text, least), parseSide(text.substr(cross + 1), text, least)};
}

float parseNumber(std::string_view text) { return parseFinite<float>(text); }

double parseFraction(std::string_view text, double most) {
    const auto value = parseFinite<double>(text);
    if (value < 0.0 || value > most) throw Error(inQuotes(text) + " is out of range: 0 to " + shortest(most));
    return value;
}

double parsePositive(std::string_view text) {
    const auto value = parseFinite<double>(text);
    if (!(value > 0.0)) throw Error(inQuotes(text) + " is out of range: above 0");
    return value;
}

long long parseWhole(std::string_view text, long long least, long long most) {
    long long value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec == std::errc::invalid_argument || result.ptr != text.data() + text.size()) {
        throw Error(inQuotes(text) + " is no whole number");
    }
    if (result.ec != std::errc() || value < least || value > most) {
        throw Error(inQuotes(text) + " is out of range: " + std::to_string(least) + " to " + std::to_string(most));
    }
    return value;
}

std::string listText(std::span<const float> values) {
    std::string text;
    for (const float value : values) text += (text.empty() ? "" : ",") + shortest(value);
    return text;
}

std::vector<float> parseNumbers(std::string_view text, std::size_t least, std::size_t most) {
    std::vector<float> numbers;
    for (const std::string_view part : splitAtCommas(text)) numbers.push_back(parseNumber(part));
    if (numbers.size() < least || numbers.size() > most) {
        const std::string wanted = least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most);
        throw Error(inQuotes(text) + " has " + std::to_string(numbers.size()) + " of the " + wanted +
                    " numbers needed, with commas and no spaces between");
    }
    return numbers;
}

SplitMethod parseMethod(std::string_view text) { return parseNamed(text, "method", kMethods); }

DiceMode parseMode(std::string_view text) { return parseNamed(text, "mode", kModes); }

SubdivisionScheme parseScheme(std::string_view text) { return parseNamed(text, "scheme", kSchemes); }

Aov parseAovs(std::string_view text) {
    Aov aovs = Aov::none;
    for (const std::string_view part : splitAtCommas(text)) aovs = aovs | parseAov(part);
    return aovs;
}

std::string aovNames() {
    std::string names;
    for (const NamedAov& known : kAovs) names += (names.empty() ? "" : ", ") + std::string(known.name);
    return names;
}

std::string lowerEnding(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

bool sameFile(const std::string& first, const std::string& second) {
    if (first.empty() || second.empty()) return false;
    std::error_code failure;
    const auto whole = [&failure](const std::string& path) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(path), failure);
    };
    return whole(first) == whole(second) && !failure;
}

}  // namespace tessera::program
