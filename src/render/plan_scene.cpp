// The memory plan of a scene: its patches' sizes asked of their source.
#include <algorithm>

#include "render/plan_memory.h"

#include "scene/validate.h"
#include "surface/patch_stream.h"

namespace tessera {

MemoryPlan planMemory(const RenderOptions& options, const PatchSource& source, const SceneCounts& scene, const DeviceInfo& device) {
    const bool dicingApart = options.dicingCamera.has_value();
    const auto chunks = [&](std::uint32_t patchesEach) {
        return PlannedBytes{PatchStream::bytes(source, patchesEach, dicingApart), source.largest(patchesEach).largestBuffer()};
    };
    return planMemory(options, PlannedScene{source.patches(), scene.lights, chunks}, device);
}

MemoryPlan planMemory(const RenderOptions& options, const Scene& scene, const DeviceInfo& device) {
    scene.validate();
    requireMeshes(scene);
    return planMemory(options, PatchSource(scene), SceneCounts{scene.lights.size()}, device);
}

}  // namespace tessera
