// A cage's limit surface, evaluated by OpenSubdiv's Bfr in double precision.
#include "subdivision/limit_surface.h"

#include <array>
#include <cmath>
#include <limits>

namespace tessera::subdivision {

namespace {

namespace Bfr = OpenSubdiv::Bfr;
using PointDescriptor = Bfr::Surface<double>::PointDescriptor;

Bfr::SurfaceFactory::Options accurate() {
    Bfr::SurfaceFactory::Options options;
    options.SetApproxLevelSmooth(kLimitLevels).SetApproxLevelSharp(kLimitLevels);
    return options;
}

constexpr std::size_t kMostRemembered = std::size_t{256} << 20U;  // bytes

glm::dvec3 vec(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

}  // namespace

SurfaceMaker::SurfaceMaker(const Refiner& refiner) : refiner_(refiner) { factory_.emplace(refiner_, accurate()); }

void SurfaceMaker::made(const Bfr::Surface<double>& surface) {
    if (surface.IsRegular()) return;
    bytes_ +=
        sizeof(double) * static_cast<std::size_t>(surface.GetNumPatchPoints()) * static_cast<std::size_t>(surface.GetNumControlPoints());
    if (bytes_ <= kMostRemembered) return;
    factory_.emplace(refiner_, accurate());
    bytes_ = 0;
}

LimitSurface::LimitSurface(const Refiner& refiner, std::span<const glm::vec3> points)
    : maker_(refiner), face_(std::numeric_limits<std::uint32_t>::max()) {
    cagePoints_.reserve(3 * points.size());
    for (const glm::vec3& p : points) cagePoints_.insert(cagePoints_.end(), {p.x, p.y, p.z});
}

LimitSurface::LimitSurface(const Refiner& refiner, std::span<const glm::dvec3> points)
    : maker_(refiner), face_(std::numeric_limits<std::uint32_t>::max()) {
    cagePoints_.reserve(3 * points.size());
    for (const glm::dvec3& p : points) cagePoints_.insert(cagePoints_.end(), {p.x, p.y, p.z});
}

bool LimitSurface::setDomain(const QuadDomain& domain) {
    const bool valid = setFace(domain.face, {});
    subFace_ = domain.subFace;
    return valid;
}

bool LimitSurface::setFace(std::uint32_t face, const CornerFrame& frame) {
    subFace_ = -1;
    frame_ = frame;
    if (face == face_) return valid_;
    face_ = face;
    valid_ = maker_.factory().InitVertexSurface(static_cast<int>(face_), &surface_);
    if (!valid_) return false;
    maker_.made(surface_);
    patchPoints_.resize(3 * static_cast<std::size_t>(surface_.GetNumPatchPoints()));
    surface_.PreparePatchPoints(cagePoints_.data(), PointDescriptor(3), patchPoints_.data(), PointDescriptor(3));
    return true;
}

// Bfr keeps the sub-faces of a face apart in one domain, each half as long as its own.
std::array<double, 2> LimitSurface::faceCoordinates(double u, double v) const {
    std::array<double, 2> place{u, v};
    if (subFace_ >= 0) {
        const std::array<double, 2> own = place;
        surface_.GetParameterization().ConvertNormalizedSubFaceToCoord(subFace_, own.data(), place.data());
    }
    if (frame_.level == 0 && frame_.turns == 0) return place;
    const double scale = std::ldexp(1.0, static_cast<int>(frame_.level));
    const double s = u * scale - frame_.u, t = v * scale - frame_.v;
    switch (frame_.turns) {
        case 0:
            return {s, t};
        case 1:
            return {1.0 - t, s};
        case 2:
            return {1.0 - s, 1.0 - t};
        default:
            return {t, 1.0 - s};
    }
}

LimitPoint LimitSurface::turnedBack(LimitPoint p) const {
    const double scale = subFace_ >= 0 ? 0.5 : std::ldexp(1.0, static_cast<int>(frame_.level));
    const glm::dvec3 du = scale * p.du, dv = scale * p.dv, duv = scale * scale * p.duv;
    switch (frame_.turns) {
        case 0:
            return {p.position, du, dv, duv};
        case 1:
            return {p.position, dv, -du, -duv};
        case 2:
            return {p.position, -du, -dv, duv};
        default:
            return {p.position, -dv, du, -duv};
    }
}

LimitPoint LimitSurface::at(double u, double v) const {
    const std::array<double, 2> place = faceCoordinates(u, v);
    std::array<double, 3> p{}, du{}, dv{}, duu{}, duv{}, dvv{};
    surface_.Evaluate(place.data(), patchPoints_.data(), PointDescriptor(3), p.data(), du.data(), dv.data(), duu.data(), duv.data(),
                      dvv.data());
    return turnedBack({vec(p), vec(du), vec(dv), vec(duv)});
}

LimitPoint LimitSurface::tangentsAt(double u, double v) const {
    const std::array<double, 2> place = faceCoordinates(u, v);
    std::array<double, 3> p{}, du{}, dv{};
    surface_.Evaluate(place.data(), patchPoints_.data(), PointDescriptor(3), p.data(), du.data(), dv.data());
    return turnedBack({vec(p), vec(du), vec(dv), glm::dvec3(0.0)});
}

glm::dvec3 LimitSurface::positionAt(double u, double v) const {
    const std::array<double, 2> place = faceCoordinates(u, v);
    std::array<double, 3> p{};
    surface_.Evaluate(place.data(), patchPoints_.data(), PointDescriptor(3), p.data());
    return vec(p);
}

}  // namespace tessera::subdivision
