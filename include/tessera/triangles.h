// Triangle meshes as curved PN triangles (Vlachos, Peters, Boyd, Mitchell: "Curved PN Triangles", 2001).
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tessera/scene.h"

namespace tessera {

// Corners index `positions`; each corner of each triangle has a normal of its own, so that creases are possible.
struct TriangleMesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
    std::vector<std::array<glm::vec3, 3>> normals;        // one triple a triangle, need not be of unit length; empty: none are known
};

// What was repaired or left out on the way; all counts.
struct TriangleRepairs {
    std::size_t weldedPositions = 0;    // positions equal to the bit that became one
    std::size_t droppedNotFinite = 0;   // triangles with a corner that is not finite or beyond 1e9
    std::size_t droppedBadIndex = 0;    // triangles with an index that is none
    std::size_t droppedDegenerate = 0;  // triangles with two corners in one place. Three places on a line stay: neighbours meet there
    std::size_t droppedDuplicates = 0;  // triangles with the same three corners as an earlier one, whichever way round
    std::size_t flippedTriangles = 0;   // turned so that neighbours agree
    std::size_t unorientedEdges = 0;    // edges along which two triangles still disagree (one-sided surfaces)
    std::size_t nonManifoldEdges = 0;   // edges of three or more triangles
    std::size_t boundaryEdges = 0;      // edges of one triangle
    std::size_t computedNormals = 0;    // corners whose normal was missing, zero or not finite, and was computed by angle
};

// Patches of kind pn. Triangles that share an edge share its curve to the bit, also where their normals differ along it (the curve is then
// the mean of both sides'); so do triangles of other meshes whose normals along it are the same. Connected pieces of a mesh are turned the
// way that the greater part of each is. `flat`: plain triangles with their own normals. Throws Error naming the mesh when no triangle with
// an area is left, there are more than 2^31 - 1, or normals and triangles differ in number. `repairs`, where given, is told what was done.
[[nodiscard]] Mesh pnMesh(const TriangleMesh& triangles, bool flat, TriangleRepairs* repairs = nullptr);

}  // namespace tessera
