// What is said where no memory plan fits.
#pragma once

#include "tessera/device.h"
#include "tessera/memory_plan.h"
#include "tessera/options.h"

namespace tessera {

// `least` is the plan that takes least, more than `budget`. Throws Error with the MiB that would do and what takes most of them.
[[noreturn]] void throwTooSmall(const RenderOptions& options, const DeviceInfo& device, std::uint64_t budget, const MemoryPlan& least);

// What needs a buffer that the device cannot give in any plan.
enum class TooLarge { queues, bucket, scene };
[[noreturn]] void throwTooLarge(const RenderOptions& options, const DeviceInfo& device, TooLarge what);

}  // namespace tessera
