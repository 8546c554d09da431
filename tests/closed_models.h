// Closed solids, whose neighbouring patches share their borders to the bit, and views of them: for tests of what must have no crack.
// All are made from seeds, the same on every machine.
#pragma once

#include "sample_meshes.h"

#include "tessera/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tessera::test {

struct ClosedModel {
    std::string name;
    Scene scene;
};

// A cube blown up to a rough ball of radius 1 or so around the origin, of 6 x along x along bicubic patches whose parameters run any of
// the eight ways. Its borders are creases.
[[nodiscard]] Mesh cubeSolid(std::uint64_t seed, int along);

// The same with weights of 1/3 to 3, shared along borders.
[[nodiscard]] Mesh weightedCubeSolid(std::uint64_t seed, int along);

// A rough ball of `around` x `along` bicubic patches by longitude and latitude: borders at the poles are single points.
[[nodiscard]] Mesh polarSolid(std::uint64_t seed, int around, int along);

enum class TriangleLook {
    smooth,   // one normal a corner
    creased,  // half of the triangles have normals of their own
    flat,
};

// A cube blown up like cubeSolid(), of 12 x along x along triangles, through pnMesh().
[[nodiscard]] Mesh triangleSolid(std::uint64_t seed, int along, TriangleLook look);

// The solid of cubeSolid(), each of its 6 x along x along parts of one of these kinds, with a mesh for each kind in their order. Where pn
// is chosen the part is two triangles. Gregory patches have face points apart. Rational patches have one weight all along their borders,
// another than their neighbours': such a solid closes only after weld(), others as they are.
[[nodiscard]] std::vector<Mesh> mixedSolid(std::uint64_t seed, int along, const std::vector<PatchKind>& kinds);

// One object a mesh, all turned and moved alike, away from the origin by up to 3 along each axis.
[[nodiscard]] Scene placedAnyhow(std::vector<Mesh> meshes, std::uint64_t seed);

// One model and more of each kind above, an exact sphere and an exact torus.
[[nodiscard]] std::vector<ClosedModel> closedModels();

enum class ViewKind {
    far,               // of all of it, some 10 to 60 pixels wide in a picture 96 high
    near,              // a part of it fills the picture
    grazing,           // along the surface from just above it
    throughNearPlane,  // the surface crosses the near plane
    inside,            // from around the middle
    aside,             // near the picture's border or beyond it, or behind the eye
};

// Requires a scene whose objects stand around one middle, a unit or so in radius.
[[nodiscard]] Camera randomView(const Scene& scene, ViewKind kind, std::uint64_t seed);

}  // namespace tessera::test
