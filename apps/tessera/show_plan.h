// A memory plan in words and as JSON.
#pragma once

#include "tessera/device.h"
#include "tessera/memory_plan.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace tessera::program {

// Lines as those of `tessera info`.
[[nodiscard]] std::string planText(const MemoryPlan& plan, const DeviceInfo& device);

// Memory in bytes, buckets in pixels.
[[nodiscard]] nlohmann::ordered_json planJson(const MemoryPlan& plan, const DeviceInfo& device);

}  // namespace tessera::program
