// OpenSubdiv's Bfr on a ring that stands alone: its outer vertices' rings are cut off, which the surface of its first face does not see.
#include "subdivision/table_limit.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>

#include <algorithm>

#include "subdivision/refiner.h"
#include "tessera/error.h"

namespace tessera::subdivision {
namespace {

namespace Bfr = OpenSubdiv::Bfr;

// Levels down to which Bfr isolates irregular vertices and creases: points of a table are vertices of level 5, beside which it is exact
// from level 6 on; sharpness below 10 takes 10.
constexpr int smoothLevels = 10;
constexpr int sharpLevels = 10;

}  // namespace

void RingCage::addFace(std::array<std::uint32_t, 4> face) {
    std::array<std::uint32_t, 4> sorted = face;
    std::rotate(sorted.begin(), std::min_element(sorted.begin(), sorted.end()), sorted.end());
    if (!faces_.insert(sorted).second) return;
    cage_.faceSizes.push_back(4);
    cage_.faceVertices.insert(cage_.faceVertices.end(), face.begin(), face.end());
}

void RingCage::addRing(std::uint32_t corner, const CornerRing& ring, std::uint32_t firstFace) {
    for (std::uint32_t k = 0; k < ring.faces(); ++k) {
        const std::uint32_t face = (firstFace + k) % ring.faces();
        addFace({corner, ring.ends[face], ring.diagonals[face], ring.ends[ring.edge(face, 1)]});
    }
    if (ring.sharpness > 0) cage_.corners.push_back({corner, ring.sharpness});
    for (std::size_t k = 0; k < ring.ends.size(); ++k) {
        const std::uint32_t end = ring.ends[k];
        if (ring.edgeSharpness[k] > 0 && creases_.insert({std::min(corner, end), std::max(corner, end)}).second)
            cage_.creases.push_back({corner, end, ring.edgeSharpness[k]});
    }
}

Cage RingCage::cage(std::uint32_t vertices) const {
    Cage cage = cage_;
    cage.name = "a table's ring";
    cage.boundary = BoundaryRule::edgeOnly;
    cage.points.resize(vertices);
    return cage;
}

struct FirstFace::Surface {
    std::unique_ptr<Refiner> refiner;
    std::unique_ptr<Bfr::Surface<double>> surface;
    std::vector<int> indices;
    std::array<std::vector<double>, 3> weights;
};

FirstFace::FirstFace(const Cage& cage) : surface_(std::make_unique<Surface>()) {
    using Factory = Bfr::RefinerSurfaceFactory<>;
    surface_->refiner = makeRefiner(cage);
    const Factory factory(*surface_->refiner, Factory::Options().SetApproxLevelSmooth(smoothLevels).SetApproxLevelSharp(sharpLevels));
    surface_->surface.reset(factory.CreateVertexSurface<double>(0));
    if (surface_->surface == nullptr) throw Error("a face's neighbourhood has no limit surface; repair the cage");
    const auto count = static_cast<std::size_t>(surface_->surface->GetNumControlPoints());
    surface_->indices.resize(count);
    surface_->surface->GetControlPointIndices(surface_->indices.data());
    for (std::vector<double>& weights : surface_->weights) weights.resize(count);
    for (std::vector<double>& sum : sums_) sum.resize(cage.points.size());
}

FirstFace::~FirstFace() = default;

const std::array<std::vector<double>, 3>& FirstFace::at(double u, double v) {
    const std::array<double, 2> place{u, v};
    std::array<std::vector<double>, 3>& weights = surface_->weights;
    surface_->surface->EvaluateStencil(place.data(), weights[0].data(), weights[1].data(), weights[2].data());
    for (std::size_t d = 0; d < 3; ++d) {
        std::fill(sums_[d].begin(), sums_[d].end(), 0.0);
        for (std::size_t k = 0; k < weights[d].size(); ++k) sums_[d][static_cast<std::size_t>(surface_->indices[k])] += weights[d][k];
    }
    return sums_;
}

}  // namespace tessera::subdivision
