// Meshes for tests, made from a seed: the same on every machine.
#pragma once

#include "tessera/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tessera::reference {

// Numbers without a pattern; the standard's distributions differ between libraries.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    [[nodiscard]] double unit();  // 0 to 1
    [[nodiscard]] double between(double low, double high) { return low + (high - low) * unit(); }
    [[nodiscard]] glm::dvec3 inCube(double halfWidth);  // each coordinate -halfWidth to halfWidth

private:
    std::uint64_t state_;
};

// Bumpy bicubic sheets about 1.5 wide, turned and placed anyhow within a cube 2 wide around the origin.
[[nodiscard]] Mesh bumpyBezierMesh(std::uint64_t seed, std::size_t patches);

// The same surfaces as Gregory patches, f+ = f-.
[[nodiscard]] Mesh asGregory(const Mesh& bezier);

// f+ and f- moved apart by up to `distance` each: blends that are truly rational.
[[nodiscard]] Mesh parted(const Mesh& gregory, double distance, std::uint64_t seed);

// The same nets as rational patches, each weight 1 / factor to factor.
[[nodiscard]] Mesh weighted(const Mesh& bezier, double factor, std::uint64_t seed);

// Bumpy cubic triangles with normals that lean anyhow, less than half a right angle from the triangle's own, placed like
// bumpyBezierMesh()'s patches.
[[nodiscard]] Mesh bumpyPnMesh(std::uint64_t seed, std::size_t patches);

// One object a mesh, all without rotation, at the origin; meshes are named "mesh0", "mesh1", ...
[[nodiscard]] Scene sceneOf(std::vector<Mesh> meshes);

// A camera at `eye` that looks at `target`, y up; unlike the library's, with this library's own arithmetic.
[[nodiscard]] Camera cameraAt(const glm::dvec3& eye, const glm::dvec3& target, double fovyDegrees);

}  // namespace tessera::reference
