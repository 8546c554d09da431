// The built-in scenes that have a file of their own, and what all of them are made with.
#pragma once

#include "tessera/scene.h"

#include <glm/glm.hpp>

#include <string>

namespace tessera {

[[nodiscard]] Scene sphereScene();    // one sphere of radius 1
[[nodiscard]] Scene torusScene();     // one torus
[[nodiscard]] Scene quadricsScene();  // every quadric, closed to solids or swept in part
[[nodiscard]] Scene nurbsScene();     // a lobed vase and a tray: rational, of all degrees, knots unevenly spaced
[[nodiscard]] Scene pnScene();        // PN triangles

// Cages, to be made meshes by subdivide().
[[nodiscard]] Scene cubeCreasesScene();  // cubes and hexagonal prisms in rows, all edges creased with 0, 1, 2, 3.5 and 10
[[nodiscard]] Scene characterScene();    // a figure of 9984 quadrilaterals (scene/figure.h)

// A light at infinity: +z of its transform points at `from`, as seen from the origin.
[[nodiscard]] Light lightFrom(std::string lightName, LightKind kind, const glm::vec3& from, const glm::vec3& color, float intensity);

// A warm key light from the left, a cool one from the right and a sky.
void addStudioLights(Scene& scene);

// Adds a camera named "camera".
void addCamera(Scene& scene, const glm::vec3& eye, const glm::vec3& target, float fovyDegrees);

// The rotation that brings what was modelled z up into the world, y up: a quarter turn about x.
[[nodiscard]] glm::quat uprightRotation();

}  // namespace tessera
