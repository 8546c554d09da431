// Options whose values are read by parse_values.h: what it refuses is a usage error that names the option.
#pragma once

#include "parse_values.h"

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace tessera::program {

// An option whose text `read` turns into a value. `read` throws Error on text that is no value.
CLI::Option* addParsed(CLI::App& app, const std::string& optionName, std::function<void(const std::string&)> read,
                       const std::string& description);

struct Range {
    long long least = 0;
    long long most = 0;
};

// A whole number; the default shown is what `value` holds.
template <typename Number>
CLI::Option* addWhole(CLI::App& app, const std::string& optionName, Number& value, Range range, const std::string& description) {
    const auto read = [&value, range](const std::string& text) { value = static_cast<Number>(parseWhole(text, range.least, range.most)); };
    return addParsed(app, optionName, read, description)->default_str(std::to_string(value));
}

// Puts all options of `app` that have no heading yet under `group`.
void groupRest(CLI::App& app, const std::string& group);

}  // namespace tessera::program
