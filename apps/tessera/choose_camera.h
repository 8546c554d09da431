// Decides what a frame is seen through, from the scene's cameras and the command line.
#pragma once

#include "tessera/scene.h"

#include <optional>
#include <string>

namespace tessera::program {

struct CameraArguments {
    std::string name;                 // empty: the scene's first camera
    std::optional<Transform> lookAt;  // replaces the camera's place and direction
    std::optional<float> fov;         // replaces its vertical field of view, degrees
};

struct ChosenCamera {
    Camera camera;
    std::string note;  // what the user may not expect, or empty
};

// The camera of that name, which lives as long as the scene. Throws Error, which names `option` and lists the scene's cameras, where
// there is none.
[[nodiscard]] const Camera& namedCamera(const Scene& scene, const std::string& name, const std::string& option);

// The camera of that name, the first one, or one that frames the scene where it has none. Throws Error, which lists
// the scene's cameras, on an unknown name.
[[nodiscard]] ChosenCamera chooseCamera(const Scene& scene, const CameraArguments& arguments);

}  // namespace tessera::program
