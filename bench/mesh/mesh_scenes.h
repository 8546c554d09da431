// The scenes of Schwarz and Stamminger's tables 1 and 2, made again by rule, and the views that are measured of them.
#pragma once

#include "tessera/scene.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace tessera::bench {

// All are valid, lit and have cameras. Units are arbitrary; y is up.
[[nodiscard]] Scene teaTable();     // 332 patches, bicubic and rational; camera "camera"
[[nodiscard]] Scene sphereCloud();  // 4000 spheres, 32000 rational patches, in a cube of side 2; cameras "far" and "near"
[[nodiscard]] Scene doubleTorus();  // one closed PN mesh of genus 2, 1536 patches; camera "camera"
[[nodiscard]] Scene starField();    // 1729 stars, 41496 PN patches, closed; cameras "far" and "close"
[[nodiscard]] Scene zoo();          // eleven closed PN meshes, 80578 patches; camera "camera"

// `single` eight times in two rows, with a camera of its own. Meshes are shared. Throws Error where `single` has no objects.
[[nodiscard]] Scene herd(const Scene& single);

// A row of a table.
struct MeshTrial {
    std::string name;
    int table = 1;            // of the paper: 1 is Bezier patches, 2 PN triangles
    std::size_t patches = 0;  // placed, or of the base mesh; 0 where a file says
    std::string camera;       // of the scene; "" is its first
    std::function<Scene()> make;
};

// In the order of the paper's tables. The Killeroo and its herd are there where `folder` has killeroo.mscene and the build reads files.
[[nodiscard]] std::vector<MeshTrial> meshTrials(const std::string& folder);

}  // namespace tessera::bench
