// Scenes that tests of pictures share: flat patches placed on the pixels of a picture, and curved ones that overlap.
#pragma once

#include "sample_meshes.h"

#include "tessera/scene.h"

#include <glm/glm.hpp>

#include <array>
#include <string>

namespace tessera::test {

using Corners = std::array<glm::dvec3, 4>;  // at (u, v) = (0, 0), (1, 0), (1, 1), (0, 1)

// The patch with these corners that is bilinear in (u, v).
[[nodiscard]] Mesh bilinearPatch(const Corners& corners);

// Adds an object of its own mesh, matte and without rotation, and returns it.
Object& addObject(Scene& scene, Mesh mesh, const glm::vec3& color);

// A picture laid over the world: from screenCamera(), the point at(x, y) is seen `x` pixels from the left and `y` from the top.
class Screen {
public:
    Screen(int width, int height) : width_(width), height_(height) {}

    [[nodiscard]] Camera camera() const;
    [[nodiscard]] glm::dvec3 at(double x, double y) const { return at(x, y, depth()); }
    [[nodiscard]] glm::dvec3 at(double x, double y, double depth) const;  // depth: along the view axis
    // Where a unit of the world is a pixel.
    [[nodiscard]] double depth() const { return 0.5 * height_; }

private:
    int width_;
    int height_;
};

// Six patches whose borders meet exactly and that close around the origin: a cube blown up to about this radius,
// normals outward.
[[nodiscard]] Mesh closedMesh(double radius);

// Bezier and Gregory patches of several objects, turned and moved through each other, in matte and plastic.
[[nodiscard]] Scene mixedScene();

// Two objects of one mesh at the same place, in different colours, and a third that crosses them.
[[nodiscard]] Scene coincidentScene();

}  // namespace tessera::test
