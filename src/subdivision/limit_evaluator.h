// The limit surface itself, face by face, in double precision (OpenSubdiv's Bfr).
#pragma once

#include <opensubdiv/bfr/surface.h>

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "subdivision/limit_surface.h"
#include "subdivision/quad_domains.h"
#include "subdivision/refiner.h"

namespace tessera::subdivision {

class LimitEvaluator {
public:
    // Of the vertices, or of face-varying channel 0 (z is then 0). What is given must stay; the refiner is unrefined.
    LimitEvaluator(const Refiner& refiner, std::span<const glm::vec3> points);
    LimitEvaluator(const Refiner& refiner, std::span<const glm::vec2> textures);

    // To be called before others; returns false where a domain has no limit surface. Quick for a domain of the same face as the last.
    [[nodiscard]] bool select(const QuadDomain& domain);

    // Whether the face's surface is a single polynomial, bicubic or of lower degree.
    [[nodiscard]] bool polynomial() const { return surface_.IsRegular() || (surface_.IsLinear() && surface_.GetFaceSize() == 4); }

    // The face's surface depends on so many points of the cage.
    [[nodiscard]] int controlPoints() const { return surface_.GetNumControlPoints(); }

    // Both parameters 0 to 1 across the domain.
    [[nodiscard]] glm::dvec3 position(double u, double v) const;
    // Without duv, which is 0.
    [[nodiscard]] LimitPoint evaluate(double u, double v) const;

private:
    using Descriptor = OpenSubdiv::Bfr::Surface<double>::PointDescriptor;

    struct Coordinate {
        double uv[2];  // as Bfr takes them
        double scale;  // its units in one of the domain's
    };
    [[nodiscard]] Coordinate coordinate(double u, double v) const;

    SurfaceMaker maker_;
    bool faceVarying_ = false;
    int size_ = 3;  // numbers a point
    std::span<const float> values_;
    std::optional<std::uint32_t> face_;
    std::int32_t subFace_ = -1;
    bool valid_ = false;
    OpenSubdiv::Bfr::Surface<double> surface_;
    std::vector<double> patchPoints_;
};

}  // namespace tessera::subdivision
