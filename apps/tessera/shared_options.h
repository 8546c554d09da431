// Options that several commands have, the same under each.
#pragma once

#include "choose_camera.h"
#include "tessera/renderer.h"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>

namespace tessera::program {

// --camera, --look-at and --fov, under the heading "Camera". Parsing fills `camera`, which has to outlive `app`, as all here have to that
// parsing fills; and calls `given` with the option's name.
void addCameraOptions(CLI::App& app, CameraArguments& camera, const std::function<void(const std::string&)>& given = {});

// --memory: `bytes` is what buffers on the device may take.
void addMemoryOption(CLI::App& app, std::uint64_t& bytes);

// --device: `device` is RendererSettings::device.
void addDeviceOption(CLI::App& app, int& device);

// --cache-dir and --no-cache.
void addCacheOptions(CLI::App& app, RendererSettings& settings);

}  // namespace tessera::program
