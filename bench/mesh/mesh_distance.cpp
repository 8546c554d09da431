// A mesh read back from the device, and held against its surface in double precision.
#include "mesh/mesh_distance.h"

#include "mesh/sheet.h"
#include "tessera/error.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tessera::bench {

namespace {

template <typename Element>
std::vector<Element> readBack(cl_command_queue queue, cl_mem buffer, std::size_t count) {
    std::vector<Element> elements(count);
    const cl_int code = clEnqueueReadBuffer(queue, buffer, CL_TRUE, 0, count * sizeof(Element), elements.data(), 0, nullptr, nullptr);
    if (code != CL_SUCCESS) throw Error("the mesh cannot be read from the device: OpenCL error " + std::to_string(code));
    return elements;
}

double distanceOf(const std::array<const MeshVertex*, 3>& corners, const glm::vec3* patch) {
    constexpr std::array<glm::dvec3, 4> places{{{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, {0.5, 0.5, 0.0}, {0.5, 0.0, 0.5}, {0.0, 0.5, 0.5}}};
    double greatest = 0;
    for (const glm::dvec3& place : places) {
        glm::dvec3 flat(0.0);
        glm::dvec2 at(0.0);
        for (int k = 0; k < 3; ++k) {
            const MeshVertex& corner = *corners[static_cast<std::size_t>(k)];
            flat += place[k] * glm::dvec3(corner.position[0], corner.position[1], corner.position[2]);
            at += place[k] * glm::dvec2(corner.u, corner.v);
        }
        greatest = std::max(greatest, glm::length(flat - bezierPoint(patch, at.x, at.y)));
    }
    return greatest;
}

}  // namespace

double greatestDistance(const DeviceMesh& mesh, std::span<const glm::vec3> points) {
    const std::vector<MeshVertex> vertices = readBack<MeshVertex>(mesh.queue, mesh.vertices, mesh.sizes.vertices);
    const std::vector<std::uint32_t> indices = readBack<std::uint32_t>(mesh.queue, mesh.indices, 3 * mesh.sizes.triangles);
    double greatest = 0;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const std::array<const MeshVertex*, 3> corners{&vertices.at(indices[i]), &vertices.at(indices[i + 1]),
                                                       &vertices.at(indices[i + 2])};
        const std::size_t first = 16 * std::size_t{corners[0]->patch};
        if (first + 16 > points.size()) throw Error("the mesh names patch " + std::to_string(corners[0]->patch) + ", which is none");
        greatest = std::max(greatest, distanceOf(corners, &points[first]));
    }
    return greatest;
}

}  // namespace tessera::bench
