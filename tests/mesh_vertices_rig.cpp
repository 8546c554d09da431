// Runs the vertex stage of a tessellation alone, over patterns made by hand.
#include "mesh_vertices_rig.h"

#include "mesh/pattern.h"
#include "render/frame_setup.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace tessera::meshing {
namespace {

constexpr std::size_t canaryWords = 64;
constexpr std::uint32_t canary = 0xc0ffee11U;

constexpr const char* borderKernel = R"(
// patch_vertex() at places of patches.
#include "core/frame_shared.h"
#include "surface/patch_eval.clh"
#include "surface/vertex.clh"

kernel void border_vertices(frame_params frame, global const float* points, global const placed_patch* patches,
                            global const edge_info* records, global const uint* at, uint count, global float* out) {
    for (uint i = (uint)get_global_id(0); i < count; i += (uint)get_global_size(0)) {
        patch_ref patch = patch_at(&frame, points, patches, records, at[3 * i]);
        vpoint p = patch_vertex(patch, (vint)((int)at[3 * i + 1]), (vint)((int)at[3 * i + 2]));
        out[3 * i] = vfirst(p.x);
        out[3 * i + 1] = vfirst(p.y);
        out[3 * i + 2] = vfirst(p.z);
    }
}
)";

KernelSources withBorders(KernelSources sources, int lanes) {
    if (lanes == VerticesRig::gpuShape) {
        std::string& header = sources.at("device/lanes.clh");
        header = "#undef GROUP\n#undef LANES\n#define GROUP 64\n#define LANES 1\n" + header;
    }
    sources["surface/border_vertices.cl"] = borderKernel;
    return sources;
}

}  // namespace

VerticesRig::VerticesRig(const std::filesystem::path& cacheFolder, int lanes)
    : session_(-1, withBorders(kernelSources(), lanes), cacheFolder, lanes == gpuShape ? 1 : lanes,
               {"surface/place.cl", "mesh/vertices.cl", "surface/border_vertices.cl"}) {
    if (lanes == gpuShape) session_.device.shape = {64, 1, session_.device.shape.groups};
}

DeviceBuffer VerticesRig::upload(const void* data, std::size_t bytes) {
    DeviceBuffer buffer = session_.memory.allocate(Purpose::scene, "input", bytes);
    if (bytes > 0) session_.timeline.write(buffer.cl(), data, bytes);
    return buffer;
}

void VerticesRig::set(const Scene& scene, std::vector<mesh_pattern> patterns) {
    patterns_ = std::move(patterns);
    offsets_.assign(1, mesh_offset{});
    for (const mesh_pattern& pattern : patterns_) {
        const mesh_offset own = unitsBefore(pattern, patternUnits(pattern)), last = offsets_.back();
        offsets_.push_back({last.units + own.units, last.vertices + own.vertices, last.triangles + own.triangles});
    }
    patches_ = uploadPatches(scene, session_.memory, session_.timeline);
    setPatches(frame_, patches_);
    const std::vector<placed_object> placed = placeObjects(scene, glm::dmat4(1.0));
    objects_ = upload(placed.data(), placed.size() * sizeof(placed_object));
    enqueuePlace(session_, frame_, patches_, objects_.cl(), patches_.eyePoints.cl(), false);
    patternBuffer_ = upload(patterns_.data(), patterns_.size() * sizeof(mesh_pattern));
    offsetBuffer_ = upload(offsets_.data(), offsets_.size() * sizeof(mesh_offset));
    timedBytes_ = 0;
}

std::vector<float> VerticesRig::nets() {
    std::vector<float> values(patches_.eyeBytes() / sizeof(float));
    session_.timeline.read(patches_.eyePoints.cl(), values.data(), values.size() * sizeof(float));
    return values;
}

std::vector<placed_patch> VerticesRig::placed() {
    std::vector<placed_patch> values(patches_.patches);
    session_.timeline.read(patches_.placed.cl(), values.data(), values.size() * sizeof(placed_patch));
    return values;
}

std::uint64_t VerticesRig::verticesBefore(std::uint64_t unit) const {
    if (unit == offsets_.back().units) return offsets_.back().vertices;
    const auto behind = std::upper_bound(offsets_.begin(), offsets_.end(), unit,
                                         [](std::uint64_t value, const mesh_offset& offset) { return value < offset.units; });
    const auto patch = static_cast<std::size_t>(behind - offsets_.begin()) - 1;
    return offsets_[patch].vertices + unitsBefore(patterns_[patch], static_cast<std::uint32_t>(unit - offsets_[patch].units)).vertices;
}

void VerticesRig::launch(const mesh_piece& piece, const cl::Buffer& to) {
    session_.launch(session_.kernels.with("mesh_vertices", frame_, piece, offsetBuffer_.cl(), patternBuffer_.cl(), patches_.eyePoints.cl(),
                                          patches_.placed.cl(), patches_.records.cl(), objects_.cl(), to),
                    "mesh_vertices");
}

Words VerticesRig::make(std::uint64_t firstUnit, std::uint64_t units, bool positionsOnly) {
    const std::uint64_t first = verticesBefore(firstUnit), count = verticesBefore(firstUnit + units) - first;
    const std::size_t words = count * (positionsOnly ? 3 : sizeof(MeshVertex) / 4);
    std::vector<std::uint32_t> values(words + 2 * canaryWords, canary);
    const DeviceBuffer buffer = upload(values.data(), values.size() * 4);
    // The kernel's buffer begins behind the first canary.
    const cl_buffer_region region{canaryWords * 4, std::max<std::size_t>(words, 1) * 4};
    const cl::Buffer inside = cl::Buffer(buffer.cl()).createSubBuffer(CL_MEM_READ_WRITE, CL_BUFFER_CREATE_TYPE_REGION, &region);
    launch({static_cast<std::uint32_t>(patterns_.size()), positionsOnly ? 1U : 0U, firstUnit, units, first, 0}, inside);
    session_.timeline.read(buffer.cl(), values.data(), values.size() * 4);
    const auto at = [&](std::size_t k) { return values.begin() + static_cast<std::ptrdiff_t>(k); };
    return {{at(0), at(canaryWords)}, {at(canaryWords), at(canaryWords + words)}, {at(canaryWords + words), values.end()}};
}

std::vector<MeshVertex> VerticesRig::all() {
    const Words words = make(0, offsets_.back().units);
    std::vector<MeshVertex> vertices(offsets_.back().vertices);
    std::memcpy(vertices.data(), words.inside.data(), words.inside.size() * 4);
    return vertices;
}

double VerticesRig::time(bool positionsOnly) {
    const std::size_t bytes = offsets_.back().vertices * (positionsOnly ? 12 : sizeof(MeshVertex));
    if (bytes != timedBytes_) timed_ = session_.memory.allocate(Purpose::scene, "vertices", bytes);
    timedBytes_ = bytes;
    session_.timeline.finish();
    session_.timeline.restart(false);
    launch({static_cast<std::uint32_t>(patterns_.size()), positionsOnly ? 1U : 0U, 0, offsets_.back().units, 0, 0}, timed_.cl());
    session_.timeline.finish();
    return session_.timeline.milliseconds().at("mesh_vertices");
}

std::vector<glm::vec3> VerticesRig::borderVertices(std::span<const BorderPlace> at) {
    const DeviceBuffer places = upload(at.data(), at.size_bytes());
    std::vector<glm::vec3> points(at.size());
    const DeviceBuffer out = session_.memory.allocate(Purpose::scene, "border vertices", points.size() * sizeof(glm::vec3));
    session_.timeline.launch(session_.kernels.with("border_vertices", frame_, patches_.eyePoints.cl(), patches_.placed.cl(),
                                                   patches_.records.cl(), places.cl(), static_cast<cl_uint>(at.size()), out.cl()),
                             "border_vertices", 4, 64);
    session_.timeline.read(out.cl(), points.data(), points.size() * sizeof(glm::vec3));
    return points;
}

}  // namespace tessera::meshing
