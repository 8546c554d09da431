// OpenSubdiv's patch table turned into cells.
#include "subdivision/gregory_cells.h"

#include <opensubdiv/far/patchTable.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/ptexIndices.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

#include "tessera/error.h"

namespace tessera::subdivision {

namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

// Where faces are as far from the limit as at smooth irregular vertices: on a cube with a dart 0.25 at level 0, 0.028 at 1, 0.014 at 2 and
// 0.0067 at 3, which is what the smooth cube has; deeper ones stay there.
constexpr int kTipLevel = 3;

// What OpenSubdiv's templates add up.
struct FarPoint {
    glm::dvec3 p{0.0};

    void Clear() { p = glm::dvec3(0.0); }
    void AddWithWeight(const FarPoint& other, double weight) { p += weight * other.p; }
};

using Points = std::vector<FarPoint>;
using Net = std::array<glm::dvec3, 16>;

// Uniform cubic B-spline to Bezier, along one direction of a net.
void toBezier(Net& net, std::size_t first, std::size_t step) {
    const glm::dvec3 a = net[first], b = net[first + step], c = net[first + 2 * step], d = net[first + 3 * step];
    net[first] = (a + 4.0 * b + c) / 6.0;
    net[first + step] = (4.0 * b + 2.0 * c) / 6.0;
    net[first + 2 * step] = (2.0 * b + 4.0 * c) / 6.0;
    net[first + 3 * step] = (b + 4.0 * c + d) / 6.0;
}

// Points beyond boundaries, which the table leaves open, lie as far out as those inside lie inward. Bits: v = 0, u = 1, v = 1, u = 0.
void extendBeyond(Net& net, unsigned boundary) {
    constexpr std::array<std::array<std::size_t, 3>, 4> outward{{{0, 4, 8}, {3, 2, 1}, {12, 8, 4}, {0, 1, 2}}};
    for (std::size_t side = 0; side < 4; ++side) {
        if (((boundary >> side) & 1U) == 0) continue;
        const std::size_t along = side % 2 == 0 ? 1 : 4;
        const auto [out, border, in] = outward[side];
        for (std::size_t k = 0; k < 4; ++k) net[out + k * along] = 2.0 * net[border + k * along] - net[in + k * along];
    }
}

Net bicubic(Net net, unsigned boundary) {
    extendBeyond(net, boundary);
    for (std::size_t row = 0; row < 4; ++row) toBezier(net, 4 * row, 1);
    for (std::size_t column = 0; column < 4; ++column) toBezier(net, column, 4);
    return net;
}

// Corners (0, 0), (1, 0), (1, 1), (0, 1).
Net bilinear(const std::array<glm::dvec3, 4>& corners) {
    Net net;
    for (std::size_t k = 0; k < net.size(); ++k) {
        const std::size_t column = k % 4, row = k / 4;
        const double u = static_cast<double>(column) / 3.0, v = static_cast<double>(row) / 3.0;
        net[k] = (1 - v) * ((1 - u) * corners[0] + u * corners[1]) + v * ((1 - u) * corners[3] + u * corners[2]);
    }
    return net;
}

std::unique_ptr<Refiner> refined(const Refiner& base, const Far::PatchTableFactory::Options& options, const GregoryIsolation& isolation) {
    std::unique_ptr<Refiner> refiner(Far::TopologyRefinerFactory<Far::TopologyDescriptor>::Create(base));
    Far::TopologyRefiner::AdaptiveOptions adaptive = options.GetRefineAdaptiveOptions();
    adaptive.SetSecondaryLevel(isolation.irregularLevel);
    // With no face given all would be.
    if (isolation.faces.empty()) adaptive.SetIsolationLevel(0);
    refiner->RefineAdaptive(adaptive, Far::ConstIndexArray(isolation.faces.data(), static_cast<int>(isolation.faces.size())));
    return refiner;
}

// Vertices of all levels, and behind them the points that the table adds.
Points allPoints(const Refiner& refiner, const Far::PatchTable& table, std::span<const glm::vec3> given) {
    const auto vertices = static_cast<std::size_t>(refiner.GetNumVerticesTotal());
    Points points(vertices + static_cast<std::size_t>(table.GetNumLocalPoints()));
    for (std::size_t k = 0; k < given.size(); ++k) points[k].p = glm::dvec3(given[k]);
    const Far::PrimvarRefinerReal<double> refine(refiner);
    FarPoint* from = points.data();
    for (int level = 1; level <= refiner.GetMaxLevel(); ++level) {
        FarPoint* const to = from + refiner.GetLevel(level - 1).GetNumVertices();
        refine.Interpolate(level, from, to);
        from = to;
    }
    if (table.GetNumLocalPoints() > 0) {
        const FarPoint* const source = points.data();
        FarPoint* const local = points.data() + vertices;
        table.GetLocalPointStencilTable<double>()->UpdateValues(source, local);
    }
    return points;
}

class CellMaker {
public:
    CellMaker(const Refiner& base, const Far::PatchTable& table, const Points& points, const QuadDomains& domains)
        : table_(table), points_(points) {
        const Far::PtexIndices ptex(base);
        domainOf_.resize(static_cast<std::size_t>(ptex.GetNumFaces()));
        for (std::size_t k = 0; k < domains.domains.size(); ++k) {
            const QuadDomain& domain = domains.domains[k];
            const int face = ptex.GetFaceId(static_cast<int>(domain.face)) + std::max(domain.subFace, 0);
            domainOf_[static_cast<std::size_t>(face)] = static_cast<std::uint32_t>(k);
        }
    }

    std::vector<Cell> make() {
        for (int array = 0; array < table_.GetNumPatchArrays(); ++array)
            for (int patch = 0; patch < table_.GetNumPatches(array); ++patch) add(array, patch);
        std::stable_sort(cells_.begin(), cells_.end(), [](const Cell& a, const Cell& b) { return a.domain < b.domain; });
        return std::move(cells_);
    }

private:
    void add(int array, int patch) {
        const Far::PatchParam param = table_.GetPatchParam(array, patch);
        Cell cell;
        cell.domain = domainOf_[static_cast<std::size_t>(param.GetFaceId())];
        // Domains of other than quads are themselves a level down.
        const unsigned level = param.GetDepth() - (param.NonQuadRoot() ? 1U : 0U);
        cell.levelU = cell.levelV = level;
        cell.u = param.GetU();
        cell.v = param.GetV();
        const Far::ConstIndexArray indices = table_.GetPatchVertices(array, patch);
        const auto at = [&](std::size_t k) { return points_[static_cast<std::size_t>(indices[static_cast<int>(k)])].p; };
        switch (table_.GetPatchArrayDescriptor(array).GetType()) {
            case Far::PatchDescriptor::REGULAR: {
                Net net;
                for (std::size_t k = 0; k < net.size(); ++k) net[k] = at(k);
                net = bicubic(net, param.GetBoundary());
                std::copy(net.begin(), net.end(), cell.points.begin());
                break;
            }
            case Far::PatchDescriptor::GREGORY_BASIS:
                cell.kind = PatchKind::gregory;
                // OpenSubdiv goes from corner to corner: p, e+, e-, f+, f- of each.
                for (std::size_t corner = 0; corner < 4; ++corner)
                    for (std::size_t k = 0; k < 5; ++k) cell.points[4 * k + corner] = at(5 * corner + k);
                break;
            case Far::PatchDescriptor::QUADS: {
                const Net net = bilinear({at(0), at(1), at(2), at(3)});
                std::copy(net.begin(), net.end(), cell.points.begin());
                break;
            }
            default:
                throw Error("OpenSubdiv made a patch that is no quadrilateral; use the exact surface for this scheme");
        }
        cells_.push_back(cell);
    }

    const Far::PatchTable& table_;
    const Points& points_;
    std::vector<std::uint32_t> domainOf_;  // of a Ptex face
    std::vector<Cell> cells_;
};

// Levels for which something is sharp; 0 for what is so for ever.
int levelsSharp(float sharpness) { return Sdc::Crease::IsInfinite(sharpness) ? 0 : static_cast<int>(std::ceil(std::max(sharpness, 0.0F))); }

// What calls for smaller patches, found at the vertices.
class IsolationFinder {
public:
    explicit IsolationFinder(const Refiner& refiner)
        : base_(refiner.GetLevel(0)), smooth_(refiner.GetSchemeType() == Sdc::SCHEME_CATMARK) {}

    GregoryIsolation find() {
        std::vector<bool> marked(static_cast<std::size_t>(base_.GetNumFaces()));
        for (int vertex = 0; vertex < base_.GetNumVertices(); ++vertex) {
            if (!needed(vertex)) continue;
            for (const int face : base_.GetVertexFaces(vertex)) marked[static_cast<std::size_t>(face)] = true;
        }
        for (int face = 0; face < base_.GetNumFaces(); ++face)
            if (marked[static_cast<std::size_t>(face)]) found_.faces.push_back(face);
        found_.level = std::min(found_.level, kDeepestGregoryLevel);
        return std::move(found_);
    }

private:
    bool needed(int vertex) {
        int level = 0;
        for (const int face : base_.GetVertexFaces(vertex))
            if (base_.GetFaceVertices(face).size() != 4) level = 1;
        if (smooth_) {
            int sharpEdges = 0;
            for (const int edge : base_.GetVertexEdges(vertex)) {
                const float sharpness = base_.GetEdgeSharpness(edge);
                level = std::max(level, levelsSharp(sharpness));
                if (Sdc::Crease::IsInfinite(sharpness)) ++sharpEdges;
            }
            const float sharpness = base_.GetVertexSharpness(vertex);
            level = std::max(level, levelsSharp(sharpness));
            if (sharpEdges == 1 || (sharpEdges == 0 && Sdc::Crease::IsInfinite(sharpness))) {
                found_.irregularLevel = kTipLevel;
                level = std::max(level, kTipLevel);
            }
        }
        found_.level = std::max(found_.level, level);
        return level > 0;
    }

    const Far::TopologyLevel& base_;
    bool smooth_;
    GregoryIsolation found_;
};

}  // namespace

GregoryIsolation gregoryIsolation(const Refiner& refiner) { return IsolationFinder(refiner).find(); }

std::vector<Cell> gregoryCells(const Refiner& refiner, std::span<const glm::vec3> points, const QuadDomains& domains) {
    const GregoryIsolation isolation = gregoryIsolation(refiner);
    Far::PatchTableFactory::Options options(static_cast<unsigned>(isolation.level));
    options.SetEndCapType(Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
    options.SetPatchPrecision<double>();
    options.useInfSharpPatch = true;
    options.generateVaryingTables = false;
    options.generateLegacySharpCornerPatches = false;
    const std::unique_ptr<Refiner> own = refined(refiner, options, isolation);
    const std::unique_ptr<const Far::PatchTable> table(Far::PatchTableFactory::Create(*own, options));
    return CellMaker(refiner, *table, allPoints(*own, *table, points), domains).make();
}

}  // namespace tessera::subdivision
