// Cameras between cameras.
#include "evaluation/camera_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tessera::bench {

Camera cameraAlong(std::span<const Camera> cameras, double along) {
    if (cameras.size() == 1) return cameras.front();
    const double place = std::clamp(along, 0.0, 1.0) * static_cast<double>(cameras.size() - 1);
    const std::size_t part = std::min(static_cast<std::size_t>(place), cameras.size() - 2);
    const auto weight = static_cast<float>(place - static_cast<double>(part));
    const Camera& from = cameras[part];
    const Camera& to = cameras[part + 1];
    // The ends are the cameras themselves, to the bit.
    if (weight == 0.0F) return from;
    if (weight == 1.0F) return to;
    Camera between = from;
    between.name = from.name + " to " + to.name;
    between.transform.translation = glm::mix(from.transform.translation, to.transform.translation, weight);
    between.transform.rotation = glm::slerp(glm::normalize(from.transform.rotation), glm::normalize(to.transform.rotation), weight);
    between.near = glm::mix(from.near, to.near, weight);
    between.far = glm::mix(from.far, to.far, weight);
    between.fovy = glm::mix(from.fovy, to.fovy, weight);
    return between;
}

}  // namespace tessera::bench
