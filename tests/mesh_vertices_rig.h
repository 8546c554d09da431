// Runs the vertex stage of a tessellation alone, over patterns made by hand. For its test and for bench/mesh_vertices.
#pragma once

#include "device/session.h"
#include "mesh/mesh_shared.h"
#include "surface/patch_set.h"
#include "tessera/tessellator.h"

#include "core/frame_shared.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tessera::meshing {

// A border vertex as patch_vertex() gives it.
struct BorderPlace {
    std::uint32_t patch = 0;
    std::uint32_t u = 0;  // units of 2^-24
    std::uint32_t v = 0;
};

struct Words {
    std::vector<std::uint32_t> before, inside, behind;  // canaries around what was asked for
};

class VerticesRig {
public:
    static constexpr int gpuShape = 64;  // in place of lanes: groups of 64 work-items of one lane
    // `lanes`: 16, 8, 1 or gpuShape, or 0 for the device's own.
    explicit VerticesRig(const std::filesystem::path& cacheFolder, int lanes = 0);

    // Patterns, one a placed patch: Bezier objects' first, then Gregory, rational, PN ones.
    void set(const Scene& scene, std::vector<mesh_pattern> patterns);

    [[nodiscard]] const std::vector<mesh_offset>& offsets() const { return offsets_; }
    [[nodiscard]] const PatchSet& patches() const { return patches_; }

    // Nets in world space, as the kernels have them.
    [[nodiscard]] std::vector<float> nets();
    [[nodiscard]] std::vector<placed_patch> placed();

    // The words of a run of units, and canaries around them.
    [[nodiscard]] Words make(std::uint64_t firstUnit, std::uint64_t units, bool positionsOnly = false);
    [[nodiscard]] std::vector<MeshVertex> all();
    // Makes all units, keeps the result on the device, and returns the kernel's milliseconds.
    [[nodiscard]] double time(bool positionsOnly);

    [[nodiscard]] std::vector<glm::vec3> borderVertices(std::span<const BorderPlace> at);

private:
    void launch(const mesh_piece& piece, const cl::Buffer& to);
    [[nodiscard]] DeviceBuffer upload(const void* data, std::size_t bytes);
    [[nodiscard]] std::uint64_t verticesBefore(std::uint64_t unit) const;

    DeviceSession session_;
    frame_params frame_{};
    PatchSet patches_;
    std::vector<mesh_pattern> patterns_;
    std::vector<mesh_offset> offsets_;
    DeviceBuffer patternBuffer_, offsetBuffer_, objects_, timed_;
    std::size_t timedBytes_ = 0;
};

}  // namespace tessera::meshing
