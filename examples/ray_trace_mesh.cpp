// Feeds a tessellated mesh to a ray tracer: a built-in scene as its camera sees it, traced with Embree 3, shaded by its normals.
//     ray_trace_mesh [--edges] [--error PX] [--look-at X,Y,Z,X,Y,Z] [--made-for X,Y,Z] [SCENE [OUT.ppm [WIDTH]]]
// --edges draws the triangles' edges, --error says how many pixels the mesh may be off, --look-at where the eye is and what it looks at,
// and
// --made-for where another eye is that the mesh is made for, for a look at what it does not see as finely.
// The device's buffers are mapped and given to Embree as they are: where device and host share memory, nothing is copied.
#include <tessera/error.h>
#include <tessera/scene.h>
#include <tessera/subdivision.h>
#include <tessera/tessellator.h>

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace {

constexpr float kFov = 35.0F;  // degrees, of eyes that the command line has

struct Arguments {
    std::string scene = "teapot";
    std::string output = "traced.ppm";
    int width = 640;  // pixels; the height is 9/16 of it
    bool edges = false;
    double error = 0.25;              // pixels
    std::vector<float> lookAt;        // eye, then target; empty: the scene's camera
    std::vector<float> eyeOfTheMesh;  // empty: the same
};

// A buffer of the device in the host's memory, for reading.
class MappedBuffer {
public:
    MappedBuffer(cl_command_queue queue, cl_mem buffer, std::size_t bytes) : queue_(queue), buffer_(buffer) {
        cl_int status = CL_SUCCESS;
        memory_ = clEnqueueMapBuffer(queue_, buffer_, CL_TRUE, CL_MAP_READ, 0, bytes, 0, nullptr, nullptr, &status);
        if (status != CL_SUCCESS) throw tessera::Error("the mesh cannot be mapped: OpenCL error " + std::to_string(status));
    }
    ~MappedBuffer() {
        clEnqueueUnmapMemObject(queue_, buffer_, memory_, 0, nullptr, nullptr);
        clFinish(queue_);
    }
    MappedBuffer(const MappedBuffer&) = delete;
    MappedBuffer& operator=(const MappedBuffer&) = delete;

    [[nodiscard]] const void* memory() const { return memory_; }

private:
    cl_command_queue queue_;
    cl_mem buffer_;
    void* memory_ = nullptr;
};

// Where a ray meets the mesh.
struct Hit {
    float distance = 0.0F;
    float facing = 0.0F;    // how much the surface faces the ray: 0 to 1
    float fromEdge = 0.0F;  // the nearest edge of the triangle, scene units
};

// The mesh in Embree, which reads the buffers where they are as long as it lives.
class TracedMesh {
public:
    TracedMesh(const tessera::MeshVertex* vertices, const std::uint32_t* indices, const tessera::MeshSizes& sizes)
        : vertices_(vertices),
          indices_(indices),
          device_(rtcNewDevice(nullptr), rtcReleaseDevice),
          scene_(rtcNewScene(device_.get()), rtcReleaseScene) {
        const std::unique_ptr<RTCGeometryTy, decltype(&rtcReleaseGeometry)> geometry(
            rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE), rtcReleaseGeometry);
        rtcSetGeometryVertexAttributeCount(geometry.get(), 1);
        rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices,
                                   offsetof(tessera::MeshVertex, position), sizeof(tessera::MeshVertex), sizes.vertices);
        rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, 0, RTC_FORMAT_FLOAT3, vertices,
                                   offsetof(tessera::MeshVertex, normal), sizeof(tessera::MeshVertex), sizes.vertices);
        rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices, 0, 3 * sizeof(std::uint32_t),
                                   sizes.triangles);
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometry(scene_.get(), geometry.get());
        rtcCommitScene(scene_.get());
        const RTCError error = rtcGetDeviceError(device_.get());
        if (error != RTC_ERROR_NONE) throw tessera::Error("Embree refuses the mesh: error " + std::to_string(error));
    }

    // `direction` has unit length.
    [[nodiscard]] std::optional<Hit> trace(const glm::vec3& origin, const glm::vec3& direction) const {
        RTCRayHit ray{};
        ray.ray.org_x = origin.x;
        ray.ray.org_y = origin.y;
        ray.ray.org_z = origin.z;
        ray.ray.dir_x = direction.x;
        ray.ray.dir_y = direction.y;
        ray.ray.dir_z = direction.z;
        ray.ray.tfar = std::numeric_limits<float>::infinity();
        ray.ray.mask = ~0U;
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene_.get(), &context, &ray);
        if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
        std::array<float, 3> normal{};
        rtcInterpolate0(rtcGetGeometry(scene_.get(), ray.hit.geomID), ray.hit.primID, ray.hit.u, ray.hit.v,
                        RTC_BUFFER_TYPE_VERTEX_ATTRIBUTE, 0, normal.data(), 3);
        const glm::vec3 across(normal[0], normal[1], normal[2]);
        const float facing = std::abs(glm::dot(across, direction)) / std::max(glm::length(across), std::numeric_limits<float>::min());
        return Hit{ray.ray.tfar, facing, fromEdge(ray.hit)};
    }

private:
    // A corner's barycentric coordinate is the share of the triangle's height that lies between the point and the side across.
    [[nodiscard]] float fromEdge(const RTCHit& hit) const {
        const std::array<float, 3> shares{1.0F - hit.u - hit.v, hit.u, hit.v};
        std::array<glm::vec3, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& position = vertices_[indices_[3 * std::size_t{hit.primID} + k]].position;
            corners[k] = {position[0], position[1], position[2]};
        }
        const float doubleArea = glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
        float least = std::numeric_limits<float>::infinity();
        for (std::size_t k = 0; k < 3; ++k)
            least = std::min(least, shares[k] * doubleArea / glm::distance(corners[(k + 1) % 3], corners[(k + 2) % 3]));
        return least;
    }

    const tessera::MeshVertex* vertices_;
    const std::uint32_t* indices_;
    std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device_;
    std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> scene_;
};

// Grey pixels, row by row from the top left, behind them a dark sky. `edges`: whether those are drawn, a pixel wide.
std::vector<char> tracePicture(const TracedMesh& mesh, const tessera::Camera& camera, int width, int height, bool edges) {
    std::vector<char> pixels;
    int hits = 0;
    const glm::mat3 rotation(tessera::rotationMatrix(camera.transform));
    const float step = 2.0F * std::tan(glm::radians(camera.fovy) / 2.0F) / static_cast<float>(height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float right = static_cast<float>(2 * x + 1 - width) / 2.0F * step;
            const float up = static_cast<float>(height - 2 * y - 1) / 2.0F * step;
            const auto hit = mesh.trace(camera.transform.translation, glm::normalize(rotation * glm::vec3(right, up, -1.0F)));
            hits += hit ? 1 : 0;
            float grey = hit ? 60.0F + 195.0F * hit->facing : 30.0F;
            if (hit && edges) grey *= std::clamp(hit->fromEdge / (hit->distance * step), 0.0F, 1.0F);
            pixels.push_back(static_cast<char>(static_cast<unsigned char>(grey)));
        }
    }
    std::cout << hits << " of " << width * height << " rays hit\n";
    return pixels;
}

void writePicture(const std::string& path, const std::vector<char>& pixels, int width, int height) {
    std::ofstream file(path, std::ios::binary);
    file << "P6\n" << width << " " << height << "\n255\n";
    for (const char grey : pixels) file.put(grey).put(grey).put(grey);
    if (!file.flush()) throw tessera::Error("cannot write '" + path + "'; choose another folder");
}

void traceScene(const Arguments& arguments) {
    tessera::Scene scene = tessera::builtinScene(arguments.scene);
    tessera::subdivide(scene);
    tessera::TessellateOptions options;
    options.pixelError = arguments.error;
    tessera::Camera camera = scene.cameras.front();
    const auto vectorAt = [](const std::vector<float>& values, std::size_t at) {
        return glm::vec3(values[at], values[at + 1], values[at + 2]);
    };
    if (!arguments.lookAt.empty()) camera = tessera::lookAt(vectorAt(arguments.lookAt, 0), vectorAt(arguments.lookAt, 3), kFov);
    options.camera = camera;
    if (!arguments.eyeOfTheMesh.empty()) {
        const tessera::Bounds bounds = tessera::worldBounds(scene);
        options.camera = tessera::lookAt(vectorAt(arguments.eyeOfTheMesh, 0), 0.5F * (bounds.lower + bounds.upper), kFov);
        options.cull = false;
    }
    options.width = arguments.width;
    options.height = std::max(1, arguments.width * 9 / 16);
    tessera::Tessellator tessellator;
    tessellator.setScene(scene);
    const tessera::DeviceMesh mesh = tessellator.tessellate(options);
    std::cout << mesh.sizes.vertices << " vertices, " << mesh.sizes.triangles << " triangles of " << mesh.sizes.patches << " patches\n";

    const MappedBuffer vertices(mesh.queue, mesh.vertices, mesh.sizes.vertexBytes);
    const MappedBuffer indices(mesh.queue, mesh.indices, mesh.sizes.indexBytes);
    const TracedMesh traced(static_cast<const tessera::MeshVertex*>(vertices.memory()), static_cast<const std::uint32_t*>(indices.memory()),
                            mesh.sizes);
    writePicture(arguments.output, tracePicture(traced, camera, options.width, options.height, arguments.edges), options.width,
                 options.height);
}

// `count` numbers with commas between them, all from `low` to `high`.
std::vector<float> numbersOf(std::string_view text, std::size_t count, float low, float high) {
    std::vector<float> numbers;
    while (numbers.size() < count) {
        float number = 0.0F;
        const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
        if (result.ec != std::errc() || !(number >= low && number <= high)) break;
        numbers.push_back(number);
        text.remove_prefix(static_cast<std::size_t>(result.ptr - text.data()));
        if (numbers.size() < count && text.starts_with(',')) text.remove_prefix(1);
    }
    if (numbers.size() == count && text.empty()) return numbers;
    throw tessera::Error(
        "usage: ray_trace_mesh [--edges] [--error PX] [--look-at X,Y,Z,X,Y,Z] [--made-for X,Y,Z] [SCENE [OUT.ppm [WIDTH]]]; PX from 0.001 "
        "to "
        "1000, WIDTH from 1 to 16384 pixels");
}

Arguments argumentsOf(int argc, char** argv) {
    constexpr float far = 1e6F;
    Arguments arguments;
    int place = 0;
    for (int k = 1; k < argc; ++k) {
        const std::string_view word = argv[k], next = k + 1 < argc ? argv[k + 1] : "";
        const bool takesNext = word == "--error" || word == "--look-at" || word == "--made-for";
        if (word == "--edges") arguments.edges = true;
        if (word == "--error") arguments.error = numbersOf(next, 1, 0.001F, 1000.0F)[0];
        if (word == "--look-at") arguments.lookAt = numbersOf(next, 6, -far, far);
        if (word == "--made-for") arguments.eyeOfTheMesh = numbersOf(next, 3, -far, far);
        if (takesNext) ++k;
        if (takesNext || word == "--edges") continue;
        if (place == 0) arguments.scene = word;
        if (place == 1) arguments.output = word;
        if (place == 2) arguments.width = static_cast<int>(numbersOf(word, 1, 1.0F, 16384.0F)[0]);
        // What is too much is refused as any other word would be.
        if (++place > 3) static_cast<void>(numbersOf("", 1, 0.0F, 0.0F));
    }
    return arguments;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        traceScene(argumentsOf(argc, argv));
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "ray_trace_mesh: " << error.what() << "\n";
        return 1;
    }
}
