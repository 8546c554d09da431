// What a frame's device memory goes to, fixed before the frame starts (DESIGN.md, "Bounded").
#pragma once

#include <cstdint>

namespace tessera {

struct DeviceInfo;
struct RenderOptions;
struct Scene;

// Bytes on the device by purpose.
struct MemoryUse {
    std::uint64_t scene = 0;    // control points, as uploaded and in eye space, patches, objects, lights
    std::uint64_t queues = 0;   // ranges: the stack, the batch, the diceable ones
    std::uint64_t film = 0;     // samples, what they show, coarse depth
    std::uint64_t picture = 0;  // colours and the other planes

    [[nodiscard]] constexpr std::uint64_t total() const { return scene + queues + film + picture; }
};

struct MemoryPlan {
    std::uint64_t budget = 0;         // bytes
    MemoryUse bytes;                  // total() <= budget; breadth's queues and what grows with them are not in it
    std::uint32_t batch = 0;          // p: ranges bounded at a time; breadth: as in the options
    std::uint32_t readyCapacity = 0;  // diceable ranges that may wait; breadth: 0
    std::uint64_t stackCapacity = 0;  // ranges on the device: the proven bound; breadth and cpu: 0
    int bucketWidth = 0;              // pixels, of all but the last of a row; the crop window's size where it is rendered at once
    int bucketHeight = 0;
    int bucketsX = 1;
    int bucketsY = 1;
    std::uint32_t chunkPatches = 1;  // patches on the device at a time, at least 1
    std::uint32_t chunks = 1;        // 1: the scene stays resident

    [[nodiscard]] constexpr int buckets() const { return bucketsX * bucketsY; }
    [[nodiscard]] constexpr bool streamed() const { return chunks > 1; }
};

// How a frame of these options would use the device's memory, without a renderer. Throws Error where the budget is too small, with the
// least that would do, on bad options, and on a scene that is none.
[[nodiscard]] MemoryPlan planMemory(const RenderOptions& options, const Scene& scene, const DeviceInfo& device);

}  // namespace tessera
