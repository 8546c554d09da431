// A cage refined around one of its points: where OpenSubdiv's levels end, it begins anew.
#include "subdivision/limit_zoom.h"

#include <algorithm>

#include "subdivision/local_refinement.h"

namespace tessera::subdivision {

namespace {

struct Point {
    glm::dvec3 p{0.0};
    void Clear() { p = glm::dvec3(0.0); }
    void AddWithWeight(const Point& other, double weight) { p += weight * other.p; }
};

}  // namespace

LimitZoom::LimitZoom(const Refiner& refiner, std::span<const glm::dvec3> points, const QuadDomains& domains,
                     std::span<const DomainCorner> corners, std::uint32_t levels) {
    std::vector<Point> all(points.size());
    std::transform(points.begin(), points.end(), all.begin(), [](const glm::dvec3& p) { return Point{p}; });
    const QuadDomain& first = domains.domains[corners[0].domain];
    const std::uint32_t point = first.corners[corners[0].corner];
    const bool isVertex = point < domains.vertices;
    std::vector<int> faces;
    for (const DomainCorner& corner : corners) faces.push_back(static_cast<int>(domains.domains[corner.domain].face));
    if (!isVertex) faces.resize(1);
    Neighbourhood<Point> piece = Gatherer<Point>(refiner.GetLevel(0), all).gather(faces, isVertex ? static_cast<int>(point) : -1);
    for (std::uint32_t level = 0; level < levels; ++level) {
        std::vector<int> childOf;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            childOf.push_back(piece.vertex >= 0 ? cornerOf(piece, k) : domains.domains[corners[k].domain].subFace);
        }
        piece = refined(piece, childOf);
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const std::uint32_t corner = corners[k].corner;
        CornerFrame frame;
        frame.level = domains.domains[corners[k].domain].subFace >= 0 ? levels - 1 : levels;
        const std::uint32_t last = (1U << frame.level) - 1;
        frame.u = corner == 1 || corner == 2 ? last : 0;
        frame.v = corner >= 2 ? last : 0;
        frame.turns = (static_cast<std::uint32_t>(cornerOf(piece, k)) + 4 - corner) % 4;
        parts_.push_back({static_cast<std::uint32_t>(piece.faces[k]), frame});
    }
    refiner_ = makeRefiner(piece.cage);
    std::vector<glm::dvec3> places;
    places.reserve(piece.points.size());
    for (const Point& p : piece.points) places.push_back(p.p);
    surface_ = std::make_unique<LimitSurface>(*refiner_, places);
}

bool LimitZoom::setCorner(std::size_t k) { return surface_->setFace(parts_[k].face, parts_[k].frame); }

}  // namespace tessera::subdivision
