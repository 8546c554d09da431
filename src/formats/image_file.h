// Writes rendered frames as image files, with OpenImageIO.
#pragma once

#include "tessera/renderer.h"

#include <filesystem>
#include <map>
#include <string>

namespace tessera {

// What is kept with a picture, in EXR files. The other formats name the software only, so that equal pictures are equal files.
struct ImageMetadata {
    std::string command;                         // the command line, or what made the picture; EXR "comments"
    std::map<std::string, std::string> options;  // name -> value as text, written as "tessera:NAME" unless a statistic has that name
    glm::mat4 worldToCamera{1.0F};               // camera looks along -z; EXR "worldToCamera" has z turned, as OpenEXR defines it
    glm::mat4 worldToScreen{1.0F};               // to pixels over the picture's size, 0 to 1, y down; EXR "worldToNDC"
};

// Throws Error when `path`'s ending names no format that can be written (.exr .png .tif .tiff .jpg .jpeg),
// or when its folder cannot be written. Call before a long render.
void checkImagePath(const std::filesystem::path& path);

// Writes `frame` by the ending of `path`:
//   .exr  half R G B A (premultiplied, linear), float Z, N.X N.Y N.Z, u, v; uint32 object.id, patch.id (-1 becomes 4294967295);
//         data window = crop, display window = full picture; camera matrices, software, options and statistics as metadata:
//         counts "tessera:ranges_processed" and so on are int, or decimal text from 2^31 on; times "tessera:frame_ms" are double
//   .png .tif  8-bit sRGB with unassociated alpha    .jpg  8-bit sRGB over black; the crop window's pixels; AOVs are not written
// Written to a temporary name in the same folder, then renamed: no partial file is ever seen. Throws Error.
void writeImage(const std::filesystem::path& path, const Frame& frame, const ImageMetadata& metadata);

}  // namespace tessera
