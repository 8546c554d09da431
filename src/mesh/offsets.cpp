// Launches of the second stage's three kernels.
#include "mesh/offsets.h"

#include <algorithm>

namespace tessera {

void enqueueOffsets(DeviceSession& session, std::uint32_t patches, const cl::Buffer& patterns, const cl::Buffer& sums,
                    const cl::Buffer& offsets, const cl::Buffer& totals) {
    const std::uint64_t blocks = sumsBytes(patches) / sizeof(mesh_totals);
    const auto groups = static_cast<std::size_t>(std::min<std::uint64_t>(session.device.shape.groups, blocks));
    const cl_uint count = patches;
    if (groups > 0) session.launch(session.kernels.with("mesh_sums", count, patterns, sums), "mesh_sums", groups);
    session.launch(session.kernels.with("mesh_scan", count, sums, offsets, totals), "mesh_scan", 1);
    if (groups > 0) session.launch(session.kernels.with("mesh_offsets", count, patterns, sums, offsets), "mesh_offsets", groups);
}

}  // namespace tessera
