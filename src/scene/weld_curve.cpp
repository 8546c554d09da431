// Cubic Bezier curves in double precision: halving and comparing them; and in single precision as the device evaluates them.
#include "scene/weld_curve.h"

#include <algorithm>
#include <cmath>

namespace tessera::welding {

Curve reversed(const Curve& curve) {
    Curve result = curve;
    std::reverse(result.points.begin(), result.points.end());
    std::reverse(result.weights.begin(), result.weights.end());
    return result;
}

std::array<Curve, 2> halves(const Curve& curve) {
    std::array<glm::dvec4, 4> row{};
    for (std::size_t k = 0; k < 4; ++k) row[k] = glm::dvec4(curve.points[k] * curve.weights[k], curve.weights[k]);
    std::array<Curve, 2> result;
    const auto keep = [](Curve& part, std::size_t k, const glm::dvec4& point) {
        part.points[k] = glm::dvec3(point) / point.w;
        part.weights[k] = point.w;
    };
    for (std::size_t done = 0; done < 4; ++done) {
        keep(result[0], done, row[0]);
        keep(result[1], 3 - done, row[3 - done]);
        for (std::size_t k = 0; k + done < 3; ++k) row[k] = 0.5 * (row[k] + row[k + 1]);
    }
    return result;
}

double polygonLength(const Curve& curve) {
    double length = 0.0;
    for (std::size_t k = 0; k < 3; ++k) length += glm::distance(curve.points[k], curve.points[k + 1]);
    return length;
}

double distance(const Curve& a, const Curve& b) {
    double greatest = 0.0;
    for (std::size_t k = 0; k < 4; ++k) greatest = std::max(greatest, glm::distance(a.points[k], b.points[k]));
    return greatest;
}

glm::vec3 logWeights(const Curve& curve) {
    std::array<double, 4> logs{};
    double mean = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        logs[k] = std::log(curve.weights[k]);
        mean += 0.25 * logs[k];
    }
    return {glm::dvec3(logs[0] - mean, logs[1] - mean, logs[2] - mean)};
}

glm::vec3 pointOnRecord(const EdgeRecord& record, float t) {
    const float s = 1.0F - t;
    const std::array<float, 4> basis{(s * s) * s, 3.0F * ((s * s) * t), 3.0F * ((t * t) * s), (t * t) * t};
    const auto blend = [&](const auto& c) { return (c[0] * basis[0] + c[3] * basis[3]) + (c[1] * basis[1] + c[2] * basis[2]); };
    if (std::all_of(record.weights.begin(), record.weights.end(), [](float w) { return w == 1.0F; })) return blend(record.points);
    std::array<glm::vec3, 4> scaled{};
    for (std::size_t k = 0; k < 4; ++k) scaled[k] = record.points[k] * record.weights[k];
    return blend(scaled) / blend(record.weights);
}

}  // namespace tessera::welding
