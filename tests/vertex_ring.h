// The quadrilaterals around one vertex of a subdivided mesh: all that its limit depends on.
#pragma once

#include "catmull_clark_reference.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace tessera::test {

// One step of subdivision on from `sharpness`.
[[nodiscard]] float lessSharp(float sharpness);

// How much of the edge's point is a crease's: 0 to 1.
[[nodiscard]] double creaseShare(float sharpness);

// What meets at a vertex, and where its next point goes.
struct VertexRule {
    glm::dvec3 vertex{0.0};
    float sharpness = 0.0F;                // the vertex' own
    std::vector<glm::dvec3> edges;         // their other ends
    std::vector<float> edgeSharpness;      // as many
    std::vector<glm::dvec3> facePoints{};  // middles of the faces around

    [[nodiscard]] glm::dvec3 next() const;
};

// Quadrilateral k lies between edges k and k + 1, counter-clockwise seen from outside. `edges` are the ends of the edges, `across` the
// corners of the quadrilaterals opposite the vertex. A closed ring has as many edges as quadrilaterals, an open one another edge.
struct VertexRing {
    glm::dvec3 vertex{0.0};
    float sharpness = 0.0F;
    std::vector<glm::dvec3> edges;
    std::vector<float> edgeSharpness;
    std::vector<glm::dvec3> across;

    [[nodiscard]] bool closed() const { return edges.size() == across.size(); }
    [[nodiscard]] VertexRing next() const;

    // The limit of the vertex, and of normals towards it from quadrilateral `quad`.
    [[nodiscard]] LimitPoint limit(std::size_t quad) const;
};

}  // namespace tessera::test
