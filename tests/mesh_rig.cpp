// Runs a tessellation's first stage alone: a scene's nets in world space, and the patterns that its patches get.
#include "mesh_rig.h"

#include "render/frame_setup.h"

#include <algorithm>
#include <cmath>

namespace tessera::test {

const KernelFiles& factorKernelFiles() {
    static const KernelFiles files = {"surface/place.cl", "mesh/factors.cl"};
    return files;
}

mesh_view viewOf(double tolerance, double leastTolerance) {
    mesh_view view{};
    view.tolerance = static_cast<float>(tolerance);
    view.least_tolerance = static_cast<float>(leastTolerance);
    view.near_plane = 1.0F;
    view.depth_share = 1.0F;
    return view;
}

mesh_view viewOf(const Camera& camera, double pixelError, int width, int height, bool cull) {
    const double focal = 0.5 * height / std::tan(0.5 * glm::radians(static_cast<double>(camera.fovy)));
    const double slopeX = 0.5 * width / focal;
    const double slopeY = 0.5 * height / focal;
    const double share = 1.0 / std::sqrt(1.0 + slopeX * slopeX + slopeY * slopeY);
    mesh_view view = viewOf(pixelError / focal * share);
    view.view = 1;
    view.cull = cull ? 1 : 0;
    view.near_plane = camera.near;
    view.depth_share = static_cast<float>(share);
    view.slope_x = static_cast<float>(slopeX);
    view.slope_y = static_cast<float>(slopeY);
    const glm::dmat4 eye = eyeFromWorld(camera);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) view.eye_from_world[4 * row + column] = static_cast<float>(eye[column][row]);
    return view;
}

MeshRig::MeshRig(int lanes, const KernelFiles& files) : session_(-1, kernelSources(), TESSERA_TEST_CACHE, lanes, files) {}

void MeshRig::place(const Scene& scene) {
    scene.validate();
    Timeline& timeline = session_.timeline;
    patches_ = uploadPatches(scene, session_.memory, timeline);
    frame_ = frame_params{};
    setPatches(frame_, patches_);
    const std::vector<placed_object> objects = placeObjects(scene, glm::dmat4(1.0));
    const std::size_t bytes = objects.size() * sizeof(placed_object);
    const DeviceBuffer placed = session_.memory.allocate(Purpose::scene, "the objects", bytes);
    timeline.write(placed.cl(), objects.data(), bytes);
    enqueuePlace(session_, frame_, patches_, placed.cl(), patches_.eyePoints.cl(), false);
    placed_.resize(patches_.patches);
    timeline.read(patches_.placed.cl(), placed_.data(), placed_.size() * sizeof(placed_patch));
    // None is turned.
    const std::size_t turnedBytes = (placed_.size() + 31) / 32 * sizeof(std::uint32_t);
    turned_ = session_.memory.allocate(Purpose::scene, "which are turned", turnedBytes);
    if (turnedBytes > 0) timeline.fill(turned_.cl(), 0, turnedBytes);
    patterns_ = session_.memory.allocate(Purpose::scene, "the patterns", placed_.size() * sizeof(mesh_pattern));
}

std::vector<mesh_pattern> MeshRig::factors(mesh_view view) {
    view.patches = patches_.patches;
    view.first_patch = patches_.first;
    Timeline& timeline = session_.timeline;
    timeline.finish();
    timeline.restart(false);
    const std::size_t groups = std::min<std::size_t>((patches_.patches + 63) / 64, session_.device.shape.groups);
    timeline.launch(session_.kernels.with("mesh_factors", frame_, view, patches_.eyePoints.cl(), patches_.placed.cl(),
                                          patches_.records.cl(), turned_.cl(), patterns_.cl()),
                    "mesh_factors", groups, 64);
    std::vector<mesh_pattern> patterns(patches_.patches);
    timeline.read(patterns_.cl(), patterns.data(), patterns.size() * sizeof(mesh_pattern));
    timeline.finish();
    factorsMs_ = timeline.milliseconds()["mesh_factors"];
    return patterns;
}

}  // namespace tessera::test
