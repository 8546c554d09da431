// Chunks are halved until they leave the mesh its share: the same scene and budget give the same chunks.
#include "mesh/mesh_plan.h"

#include <algorithm>

#include "mesh/mesh_shared.h"
#include "mesh/mesh_tables.h"
#include "surface/patch_stream.h"
#include "tessera/error.h"

namespace tessera {
namespace {

// What is gained by larger pieces or chunks is little; what they delay, Ctrl-C and progress, is much.
constexpr std::uint64_t mostChunkPatches = std::uint64_t{1} << 20;

// Bytes of their indices.
constexpr std::uint64_t twoTriangles = std::uint64_t{6} * sizeof(std::uint32_t);

std::uint64_t patchBytes(const PatchSource& source, std::uint32_t each) {
    // Which patches are turned stays for all of them.
    const std::uint64_t turned = DeviceMemory::bytesFor((std::uint64_t{source.patches()} + 31) / 32 * sizeof(std::uint32_t));
    return PatchStream::bytes(source, each, false) + MeshTables::bytes(each) + turned;
}

}  // namespace

std::uint64_t bytesAVertex(bool positionsOnly) { return (positionsOnly ? 3 * sizeof(float) : sizeof(mesh_vertex)) + twoTriangles; }

std::uint64_t mostUnitVertices() { return 2 * (std::uint64_t{MESH_RATE_MOST} + 1); }

MeshPlan planMesh(const PatchSource& source, const std::string& sceneName, std::uint64_t budget, std::uint64_t largestBuffer,
                  bool positionsOnly) {
    const std::uint64_t each = bytesAVertex(positionsOnly);
    const auto fits = [&](std::uint32_t patches, std::uint64_t bytes) {
        const ChunkSize size = source.largest(patches);
        return bytes <= budget && size.largestBuffer() <= largestBuffer;
    };
    MeshPlan plan;
    plan.budget = budget;
    plan.patchesEach = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(source.patches(), 1, mostChunkPatches));
    // Half of the budget is the mesh's, or what a unit needs where that is more.
    const std::uint64_t unit = mostUnitVertices() * each;
    plan.patchBytes = patchBytes(source, plan.patchesEach);
    while (plan.patchesEach > 1 && !fits(plan.patchesEach, plan.patchBytes + std::max(budget / 2, unit))) {
        plan.patchesEach = (plan.patchesEach + 1) / 2;
        plan.patchBytes = patchBytes(source, plan.patchesEach);
    }
    if (!fits(plan.patchesEach, plan.patchBytes + unit)) {
        const std::uint64_t least = patchBytes(source, 1) + unit;
        throw Error(sceneName + ": the memory budget of " + bytesText(budget) + " is too small for this mesh: --memory " +
                    std::to_string((least + (std::uint64_t{1} << 20) - 1) >> 20) + " would do");
    }
    plan.vertexBytes = each - twoTriangles;
    plan.roomVertices = std::min(plan.meshRoom() / each, largestBuffer / std::max(plan.vertexBytes, twoTriangles));
    return plan;
}

}  // namespace tessera
