// A cage's limit surface cut into bicubic patches: how small cells at irregular corners have to be, and then all cells.
#include "subdivision/limit_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "subdivision/cell_cutter.h"
#include "subdivision/limit_zoom.h"

namespace tessera::subdivision {

namespace {

// Relative to the cage's size: rounding stays far below, and what is no bicubic patch far above.
constexpr double kExact = 1e-9;
// Of an irregular corner's last cell, where the tolerance is kFine of the cage's size or less; a tenth of a degree is promised, and samples
// are not all points. Heights fall by four from level to level where angles fall by two.
constexpr double kCapAngle = 0.08 * 3.14159265358979 / 180.0;
constexpr double kFine = 2e-6;
// Of the cage's size: the single precision of points holds no better angles in narrower cells.
constexpr double kNarrow = 1e-4;

// How often a face's edge may be halved towards an irregular corner: as given, and in a cage refined around the corner. Cells beside
// OpenSubdiv's own last one would have corners on its border, where it answers from within.
constexpr std::uint32_t kPlainDepth = kLimitLevels - 1;
constexpr std::uint32_t kZoomLevels = 6;

// Of the cage, or of its coordinates where it lies far from the origin: what numbers there hold no more is no reason to cut.
double sizeOf(std::span<const glm::vec3> points) {
    if (points.empty()) return 0.0;
    glm::dvec3 low(points[0]), high(points[0]);
    for (const glm::vec3& p : points) {
        low = glm::min(low, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
    }
    const glm::dvec3 largest = glm::max(glm::abs(low), glm::abs(high));
    return std::max({glm::distance(low, high), largest.x, largest.y, largest.z});
}

// How much less often a domain is halved than a face's edge: a part of a face is one itself. In all of its corners but the face's middle,
// where only parts of that face meet, this matters to neighbours.
std::uint32_t headStart(const QuadDomain& domain) { return domain.subFace >= 0 ? 1 : 0; }

class LimitCells {
public:
    LimitCells(const Refiner& refiner, std::span<const glm::vec3> points, const QuadDomains& domains, const LimitOptions& options)
        : refiner_(refiner),
          points_(points.begin(), points.end()),
          limit_(refiner, points),
          domains_(domains),
          progress_(options.progress),
          size_(sizeOf(points)),
          tolerance_(std::max(options.tolerance, std::numeric_limits<float>::epsilon() * size_)),
          angle_(kCapAngle * std::sqrt(std::max(1.0, options.tolerance / std::max(kFine * size_, 1e-300)))),
          depths_(domains.points),
          irregular_(domains.domains.size()) {}

    std::vector<Cell> make(LimitCounts& counts) {
        for (std::uint32_t k = 0; k < domains_.domains.size(); ++k) {
            measureCorners(k);
            tell(0.0, k, domains_.domains.size());
        }
        for (std::uint32_t k = 0; k < domains_.domains.size(); ++k) {
            const std::size_t before = cells_.size();
            cutDomain(k);
            if (cells_.size() == before + 1) ++counts.regularDomains;
            tell(0.4, k, domains_.domains.size());
        }
        const std::map<std::uint32_t, std::vector<DomainCorner>> toZoom = cornersToZoom();
        std::size_t zoomed = 0;
        for (const auto& [point, corners] : toZoom) {
            zoom(corners);
            tell(0.8, zoomed++, toZoom.size());
        }
        std::stable_sort(cells_.begin(), cells_.end(), [](const Cell& a, const Cell& b) { return a.domain < b.domain; });
        for (const std::array<bool, 4>& corners : irregular_) {
            counts.cappedCorners += static_cast<std::size_t>(std::count(corners.begin(), corners.end(), true));
        }
        for (const Cell& cell : cells_) {
            counts.deepestLevel = std::max<std::size_t>(counts.deepestLevel, std::max(cell.levelU, cell.levelV));
        }
        return std::move(cells_);
    }

private:
    // Item `done` of a part of the work that begins at `from`; the last part is half as long as the others.
    void tell(double from, std::size_t done, std::size_t items) const {
        if (!progress_ || done % 64 != 0) return;
        progress_("subdivide", from + (from < 0.8 ? 0.4 : 0.2) * static_cast<double>(done) / static_cast<double>(items));
    }

    static constexpr std::uint32_t kTooDeep = kPlainDepth + 1;

    // Finds which corners of the domain are irregular, and how small the cells around them have to be.
    void measureCorners(std::uint32_t index) {
        const QuadDomain& domain = domains_.domains[index];
        if (!limit_.setDomain(domain) || limit_.isRegular()) return;
        for (std::uint32_t corner = 0; corner < 4; ++corner) {
            // What is semi-sharp is smooth by then.
            const CellBox last = cornerBox(corner, kLimitLevels - headStart(domain));
            const BicubicNet net = hermiteNet(limit_, last);
            // In proportion to the cell: everything is nearly bicubic where it is so small.
            const double width = std::max(glm::distance(net[0], net[15]), glm::distance(net[3], net[12]));
            if (isLimit(limit_, last, net, 1e-4 * width)) continue;
            irregular_[index][corner] = true;
            std::uint32_t& depth = depths_[domain.corners[corner]];
            // The first halving parts a domain's corners from each other.
            depth = std::max(depth, firstFit(limit_, corner, 1, kPlainDepth - headStart(domain)) + headStart(domain));
        }
    }

    // The first level from `low` to `high` at which the cell in the corner is good enough; high + 1 where none is.
    [[nodiscard]] std::uint32_t firstFit(const LimitSurface& limit, std::uint32_t corner, std::uint32_t low, std::uint32_t high) const {
        for (std::uint32_t level = low; level <= high; ++level) {
            const CellBox box = cornerBox(corner, level);
            const BicubicNet net = capNet(limit, box, corner);
            const bool narrow = std::max(glm::distance(net[0], net[15]), glm::distance(net[3], net[12])) < kNarrow * size_;
            const FitError most{std::numeric_limits<double>::infinity(), tolerance_,
                                narrow ? std::numeric_limits<double>::infinity() : angle_};
            const FitError error = fitError(limit, box, net, most);
            if (error.height <= most.height && error.angle <= most.angle) return level;
        }
        return high + 1;
    }

    void cutDomain(std::uint32_t index) {
        const QuadDomain& domain = domains_.domains[index];
        if (!limit_.setDomain(domain)) return;
        CutRules rules;
        rules.exact = kExact * size_;
        rules.deepest = kLimitLevels - headStart(domain);
        for (std::uint32_t corner = 0; corner < 4; ++corner) {
            if (!irregular_[index][corner]) continue;
            const std::uint32_t depth = depths_[domain.corners[corner]];
            rules.leftOut[corner] = depth == kTooDeep;
            rules.depths[corner] = (depth == kTooDeep ? kZoomLevels : depth) - headStart(domain);
        }
        CellCutter(limit_, index, rules, cells_).add({});
    }

    [[nodiscard]] std::map<std::uint32_t, std::vector<DomainCorner>> cornersToZoom() const {
        std::map<std::uint32_t, std::vector<DomainCorner>> found;
        for (std::uint32_t k = 0; k < domains_.domains.size(); ++k) {
            for (std::uint32_t corner = 0; corner < 4; ++corner) {
                const std::uint32_t point = domains_.domains[k].corners[corner];
                if (irregular_[k][corner] && depths_[point] == kTooDeep) found[point].push_back({k, corner});
            }
        }
        return found;
    }

    // The cells of all domains around a point in their corners, as small as it takes. One point after the other: refined cages are large.
    void zoom(const std::vector<DomainCorner>& corners) {
        LimitZoom zoomed(refiner_, points_, domains_, corners, kZoomLevels);
        std::uint32_t depth = 0;  // of faces' edges
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const std::uint32_t start = headStart(domains_.domains[corners[k].domain]), level = kZoomLevels - start;
            if (!zoomed.setCorner(k)) continue;
            const std::uint32_t deepest = level + kPlainDepth;
            depth = std::max(depth, start + std::min(firstFit(zoomed.surface(), corners[k].corner, level + 1, deepest), deepest));
        }
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const std::uint32_t start = headStart(domains_.domains[corners[k].domain]), level = kZoomLevels - start;
            if (!zoomed.setCorner(k)) continue;
            CutRules rules;
            rules.exact = kExact * size_;
            rules.deepest = level + kPlainDepth;
            rules.depths[corners[k].corner] = depth - start;
            CellCutter(zoomed.surface(), corners[k].domain, rules, cells_).add(cornerBox(corners[k].corner, level));
        }
    }

    const Refiner& refiner_;
    std::vector<glm::dvec3> points_;
    LimitSurface limit_;
    const QuadDomains& domains_;
    const Progress& progress_;
    double size_;                        // scene units
    double tolerance_;                   // scene units
    double angle_;                       // radians
    std::vector<std::uint32_t> depths_;  // of the domains' points that are irregular corners: how often faces' edges are halved there
    std::vector<std::array<bool, 4>> irregular_;  // a domain's corners
    std::vector<Cell> cells_;
};

}  // namespace

std::vector<Cell> limitCells(const Refiner& refiner, std::span<const glm::vec3> points, const QuadDomains& domains,
                             const LimitOptions& options, LimitCounts* counts) {
    LimitCounts ignored;
    return LimitCells(refiner, points, domains, options).make(counts != nullptr ? *counts : ignored);
}

}  // namespace tessera::subdivision
