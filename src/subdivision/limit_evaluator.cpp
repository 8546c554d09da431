// The limit surface itself, face by face.
#include "subdivision/limit_evaluator.h"

#include <array>

namespace tessera::subdivision {

namespace {

template <typename Vector>
std::span<const float> floats(std::span<const Vector> vectors) {
    static_assert(sizeof(Vector) == sizeof(float) * Vector::length());
    return {vectors.empty() ? nullptr : &vectors.front().x, vectors.size() * Vector::length()};
}

}  // namespace

LimitEvaluator::LimitEvaluator(const Refiner& refiner, std::span<const glm::vec3> points) : maker_(refiner), values_(floats(points)) {}

LimitEvaluator::LimitEvaluator(const Refiner& refiner, std::span<const glm::vec2> textures)
    : maker_(refiner), faceVarying_(true), size_(2), values_(floats(textures)) {}

bool LimitEvaluator::select(const QuadDomain& domain) {
    subFace_ = domain.subFace;
    if (face_ == domain.face) return valid_;
    face_ = domain.face;
    const auto face = static_cast<int>(domain.face);
    valid_ =
        faceVarying_ ? maker_.factory().InitFaceVaryingSurface(face, &surface_, 0) : maker_.factory().InitVertexSurface(face, &surface_);
    if (!valid_) return false;
    maker_.made(surface_);
    const auto count = static_cast<std::size_t>(surface_.GetNumPatchPoints()) * static_cast<std::size_t>(size_);
    patchPoints_.resize(count);
    surface_.GatherControlPoints(values_.data(), Descriptor(size_), patchPoints_.data(), Descriptor(size_));
    surface_.ComputePatchPoints(patchPoints_.data(), Descriptor(size_));
    return true;
}

LimitEvaluator::Coordinate LimitEvaluator::coordinate(double u, double v) const {
    if (subFace_ < 0) return {{u, v}, 1.0};
    Coordinate at{{0.0, 0.0}, 0.5};
    const std::array<double, 2> own{u, v};
    surface_.GetParameterization().ConvertNormalizedSubFaceToCoord(subFace_, own.data(), at.uv);
    return at;
}

glm::dvec3 LimitEvaluator::position(double u, double v) const {
    const Coordinate at = coordinate(u, v);
    std::array<double, 3> p{};
    surface_.Evaluate(at.uv, patchPoints_.data(), Descriptor(size_), p.data());
    return {p[0], p[1], p[2]};
}

LimitPoint LimitEvaluator::evaluate(double u, double v) const {
    const Coordinate at = coordinate(u, v);
    std::array<double, 3> p{}, du{}, dv{};
    surface_.Evaluate(at.uv, patchPoints_.data(), Descriptor(size_), p.data(), du.data(), dv.data());
    const auto vector = [](const std::array<double, 3>& a) { return glm::dvec3(a[0], a[1], a[2]); };
    return {vector(p), at.scale * vector(du), at.scale * vector(dv), glm::dvec3(0.0)};
}

}  // namespace tessera::subdivision
