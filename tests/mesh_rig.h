// Runs a tessellation's first stage alone: a scene's nets in world space, and the patterns that its patches get.
#pragma once

#include "device/session.h"
#include "mesh/mesh_shared.h"
#include "surface/patch_set.h"
#include "tessera/scene.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace tessera::test {

// Files of a program that places patches and finds their factors.
[[nodiscard]] const KernelFiles& factorKernelFiles();

// What patches are measured by: a tolerance in world units, or an error in pixels of a picture of `camera`.
[[nodiscard]] mesh_view viewOf(double tolerance, double leastTolerance = 1e-7);
[[nodiscard]] mesh_view viewOf(const Camera& camera, double pixelError, int width, int height, bool cull);

class MeshRig {
public:
    // `lanes`: 16, 8 or 1, or 0 for the device's own. `files`: the program's, with those of factorKernelFiles() among them.
    explicit MeshRig(int lanes = 0, const KernelFiles& files = factorKernelFiles());

    // Validates the scene and uploads and places it.
    void place(const Scene& scene);

    // Of all placed patches, in the device's order; they stay in patterns() too.
    [[nodiscard]] std::vector<mesh_pattern> factors(mesh_view view);

    [[nodiscard]] DeviceSession& session() { return session_; }
    [[nodiscard]] const frame_params& frame() const { return frame_; }
    [[nodiscard]] const PatchSet& patches() const { return patches_; }
    [[nodiscard]] const DeviceBuffer& patterns() const { return patterns_; }
    // In the device's order: their object in the scene, and their number in its mesh.
    [[nodiscard]] const std::vector<placed_patch>& placed() const { return placed_; }
    // Device time of the last factors().
    [[nodiscard]] double factorsMs() const { return factorsMs_; }

private:
    DeviceSession session_;
    PatchSet patches_;
    DeviceBuffer turned_;
    frame_params frame_{};
    DeviceBuffer patterns_;
    std::vector<placed_patch> placed_;
    double factorsMs_ = 0;
};

}  // namespace tessera::test
