// A cage refined around one of its points: where OpenSubdiv's levels end, it begins anew.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "subdivision/limit_surface.h"

namespace tessera::subdivision {

struct DomainCorner {
    std::uint32_t domain = 0;
    std::uint32_t corner = 0;
};

class LimitZoom {
public:
    // Around the point of which `corners` are the domains' corners: a vertex, or the middle of a face of other than four corners. Faces'
    // edges are halved `levels` times, at least once.
    LimitZoom(const Refiner& refiner, std::span<const glm::dvec3> points, const QuadDomains& domains, std::span<const DomainCorner> corners,
              std::uint32_t levels);

    // Sets the surface to the k-th of the corners; false where there is none. Its frame's level is `levels`, or one less in a part of a
    // face.
    [[nodiscard]] bool setCorner(std::size_t k);
    [[nodiscard]] const LimitSurface& surface() const { return *surface_; }

private:
    struct Part {
        std::uint32_t face = 0;
        CornerFrame frame;
    };

    std::unique_ptr<Refiner> refiner_;
    std::unique_ptr<LimitSurface> surface_;
    std::vector<Part> parts_;
};

}  // namespace tessera::subdivision
