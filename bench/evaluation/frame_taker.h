// Renders the frames of trials on one device.
#pragma once

#include "evaluation/plan.h"
#include "tessera/renderer.h"

#include <span>
#include <string>
#include <vector>

namespace tessera::bench {

// Keeps one scene resident: trials should come scene by scene.
class FrameTaker {
public:
    // Opens the device. `sources` has to outlive the taker. Throws Error.
    FrameTaker(std::span<const SceneSource> sources, const RendererSettings& settings) : sources_(sources), renderer_(settings) {}

    [[nodiscard]] const DeviceInfo& device() const { return renderer_.device(); }

    // One frame. A budget beyond three quarters of the device's memory is lowered to that. Throws Error: the scene cannot be had, the
    // camera is missing, the frame fails.
    [[nodiscard]] Statistics take(const Trial& trial);

private:
    void load(const std::string& scene);
    [[nodiscard]] Camera cameraOf(const Trial& trial) const;

    std::span<const SceneSource> sources_;
    Renderer renderer_;
    std::string loaded_;
    std::string failure_;  // why the scene `loaded_` cannot be had
    std::vector<Camera> cameras_;
};

}  // namespace tessera::bench
