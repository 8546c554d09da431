// Forward differencing (Wallis, "Forward differencing", 1990; Schwarz and Stamminger 2009, section 3) against direct evaluation of the
// inner rows of bicubic patches: speed by device times, medians of rounds taken in turn, and error against double precision, in shares
// of the patch's size.
#include "device/session.h"
#include "patch_eval.h"
#include "sample_meshes.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace tessera {
namespace {

constexpr std::array<const char*, 3> kernelNames{"rows_direct", "rows_by_columns", "rows_by_rows"};

KernelSources withRows() {
    KernelSources sources = kernelSources();
    std::ifstream file(TESSERA_BENCH_KERNEL);
    sources["bench/rows.cl"] = std::string(std::istreambuf_iterator<char>(file), {});
    if (!file) throw std::runtime_error("can't read " TESSERA_BENCH_KERNEL);
    return sources;
}

class Comparison {
public:
    void run(int rate);

private:
    [[nodiscard]] double time(const char* name, int rate, std::uint32_t patches);
    [[nodiscard]] double worst(const Mesh& mesh, int rate, std::uint32_t patches);

    DeviceSession session_{-1, withRows(), TESSERA_BENCH_CACHE, 16, {"bench/rows.cl"}};
    DeviceBuffer nets_, points_;
};

double Comparison::time(const char* name, int rate, std::uint32_t patches) {
    session_.timeline.finish();
    session_.timeline.restart(false);
    session_.launch(session_.kernels.with(name, nets_.cl(), patches, rate, points_.cl()), name);
    session_.timeline.finish();
    return session_.timeline.milliseconds().at(name);
}

double Comparison::worst(const Mesh& mesh, int rate, std::uint32_t patches) {
    const std::size_t perPatch = static_cast<std::size_t>(rate) * static_cast<std::size_t>(rate);
    std::vector<float> points(3 * perPatch * patches);
    session_.timeline.read(points_.cl(), points.data(), points.size() * sizeof(float));
    double most = 0;
    for (std::uint32_t patch = 0; patch < std::min(patches, 8U); ++patch) {
        const std::vector<glm::dvec3> net = reference::patchPoints(mesh, patch);
        const double size = reference::patchSize(net);
        for (std::size_t k = 0; k<perPatch; k += perPatch> 65536 ? 7 : 1) {
            const double u = static_cast<double>(k % static_cast<std::size_t>(rate) + 1) / rate;
            const double v = static_cast<double>(k / static_cast<std::size_t>(rate) + 1) / rate;
            const float* p = points.data() + 3 * (perPatch * patch + k);
            const glm::dvec3 seen(p[0], p[1], p[2]);
            most = std::max(most, glm::length(seen - reference::evaluate(mesh.kind, net, u, v).position) / size);
        }
    }
    return most;
}

void Comparison::run(int rate) {
    const auto patches = static_cast<std::uint32_t>(std::max(4, 4194304 / (rate * rate)));
    const Mesh mesh = reference::bumpyBezierMesh(1, patches);
    std::vector<float> nets(std::size_t{48} * patches);
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) nets[48 * (i / 16) + 16 * c + i % 16] = mesh.points[i][static_cast<glm::length_t>(c)];
    const double count = static_cast<double>(patches) * rate * rate;
    nets_ = session_.memory.allocate(Purpose::scene, "nets", nets.size() * sizeof(float));
    points_ = session_.memory.allocate(Purpose::scene, "points", static_cast<std::size_t>(count) * 12);
    session_.timeline.write(nets_.cl(), nets.data(), nets.size() * sizeof(float));
    std::array<std::vector<double>, 3> times;
    for (int round = 0; round < 11; ++round)
        for (std::size_t k = 0; k < 3; ++k) times.at(k).push_back(time(kernelNames.at(k), rate, patches));
    std::printf("%6d", rate);
    for (std::size_t k = 0; k < 3; ++k) {
        std::sort(times.at(k).begin(), times.at(k).end());
        static_cast<void>(time(kernelNames.at(k), rate, patches));
        std::printf("  %9.0f %10.1e", count / times.at(k)[5] / 1e3, worst(mesh, rate, patches));
    }
    std::printf("\n");
}

}  // namespace
}  // namespace tessera

int main() {
    try {
        std::printf("%6s  %20s  %20s  %20s\n", "rate", "direct: M/s, error", "over columns", "over rows");
        tessera::Comparison comparison;
        for (const int rate : {16, 32, 64, 128, 256, 512, 1024}) comparison.run(rate);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "tessera_bench_differences: %s\n", error.what());
        return 1;
    }
    return 0;
}
