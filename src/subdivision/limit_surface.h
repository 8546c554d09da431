// A cage's limit surface, evaluated by OpenSubdiv's Bfr in double precision.
#pragma once

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "subdivision/quad_domains.h"

namespace tessera::subdivision {

// Derivatives are by the parameters of the domain, from whose side they are taken.
struct LimitPoint {
    glm::dvec3 position{0.0};
    glm::dvec3 du{0.0}, dv{0.0}, duv{0.0};
};

// Levels of Bfr's own isolation, beyond which it approximates. Its patches' places have ten bits each: with more levels it writes where it
// must not.
constexpr int kLimitLevels = 10;

// A domain's corner as a face of a cage that was refined around it: the face is the corner's cell of a level.
struct CornerFrame {
    std::uint32_t level = 0;     // 0: the face is the domain
    std::uint32_t u = 0, v = 0;  // the cell
    std::uint32_t turns = 0;     // of a quarter: the domain's corner k is the face's k + turns
};

// Bfr's factory, made anew before what it remembers takes too much memory: it keeps the coefficients of every irregular topology met, and
// those of semi-sharp creases at a vertex of hundreds of faces are tens of megabytes a face.
class SurfaceMaker {
public:
    using Factory = OpenSubdiv::Bfr::RefinerSurfaceFactory<>;

    // `refiner` must stay.
    explicit SurfaceMaker(const Refiner& refiner);

    // To initialise a surface with.
    [[nodiscard]] const Factory& factory() const { return *factory_; }
    // Tells of one that was initialised; surfaces stay what they are.
    void made(const OpenSubdiv::Bfr::Surface<double>& surface);

private:
    const Refiner& refiner_;
    std::optional<Factory> factory_;
    std::size_t bytes_ = 0;  // that are remembered, at most
};

class LimitSurface {
public:
    // `refiner` must stay. Points are as many as its vertices.
    LimitSurface(const Refiner& refiner, std::span<const glm::vec3> points);
    LimitSurface(const Refiner& refiner, std::span<const glm::dvec3> points);

    // The domain that at() shall be of; false where there is no surface (faces at boundaries that are not drawn).
    // Domains of one face in a row cost as much as one.
    [[nodiscard]] bool setDomain(const QuadDomain& domain);
    // A face of four corners that stands for part of a domain. at() takes the domain's parameters, within the part, and derives by them.
    [[nodiscard]] bool setFace(std::uint32_t face, const CornerFrame& frame);
    // Whether the domain is one bicubic patch.
    [[nodiscard]] bool isRegular() const { return surface_.IsRegular(); }

    // u, v within 0 to 1. Exact to rounding, but for what lies within 2^-kLimitLevels (of the face) of an irregular corner: at the corner
    // itself position and the directions of du and dv are exact, their lengths and duv mean nothing.
    [[nodiscard]] LimitPoint at(double u, double v) const;
    // The same without duv, which is 0 then, in half the time.
    [[nodiscard]] LimitPoint tangentsAt(double u, double v) const;
    [[nodiscard]] glm::dvec3 positionAt(double u, double v) const;

private:
    [[nodiscard]] std::array<double, 2> faceCoordinates(double u, double v) const;
    [[nodiscard]] LimitPoint turnedBack(LimitPoint p) const;

    SurfaceMaker maker_;
    std::vector<double> cagePoints_;
    OpenSubdiv::Bfr::Surface<double> surface_;
    std::vector<double> patchPoints_;
    std::uint32_t face_;
    bool valid_ = false;
    int subFace_ = -1;
    CornerFrame frame_;
};

}  // namespace tessera::subdivision
