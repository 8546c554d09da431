// How fast the vertex stage of a tessellation is by itself: random bicubic patches, all at one rate, warm. Medians of device times.
#include "mesh_vertices_rig.h"
#include "sample_meshes.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

using namespace tessera;

namespace {

mesh_pattern ring(std::uint32_t rate) {
    const std::uint32_t step = (1U << 24) / rate;
    mesh_pattern p{};
    p.form = MESH_RING;
    for (std::uint32_t& side : p.side) side = rate;
    p.cells_u = p.cells_v = rate;
    p.low_u = p.low_v = step;
    p.high_u = p.high_v = (1U << 24) - step;
    return p;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
    const std::string kind = argc > 1 ? argv[1] : "bezier";
    const int rounds = argc > 2 ? std::atoi(argv[2]) : 9;
    meshing::VerticesRig rig(TESSERA_BENCH_CACHE);
    std::printf("%8s %6s %10s %16s %16s\n", kind.c_str(), "rate", "vertices", "full, M/s", "positions, M/s");
    for (const std::uint32_t rate : {4U, 8U, 12U, 14U, 16U, 18U, 24U, 32U, 64U}) {
        const std::size_t patches = std::clamp<std::size_t>(4000000 / ((rate + 1) * (rate + 1)), 1000, 30000);
        Mesh mesh = kind == "pn" ? reference::bumpyPnMesh(1, patches) : reference::bumpyBezierMesh(1, patches);
        if (kind == "rational") mesh = reference::weighted(mesh, 2.0, 2);
        if (kind == "gregory") mesh = reference::asGregory(mesh);
        mesh_pattern pattern = ring(rate);
        if (kind == "pn") pattern = {MESH_TRIANGLE_GRID, {rate, rate, 0, rate}, rate, 0, 0, 0, 0, 0, 0, 0};
        if (kind == "pn" && rate > 3) {
            pattern.low_u = pattern.low_v = (1U << 24) / rate;
            pattern.high_u = (1U << 24) - (1U << 24) / rate;
        }
        rig.set(reference::sceneOf({mesh}), std::vector<mesh_pattern>(patches, pattern));
        const auto vertices = static_cast<double>(rig.offsets().back().vertices);
        std::vector<double> full, positions;
        for (int k = 0; k < rounds; ++k) full.push_back(rig.time(false));
        for (int k = 0; k < rounds; ++k) positions.push_back(rig.time(true));
        std::printf("%8s %6u %10.0f %16.1f %16.1f\n", "", rate, vertices, vertices / median(full) / 1e3,
                    vertices / median(positions) / 1e3);
    }
    return 0;
}
