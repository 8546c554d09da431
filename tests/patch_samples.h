// Single patches of each kind, as tests of the reference surfaces and of their pieces evaluate them.
#pragma once

#include "patch_eval.h"
#include "sample_meshes.h"

#include <cstdint>
#include <vector>

namespace tessera::reference {

// What an evaluator needs of one patch.
struct Sample {
    PatchKind kind;
    std::vector<glm::dvec3> points;
    std::vector<double> weights{};

    [[nodiscard]] SurfacePoint at(double u, double v) const { return evaluate(kind, points, u, v, weights); }
};

[[nodiscard]] inline Sample sampleOf(const Mesh& mesh) { return {mesh.kind, patchPoints(mesh, 0), patchWeights(mesh, 0)}; }

// A Gregory patch whose blends are truly rational.
[[nodiscard]] inline Sample blendedSample(std::uint64_t seed) {
    return sampleOf(parted(asGregory(bumpyBezierMesh(seed, 1)), 0.3, seed + 1000));
}

// One of each kind in turn.
[[nodiscard]] inline Sample someSample(std::uint64_t seed) {
    switch (seed % 4) {
        case 0:
            return sampleOf(bumpyBezierMesh(seed, 1));
        case 1:
            return blendedSample(seed);
        case 2:
            return sampleOf(weighted(bumpyBezierMesh(seed, 1), 4.0, seed + 2000));
        default:
            return sampleOf(bumpyPnMesh(seed, 1));
    }
}

}  // namespace tessera::reference
