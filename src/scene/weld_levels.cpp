// Borders beside finer ones: halves a border's curve as long as other borders end where it is cut.
#include "scene/weld_levels.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <unordered_map>

namespace tessera::welding {

namespace {

constexpr std::uint32_t kFinest = 8;
// A search visits at most so many parts, and a few more for each that it finds: where corners are as dense as the tolerance it would
// find something to halve at every cut.
constexpr std::size_t kFreeVisits = 16;
constexpr std::size_t kVisitsPerPart = 8;

// A border that is alone, by the clusters of its ends.
struct Lone {
    std::uint32_t low, high;
    std::uint32_t border;

    bool operator<(const Lone& other) const { return std::tie(low, high, border) < std::tie(other.low, other.high, other.border); }
};

class Search {
public:
    Search(const Group& group, const Labels& labels, const Matching& matching);

    [[nodiscard]] std::vector<CoarseBorder> run();

private:
    [[nodiscard]] std::array<std::uint32_t, 2> endsOf(std::uint32_t border) const;
    [[nodiscard]] bool cover(CoarseBorder& coarse, const Curve& part, FinePart place);
    [[nodiscard]] std::optional<FinePart> findPart(const Curve& part, FinePart place) const;
    [[nodiscard]] bool sameCurve(const Curve& part, std::uint32_t border, bool against) const;

    const Group& group_;
    const Labels& labels_;
    std::vector<Lone> lone_;               // sorted
    std::vector<std::uint8_t> lonelyEnd_;  // a cluster of corners: whether a border that is alone ends there
    std::vector<std::uint8_t> taken_;      // a border
    double tolerance_ = 0.0;               // of the border that is being halved
    std::size_t visits_ = 0;
};

Search::Search(const Group& group, const Labels& labels, const Matching& matching)
    : group_(group), labels_(labels), lonelyEnd_(labels.cornerPoints().size()), taken_(4 * group.patchCount()) {
    for (std::size_t k = 0; k < matching.classCount(); ++k) {
        const std::uint32_t border = matching.members(k).front();
        if (matching.members(k).size() > 1 || matching.degenerate[border] != 0) continue;
        const auto [first, last] = endsOf(border);
        lonelyEnd_[first] = lonelyEnd_[last] = 1;
        lone_.push_back({std::min(first, last), std::max(first, last), border});
    }
    std::sort(lone_.begin(), lone_.end());
}

std::array<std::uint32_t, 2> Search::endsOf(std::uint32_t border) const {
    const std::array<std::uint32_t, 4> points = labels_.of(group_.place(border / 4).mesh->kind, border);
    return {points[0], points[3]};
}

// Only what lies inside: the ends are known to be in the same clusters.
bool Search::sameCurve(const Curve& part, std::uint32_t border, bool against) const {
    const double tolerance = std::min(tolerance_, group_.tolerance(border));
    const Curve curve = against ? reversed(group_.curve(border)) : group_.curve(border);
    if (glm::distance(part.points[1], curve.points[1]) > tolerance || glm::distance(part.points[2], curve.points[2]) > tolerance)
        return false;
    return static_cast<double>(glm::distance(logWeights(part), logWeights(curve))) <= kWeightTolerance;
}

std::optional<FinePart> Search::findPart(const Curve& part, FinePart place) const {
    const Lone wanted{std::min(place.from, place.to), std::max(place.from, place.to), 0};
    for (auto one = std::lower_bound(lone_.begin(), lone_.end(), wanted); one != lone_.end(); ++one) {
        if (one->low != wanted.low || one->high != wanted.high) break;
        if (taken_[one->border] != 0) continue;
        place.border = one->border;
        place.reversed = endsOf(one->border)[0] != place.from;
        if (sameCurve(part, one->border, place.reversed)) return place;
    }
    return std::nullopt;
}

// Whether finer borders lie along all of `part`; those that lie along some of it are kept too.
bool Search::cover(CoarseBorder& coarse, const Curve& part, FinePart place) {
    if (++visits_ > kFreeVisits + kVisitsPerPart * coarse.parts.size()) return false;
    if (place.level > 0) {
        if (const auto found = findPart(part, place)) {
            taken_[found->border] = 1;
            coarse.parts.push_back(*found);
            return true;
        }
    }
    if (place.level == kFinest || polygonLength(part) <= 2.0 * tolerance_) return false;
    const std::array<Curve, 2> half = halves(part);
    const auto middle = labels_.cornerPoints().nearest(half[0].points[3], tolerance_);
    if (!middle || lonelyEnd_[*middle] == 0 || *middle == place.from || *middle == place.to) return false;
    const bool first = cover(coarse, half[0], {0, place.level + 1, 2 * place.index, false, place.from, *middle});
    const bool second = cover(coarse, half[1], {0, place.level + 1, 2 * place.index + 1, false, *middle, place.to});
    return first && second;
}

std::vector<CoarseBorder> Search::run() {
    std::vector<std::pair<double, std::uint32_t>> order;  // the longest first: what is part of another must not be halved itself
    order.reserve(lone_.size());
    for (const Lone& one : lone_) order.emplace_back(-polygonLength(group_.curve(one.border)), one.border);
    std::sort(order.begin(), order.end());
    std::vector<CoarseBorder> result;
    for (const auto& [length, border] : order) {
        if (taken_[border] != 0) continue;
        taken_[border] = 1;
        tolerance_ = group_.tolerance(border);
        visits_ = 0;
        const auto [from, to] = endsOf(border);
        CoarseBorder coarse{border, {}, false};
        coarse.covered = cover(coarse, group_.curve(border), {0, 0, 0, false, from, to});
        if (coarse.parts.empty()) {
            taken_[border] = 0;
        } else {
            result.push_back(std::move(coarse));
        }
    }
    return result;
}

// How many corners of patches are in each cluster.
std::vector<std::uint32_t> countCorners(const Group& group, const Labels& labels) {
    std::vector<std::uint32_t> counts(labels.cornerPoints().size());
    for (std::size_t m = 0; m < group.meshes().size(); ++m) {
        const Layout& where = layout(group.meshes()[m]->kind);
        for (std::size_t patch = group.firstPatch(m); patch < group.firstPatch(m + 1); ++patch) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (where.corners[k] != kNone) ++counts[labels.corner(patch, k)];
            }
        }
    }
    return counts;
}

// Users of a coarse curve draw a corner that lies inside it by the curve, and any other patch by its own control point. So where others
// are around such a corner, an edge that was closed would open: the parts that end there go without the curve, and so on.
void dropPartsBesideOthers(CoarseBorder& coarse, const std::vector<std::uint32_t>& corners) {
    std::size_t before = 0;
    do {
        before = coarse.parts.size();
        std::unordered_map<std::uint32_t, std::uint32_t> users;
        for (const FinePart& part : coarse.parts) {
            ++users[part.from];
            ++users[part.to];
        }
        std::erase_if(coarse.parts, [&](const FinePart& part) {
            const bool first = part.index == 0, last = part.index + 1 == 1U << part.level;
            return (!first && users[part.from] != corners[part.from]) || (!last && users[part.to] != corners[part.to]);
        });
        coarse.covered = coarse.covered && coarse.parts.size() == before;
    } while (coarse.parts.size() != before);
}

}  // namespace

std::uint32_t CoarseBorder::cuts() const {
    std::uint32_t finest = 0;
    for (const FinePart& part : parts) finest = std::max(finest, part.level);
    return finest;
}

std::vector<CoarseBorder> findLevels(const Group& group, const Labels& labels, const Matching& matching) {
    std::vector<CoarseBorder> levels = Search(group, labels, matching).run();
    if (levels.empty()) return levels;
    const std::vector<std::uint32_t> corners = countCorners(group, labels);
    for (CoarseBorder& coarse : levels) dropPartsBesideOthers(coarse, corners);
    std::erase_if(levels, [](const CoarseBorder& coarse) { return coarse.parts.empty(); });
    return levels;
}

}  // namespace tessera::welding
