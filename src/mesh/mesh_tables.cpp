// The first two stages' buffers and launches.
#include "mesh/mesh_tables.h"

#include <algorithm>

#include "mesh/offsets.h"

namespace tessera {
namespace {

constexpr std::size_t factorsGroup = 64;  // work-items, on every device: one a patch

std::uint64_t patternsBytes(std::uint64_t patches) { return patches * sizeof(mesh_pattern); }

}  // namespace

std::uint64_t MeshTables::bytes(std::uint32_t patches) {
    return DeviceMemory::bytesFor(patternsBytes(patches)) + DeviceMemory::bytesFor(sumsBytes(patches)) +
           DeviceMemory::bytesFor(offsetsBytes(patches)) + DeviceMemory::bytesFor(totalsBytes());
}

void MeshTables::reserve(std::uint32_t patches) {
    const auto fit = [&](DeviceBuffer& buffer, const char* name, std::uint64_t bytes) {
        session_.memory.ensure(buffer, Purpose::queues, name, bytes);
    };
    fit(patterns_, "the patches' patterns", patternsBytes(patches));
    fit(sums_, "the patterns' sums", sumsBytes(patches));
    fit(offsets_, "the patterns' offsets", offsetsBytes(patches));
    fit(totals_, "the patterns' totals", totalsBytes());
}

void MeshTables::release() {
    for (DeviceBuffer* buffer : {&patterns_, &sums_, &offsets_, &totals_}) *buffer = DeviceBuffer();
}

void MeshTables::enqueue(const frame_params& frame, const mesh_view& view, const PatchSet& patches, const cl::Buffer& turned) {
    if (patches.patches > 0) {
        const std::size_t groups = std::min<std::size_t>((patches.patches + factorsGroup - 1) / factorsGroup, session_.device.shape.groups);
        session_.timeline.launch(session_.kernels.with("mesh_factors", frame, view, patches.eyePoints.cl(), patches.placed.cl(),
                                                       patches.records.cl(), turned, patterns_.cl()),
                                 "mesh_factors", groups, factorsGroup);
    }
    enqueueOffsets(session_, patches.patches, patterns_.cl(), sums_.cl(), offsets_.cl(), totals_.cl());
}

mesh_totals MeshTables::totals() {
    mesh_totals totals{};
    session_.timeline.read(totals_.cl(), &totals, sizeof totals);
    return totals;
}

void MeshTables::readPatterns(std::uint32_t patches, mesh_pattern* patterns) {
    if (patches > 0) session_.timeline.read(patterns_.cl(), patterns, patternsBytes(patches));
}

void MeshTables::readOffsets(std::uint32_t patches, mesh_offset* offsets) {
    session_.timeline.read(offsets_.cl(), offsets, offsetsBytes(patches));
}

}  // namespace tessera
