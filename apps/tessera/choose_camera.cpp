// Decides what a frame is seen through, from the scene's cameras and the command line.
#include "choose_camera.h"

#include "tessera/error.h"

#include <cstddef>

namespace tessera::program {

namespace {

// The cameras' names for a message of one line: a file may hold thousands.
std::string cameraList(const Scene& scene) {
    constexpr std::size_t most = 20;
    std::string list;
    for (std::size_t i = 0; i < scene.cameras.size() && i < most; ++i) {
        list += (list.empty() ? "'" : ", '") + scene.cameras[i].name + "'";
    }
    if (scene.cameras.size() > most) list += " and " + std::to_string(scene.cameras.size() - most) + " more";
    return list;
}

}  // namespace

const Camera& namedCamera(const Scene& scene, const std::string& name, const std::string& option) {
    const Camera* camera = scene.findCamera(name);
    if (camera != nullptr) return *camera;
    const std::string missing = option + ": " + scene.name + " has no camera '" + name + "'";
    if (scene.cameras.empty()) throw Error(missing + ", nor any other: leave out " + option);
    throw Error(missing + ": it has " + cameraList(scene));
}

ChosenCamera chooseCamera(const Scene& scene, const CameraArguments& arguments) {
    ChosenCamera chosen;
    if (!arguments.name.empty()) {
        chosen.camera = namedCamera(scene, arguments.name, "--camera");
    } else if (!scene.cameras.empty()) {
        chosen.camera = scene.cameras.front();
    } else {
        chosen.camera = framingCamera(scene, arguments.fov.value_or(Camera{}.fovy));
        chosen.camera.name = "framing";
        if (!arguments.lookAt) chosen.note = scene.name + " has no camera: using one that sees all of it";
    }
    if (arguments.lookAt) {
        chosen.camera.transform = *arguments.lookAt;
        chosen.camera.name = "look-at";
    }
    if (arguments.fov) chosen.camera.fovy = *arguments.fov;
    return chosen;
}

}  // namespace tessera::program
