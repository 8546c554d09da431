// The kernels' own pattern.clh, so that host and device agree on every number.
#include "mesh/pattern.h"

#include "device/lanes_host.h"

// clang-format off
#include "device/kernel_headers_begin.h"
namespace tessera::kernels {
#include "mesh/pattern.clh"
}  // namespace tessera::kernels
#include "device/kernel_headers_end.h"
// clang-format on

namespace tessera {

std::uint64_t patternVertices(const mesh_pattern& pattern) { return kernels::mesh_vertex_count(&pattern); }

std::uint64_t patternTriangles(const mesh_pattern& pattern) { return kernels::mesh_triangle_count(&pattern); }

std::uint32_t patternLoop(const mesh_pattern& pattern) { return kernels::mesh_loop(&pattern); }

std::uint32_t patternUnits(const mesh_pattern& pattern) { return kernels::mesh_units(&pattern); }

mesh_offset unitsBefore(const mesh_pattern& pattern, std::uint32_t unit) { return kernels::mesh_units_before(&pattern, unit); }

void unitVertexNumbers(const mesh_pattern& pattern, std::uint32_t unit, std::vector<std::uint64_t>& numbers) {
    const kernels::mesh_unit part = kernels::mesh_unit_of(&pattern, unit);
    numbers.resize(kernels::mesh_unit_vertices(&pattern, part));
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = kernels::mesh_unit_vertex(&pattern, part, static_cast<std::uint32_t>(k));
}

std::uint64_t firstCellTriangle(const mesh_pattern& pattern, std::uint32_t unit) {
    const kernels::mesh_unit part = kernels::mesh_unit_of(&pattern, unit);
    const std::uint64_t triangles = kernels::mesh_unit_triangles(&pattern, part);
    if (pattern.form != MESH_RING || part.side >= 0) return triangles;
    return triangles - kernels::mesh_rows_triangles(&pattern, part.first_row, part.end_row);
}

std::uint32_t loopVertex(const mesh_pattern& pattern, int side, std::uint32_t i) { return kernels::mesh_loop_vertex(&pattern, side, i); }

}  // namespace tessera
