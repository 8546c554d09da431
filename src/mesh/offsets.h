// Where patches' units, vertices and triangles go: the kernels of offsets.cl.
#pragma once

#include <cstdint>

#include "device/session.h"
#include "mesh/mesh_shared.h"

namespace tessera {

// Bytes of the buffers for so many patches.
[[nodiscard]] constexpr std::uint64_t sumsBytes(std::uint64_t patches) {
    return (patches + MESH_SCAN_BLOCK - 1) / MESH_SCAN_BLOCK * sizeof(mesh_totals);
}
[[nodiscard]] constexpr std::uint64_t offsetsBytes(std::uint64_t patches) { return (patches + 1) * sizeof(mesh_offset); }
[[nodiscard]] constexpr std::uint64_t totalsBytes() { return sizeof(mesh_totals); }

// Fills `offsets`, of which the last is the sum of all, and `totals` from the patterns of `patches` patches, 0 or more. `sums` is scratch.
void enqueueOffsets(DeviceSession& session, std::uint32_t patches, const cl::Buffer& patterns, const cl::Buffer& sums,
                    const cl::Buffer& offsets, const cl::Buffer& totals);

}  // namespace tessera
