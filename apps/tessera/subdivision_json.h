// What became of a scene's cages, as JSON and as text.
#pragma once

#include "tessera/subdivision.h"

#include <nlohmann/json.hpp>
#include <span>
#include <string>

namespace tessera::program {

// An object a cage: counts; "limit_distance" in scene units; "notes", a line each.
[[nodiscard]] nlohmann::ordered_json subdivisionJson(std::span<const CageReport> reports);

// Lines, the first of which begins with "cage".
[[nodiscard]] std::string subdivisionText(const CageReport& report);

}  // namespace tessera::program
