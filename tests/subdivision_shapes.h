// Control cages by rule, after the shapes that OpenSubdiv is held against: for tests of subdivision surfaces. The same on every machine.
#pragma once

#include "tessera/cage.h"
#include "tessera/scene.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tessera::test {

struct NamedCage {
    std::string name;
    Cage cage;  // of the same name; manifold, without anything that cleanCage() would repair
};

// Sharpness that shapes try: halves, whole numbers and neither, just below for ever and for ever.
[[nodiscard]] const std::vector<float>& triedSharpness();

// Cubes with every pattern of creased edges (one of each that are alike by symmetry, 144), corners, darts, boundaries by each rule, valence
// 2 to 50, faces of 3 to 12 corners, holes, shells, concave corners, tori, random closed meshes with random tags, texture seams.
[[nodiscard]] std::vector<NamedCage> allShapes();

// Some 20 of these, with something of each.
[[nodiscard]] std::vector<NamedCage> someShapes();

// Every `step`-th of allShapes(), from `first`.
[[nodiscard]] std::vector<NamedCage> everyShape(std::size_t step, std::size_t first = 0);

// A closed mesh of quadrilaterals, a box whose faces grew outwards and apart `steps` times, with tags at random.
[[nodiscard]] NamedCage randomShape(std::uint32_t seed, int steps);

// Numbers of what is drawn: faces without holes, under BoundaryRule::none also without those at a boundary.
struct Drawn {
    std::size_t faces = 0;
    std::size_t boundaryEdges = 0;  // of one drawn face
    long euler = 0;                 // vertices - edges + faces

    [[nodiscard]] bool closed() const { return faces > 0 && boundaryEdges == 0; }
};
[[nodiscard]] Drawn drawnOf(const Cage& cage);

// The box around the points: its diagonal, what errors are relative to.
[[nodiscard]] double sizeOf(const Cage& cage);

// Placed by one object, where it stands, around its own place.
[[nodiscard]] Scene sceneOf(const NamedCage& shape);

}  // namespace tessera::test
