// The memory plan: what a frame's buffers take, decided before it starts (DESIGN.md, "Bounded"). Knows no device but its limits.
#pragma once

#include <functional>

#include "film/film_layout.h"
#include "split/range_shared.h"
#include "surface/patch_source.h"
#include "tessera/device.h"
#include "tessera/memory_plan.h"
#include "tessera/options.h"

namespace tessera {

// What the frame's buffers may take: what the options say or the default, never more than the device holds.
[[nodiscard]] std::uint64_t frameBudget(const RenderOptions& options, const DeviceInfo& device);

// Room of the split stage with p = `batch` ranges at a time, p at least 1. Of breadth, whose queues grow as it goes, none.
struct QueueRoom {
    split_limits limits{};
    std::uint64_t stack = 0;  // ranges
};
[[nodiscard]] QueueRoom queueRoom(const RenderOptions& options, std::uint32_t batch, const DeviceInfo& device);

struct PlannedBytes {
    std::uint64_t all = 0;
    std::uint64_t largestBuffer = 0;
};

// What the plan must know of a scene.
struct PlannedScene {
    std::uint32_t patches = 0;
    std::uint64_t lights = 0;
    // Device bytes of patches in chunks of `patchesEach`, from 1 to all of them: resident where that is all.
    std::function<PlannedBytes(std::uint32_t patchesEach)> chunks;
};

// Finds batch, buckets and chunks that fit the budget, the largest batch and the fewest buckets and chunks that its rule allows. Given
// batches and buckets are kept, the latter rounded up to whole tiles. Throws Error on bad options, and where nothing fits, with the least
// budget that would do with these options.
[[nodiscard]] MemoryPlan planMemory(const RenderOptions& options, const PlannedScene& scene, const DeviceInfo& device);

// What the plan must know of a scene beside its patches.
struct SceneCounts {
    std::uint64_t lights = 0;
};
[[nodiscard]] MemoryPlan planMemory(const RenderOptions& options, const PatchSource& source, const SceneCounts& scene,
                                    const DeviceInfo& device);

// Bucket k of the plan's buckets(), row by row from the top left, in pixels of the full picture.
[[nodiscard]] PixelWindow bucketWindow(const RenderOptions& options, const MemoryPlan& plan, int k);
[[nodiscard]] FilmLayout bucketLayout(const RenderOptions& options, const MemoryPlan& plan, int k);

}  // namespace tessera
