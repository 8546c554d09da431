// Tessellates a scene's surfaces into triangles on one OpenCL device: without cracks, as fine as asked for and no finer, in bounded memory
// (after Schwarz and Stamminger, "Fast GPU-based Adaptive Tessellation with CUDA", 2009).
#pragma once

#include <CL/cl.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "tessera/device.h"
#include "tessera/progress.h"
#include "tessera/renderer.h"
#include "tessera/scene.h"

namespace tessera {

struct TessellateOptions {
    // Just one of these two is above 0. Both bound the distance between the mesh and the surfaces, of patches that are not left out.
    double tolerance = 0;          // world units
    double pixelError = 0;         // pixels, in a picture of `camera`; of what is nearer than its near plane, as if it were there
    std::optional<Camera> camera;  // with `pixelError`, and only then
    int width = 1280;              // pixels, of that picture; 1 to 65536
    int height = 720;
    bool cull = true;               // with a camera: leave out patches that lie wholly outside its view
    bool positionsOnly = false;     // vertices are three floats, not MeshVertex
    std::uint64_t memoryBytes = 0;  // what all buffers on the device take at most; 0: 512 MiB or a quarter of its memory, whichever is less

    // Throws Error naming the option and its range: no tolerance or two, values that are not above 0 or not finite, a pixel error without a
    // camera or a camera without one, sizes out of range.
    void validate() const;
};

// Which way round a patch's triangles turn, and its normals point.
enum class Orientation {
    consistent,  // patches are turned so that neighbours agree: in each connected piece of a mesh the fewer ones
    asGiven,     // as du x dv has it
};

// A vertex on the device.
struct MeshVertex {
    float position[3];     // world
    float normal[3];       // world, of unit length, along du x dv (a PN triangle's own quadratic normal), against it in a turned patch; 0
                           // where the surface has none
    float u, v;            // of the patch, whatever the mesh; textureAt() (tessera/texture.h) makes texture coordinates of them
    std::uint32_t object;  // index into Scene::objects
    std::uint32_t patch;   // index into the object's mesh
};
static_assert(sizeof(MeshVertex) == 40);

// What a tessellation holds. Neighbouring patches have vertices of their own along their common border, equal to the bit. A patch with
// more vertices than a work-group makes is cut into parts, along lines of its own pattern, whose vertices there stand twice as well.
struct MeshSizes {
    std::uint64_t patches = 0;           // placed patches of the scene
    std::uint64_t patchesCulled = 0;     // left out by a camera's view; where there is one, patches of no area count as well
    std::uint64_t units = 0;             // patches and parts of patches that are made one after the other
    std::uint64_t vertices = 0;          // in the buffer
    std::uint64_t distinctVertices = 0;  // without those that parts of a patch repeat
    std::uint64_t triangles = 0;
    std::uint64_t vertexBytes = 0;
    std::uint64_t indexBytes = 0;
};

// A mesh on the device. The buffers are the tessellator's: valid until its next call that tessellates, measures other options or sets a
// scene, or its end. Commands on `queue` see them complete.
struct DeviceMesh {
    cl_context context = nullptr;
    cl_command_queue queue = nullptr;
    cl_mem vertices = nullptr;  // MeshVertex, or three floats; may be larger than the mesh
    cl_mem indices = nullptr;   // three uint32 a triangle, counter-clockwise where normals point to the viewer
    MeshSizes sizes;
};

// Device times by stage, as in the paper's tables, in milliseconds; of the last tessellation.
struct MeshStatistics {
    std::string device;
    MeshSizes sizes;
    double placeMs = 0;                      // control points to world space
    double factorsMs = 0;                    // tessellation factors: bounds, culling, rates
    double offsetsMs = 0;                    // final factors and offsets: counts and their exclusive scan
    double vertexMs = 0;                     // vertex data
    double indexMs = 0;                      // index data
    double tessellateMs = 0;                 // wall clock, from the first command to the last result; of streams with the sink's time in it
    double buildMs = 0;                      // building or loading the kernels, when the tessellator was made
    std::map<std::string, double> kernelMs;  // device time by kernel name
    std::uint64_t pieces = 0;                // that were made one after the other
    std::uint64_t chunks = 1;                // parts of the scene's patches that were on the device one after the other
    std::uint64_t deviceBytesBudget = 0;
    std::uint64_t deviceBytesPeak = 0;
};

class MeshSink;

// Not for use by several threads at once; tessellators of their own are.
class Tessellator {
public:
    // Opens the device and builds or loads the kernels. Throws Error: no device, unknown index, build failure.
    explicit Tessellator(const RendererSettings& settings = {});
    ~Tessellator();
    Tessellator(Tessellator&&) noexcept;
    Tessellator& operator=(Tessellator&&) noexcept;
    Tessellator(const Tessellator&) = delete;
    Tessellator& operator=(const Tessellator&) = delete;

    [[nodiscard]] const DeviceInfo& device() const;

    // Validates the scene and takes it. Throws Error; then no scene is set.
    void setScene(const Scene& scene, Orientation orientation = Orientation::consistent);

    // Other control points for a mesh of the scene, as many as it has, in the order of Mesh::points: the next frame of an animation. The
    // mesh's kind, weights and place stay, and which patches are turned; nothing else is uploaded or made again. Throws Error, leaving all
    // as it was, on an unknown index, another number of points, points that Scene::validate() would refuse, and a mesh with edge records,
    // whose curves would no longer be its borders.
    void replacePoints(std::size_t mesh, std::span<const glm::vec3> points);

    // How large the mesh will be. What has been measured is used by the next tessellate() of the same options, unless anything changed.
    // Throws Error on bad options, on a tolerance below what 32-bit positions hold at the scene's size, naming the least, and where a
    // patch would need more than 65536 segments along a side.
    [[nodiscard]] MeshSizes measure(const TessellateOptions& options);

    // Makes the mesh in buffers on the device, which are used again where they are large enough. Throws Error as measure() does, where the
    // buffers pass the budget, with the bytes it would take, and where there are 2^32 vertices or more.
    [[nodiscard]] DeviceMesh tessellate(const TessellateOptions& options);

    // Makes the mesh piece by piece within the budget, whatever its size, and hands each piece to `sink` (tessera/mesh_sink.h). Throws
    // Error as measure() does, where the budget is too small for any piece, with the least that would do, and what the sink throws.
    void stream(const TessellateOptions& options, MeshSink& sink, const Progress& progress = {});

    [[nodiscard]] const MeshStatistics& statistics() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace tessera
