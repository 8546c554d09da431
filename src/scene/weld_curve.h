// Cubic Bezier curves in double precision, as weld() compares and halves them.
#pragma once

#include <glm/glm.hpp>

#include <array>

#include "tessera/scene.h"

namespace tessera::welding {

struct Curve {
    std::array<glm::dvec3, 4> points{};
    std::array<double, 4> weights{1.0, 1.0, 1.0, 1.0};  // above 0
};

[[nodiscard]] Curve reversed(const Curve& curve);

// The parts over [0, 1/2] and [1/2, 1], by de Casteljau's construction on homogeneous coordinates.
[[nodiscard]] std::array<Curve, 2> halves(const Curve& curve);

[[nodiscard]] double polygonLength(const Curve& curve);

// The greatest distance between control points of the same place.
[[nodiscard]] double distance(const Curve& a, const Curve& b);

// The logarithms of three of the weights over their geometric mean: the same for weights that differ by a common factor, 0 for equal ones.
[[nodiscard]] glm::vec3 logWeights(const Curve& curve);

// Within how much two such triples are the same weights.
constexpr double kWeightTolerance = 1e-5;

// The point at `t` of the record's whole curve, by the operations that the kernels evaluate borders with.
[[nodiscard]] glm::vec3 pointOnRecord(const EdgeRecord& record, float t);

}  // namespace tessera::welding
