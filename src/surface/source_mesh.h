// A mesh as chunks are gathered from it: floats as the device takes them, records, and boxes around runs of its patches.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/patch_shared.h"
#include "tessera/scene.h"

namespace tessera {

// The control points of a patch's sides, numbers within the patch, in the order and the directions of EdgeRecord::side; of a PN triangle's
// side 2, which it has not, its corner C.
using BorderPoints = std::array<std::size_t, 4>;
[[nodiscard]] std::array<BorderPoints, 4> bordersOf(PatchKind kind);

// Axis-aligned, in object space.
struct ObjectBox {
    std::array<float, 3> lower{};
    std::array<float, 3> upper{};
};

struct SourceMesh {
    // Patches that share a box.
    static constexpr std::uint32_t boxPatches = 256;

    // Of a validated mesh.
    explicit SourceMesh(const Mesh& mesh);

    // Records of the patches before `patch`, which may be the one behind the last.
    [[nodiscard]] std::uint32_t recordsBefore(std::uint32_t patch) const { return firstRecord.empty() ? 0 : firstRecord[patch]; }
    // Floats of a patch's net in eye space.
    [[nodiscard]] std::uint32_t eyeFloatsEach() const;

    PatchKind kind = PatchKind::bezier;
    std::uint32_t patches = 0;
    std::uint32_t floatsEach = 0;            // of a patch, as uploaded
    std::vector<float> floats;               // floatsEach a patch
    std::vector<std::uint8_t> flags;         // SIDE_* of each patch
    std::vector<float> recordFloats;         // RECORD_FLOATS a record
    std::vector<edge_info> records;          // first_float and object are of no meaning here
    std::vector<std::uint32_t> firstRecord;  // of each patch and of the one behind the last; empty where there are no records
    std::vector<ObjectBox> boxes;            // of boxPatches patches each: all control points, and the points of their records
};

}  // namespace tessera
