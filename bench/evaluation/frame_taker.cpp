// Renders the frames of trials on one device.
#include "evaluation/frame_taker.h"

#include "evaluation/camera_path.h"
#include "tessera/error.h"
#include "tessera/weld.h"

#include <algorithm>

namespace tessera::bench {

void FrameTaker::load(const std::string& scene) {
    if (loaded_ != scene) {
        loaded_ = scene;
        failure_.clear();
        try {
            const auto source = std::find_if(sources_.begin(), sources_.end(), [&](const SceneSource& item) { return item.name == scene; });
            if (source == sources_.end()) throw Error("there is no scene '" + scene + "'; use one of the plan's");
            Scene made = source->make();
            weld(made);
            cameras_ = made.cameras;
            if (cameras_.empty()) cameras_.push_back(framingCamera(made, Camera{}.fovy));
            renderer_.setScene(made);
        } catch (const std::exception& error) {
            // Of a scene that is minutes in the making it is enough to fail once.
            failure_ = error.what();
        }
    }
    if (!failure_.empty()) throw Error(failure_);
}

Camera FrameTaker::cameraOf(const Trial& trial) const {
    if (trial.along) return cameraAlong(cameras_, *trial.along);
    if (trial.view.camera.empty()) return cameras_.front();
    const auto found =
        std::find_if(cameras_.begin(), cameras_.end(), [&](const Camera& camera) { return camera.name == trial.view.camera; });
    if (found == cameras_.end())
        throw Error("scene '" + trial.view.scene + "' has no camera '" + trial.view.camera + "'; use one that it has");
    return *found;
}

Statistics FrameTaker::take(const Trial& trial) {
    load(trial.view.scene);
    RenderOptions options = trial.options;
    options.memoryBytes = std::min(options.memoryBytes, renderer_.device().globalBytes / 4 * 3);
    return renderer_.render(cameraOf(trial), options).statistics;
}

}  // namespace tessera::bench
