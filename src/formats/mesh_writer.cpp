// Which writer a mesh file's ending asks for, and what its format cannot hold.
#include "formats/mesh_writer.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "formats/mesh_out_formats.h"
#include "formats/output_file.h"
#include "tessera/error.h"

namespace tessera {
namespace {

void refuseQuads(const std::filesystem::path& path, const std::string& format) {
    throw Error("cannot write '" + path.string() + "': " + format + " holds triangles alone; leave out --quads or choose .ply or .obj");
}

}  // namespace

std::unique_ptr<MeshWriter> makeMeshWriter(const std::filesystem::path& path, const MeshFileOptions& options) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending != ".ply" && ending != ".obj" && ending != ".stl" && ending != ".glb") {
        throw Error("cannot write '" + path.string() + "': its ending names no format of meshes; choose .ply, .obj, .stl or .glb");
    }
    if (options.quads && ending == ".stl") refuseQuads(path, "STL");
    if (options.quads && ending == ".glb") refuseQuads(path, "GLB");
    checkOutputFile(path);
    if (ending == ".ply") return makePlyWriter(path, options);
    if (ending == ".obj") return makeObjWriter(path, options);
    return ending == ".stl" ? makeStlWriter(path) : makeGlbWriter(path, options);
}

}  // namespace tessera
