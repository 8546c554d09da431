// What is kept with a picture about its making.
#pragma once

#include "formats/image_file.h"
#include "render_arguments.h"
#include "tessera/scene.h"

#include <string>

namespace tessera::program {

[[nodiscard]] ImageMetadata pictureMetadata(const std::string& commandLine, const Camera& camera, const RenderArguments& arguments);

}  // namespace tessera::program
