// What is kept with a picture about its making: command line, options in words, camera matrices.
#include "picture_metadata.h"

#include "console.h"
#include "parse_values.h"

#include <cmath>
#include <map>
#include <numbers>
#include <string_view>

namespace tessera::program {

namespace {

// Camera coordinates to fractions of the picture (x right, y down) and depth 0 (near) to 1 (far), after division by w.
glm::dmat4 projection(const Camera& camera, double aspect) {
    const double scaleY = 0.5 / std::tan(static_cast<double>(camera.fovy) * std::numbers::pi / 360.0);
    const double scaleX = scaleY / aspect;
    const auto near = static_cast<double>(camera.near);
    const double depth = static_cast<double>(camera.far) - near;
    glm::dmat4 m(0.0);
    m[0][0] = scaleX;
    m[1][1] = -scaleY;
    // w is the distance along the view axis, -z: the picture's middle is at half of it.
    m[2][0] = -0.5;
    m[2][1] = -0.5;
    m[2][3] = -1.0;
    if (depth > 0.0) {
        m[2][2] = -static_cast<double>(camera.far) / depth;
        m[3][2] = -static_cast<double>(camera.far) * near / depth;
    }
    return m;
}

std::string aovText(Aov aovs) {
    std::string text;
    const auto add = [&](Aov aov, std::string_view aovName) {
        if (contains(aovs, aov)) text += (text.empty() ? "" : ",") + std::string(aovName);
    };
    add(Aov::z, "Z");
    add(Aov::normal, "N");
    add(Aov::object, "object.id");
    add(Aov::patch, "patch.id");
    add(Aov::uv, "uv");
    return text;
}

}  // namespace

// The mode, and the options that it looks at.
std::map<std::string, std::string> modeOptions(const RenderOptions& options) {
    std::map<std::string, std::string> list{{"mode", std::string(name(options.mode))}};
    if (options.mode == DiceMode::watertight) {
        list["shading-rate"] = shortest(options.shadingRate);
        list["grid-size"] = std::to_string(options.gridSize);
        list["occlusion"] = options.occlusion ? "true" : "false";
        if (options.dicingCamera) list["dicing-camera"] = options.dicingCamera->name;
    } else {
        list["split-bound"] = shortest(options.splitBound);
        list["dice-rate"] = std::to_string(options.diceRate);
        list["max-depth"] = std::to_string(options.maxDepth);
    }
    return list;
}

ImageMetadata pictureMetadata(const std::string& commandLine, const Camera& camera, const RenderArguments& arguments) {
    const RenderOptions& options = arguments.options;
    ImageMetadata metadata;
    metadata.command = commandLine;
    metadata.options = {
        {"scene", arguments.scene.scene},
        {"weld-tolerance", shortest(arguments.scene.weldTolerance)},
        {"flat", arguments.scene.flat ? "true" : "false"},
        {"camera", camera.name},
        {"fov", shortest(camera.fovy)},
        {"size", std::to_string(options.width) + "x" + std::to_string(options.height)},
        {"crop", listText(options.crop)},
        {"pixel-samples", std::to_string(options.pixelSamples)},
        {"background", listText(options.background)},
        {"aov", aovText(options.aovs)},
        {"method", std::string(name(options.method))},
        {"memory", std::to_string(options.memoryBytes >> 20)},
        {"batch", std::to_string(options.batch)},
        {"bucket", std::to_string(options.bucketWidth) + "x" + std::to_string(options.bucketHeight)},
        {"cull-backfaces", options.cullBackfaces ? "true" : "false"},
        {"headlight", options.headlight ? "true" : "false"},
        {"emulate-atomics", options.emulateAtomics ? "true" : "false"},
    };
    metadata.options.merge(modeOptions(options));
    const glm::dmat4 worldToCamera = glm::inverse(matrix(camera.transform));
    const double aspect = static_cast<double>(options.width) / static_cast<double>(options.height);
    metadata.worldToCamera = glm::mat4(worldToCamera);
    metadata.worldToScreen = glm::mat4(projection(camera, aspect) * worldToCamera);
    return metadata;
}

}  // namespace tessera::program
