// Which borders are the same curve from end to end: those whose points are in the same clusters, one way round or the other.
#include "scene/weld_match.h"

#include <algorithm>
#include <tuple>

namespace tessera::welding {

namespace {

struct Key {
    std::array<std::uint32_t, 4> points;
    std::uint32_t weights;
    std::uint32_t border;

    [[nodiscard]] bool sameCurve(const Key& other) const { return points == other.points && weights == other.weights; }
    bool operator<(const Key& other) const {
        return std::tie(points, weights, border) < std::tie(other.points, other.weights, other.border);
    }
};

// Points that have the direction that both users of a border would choose, and whether that is not the border's own.
bool orient(std::array<std::uint32_t, 4>& points) {
    std::array<std::uint32_t, 4> other = points;
    std::reverse(other.begin(), other.end());
    if (!(other < points)) return false;
    points = other;
    return true;
}

std::vector<Key> makeKeys(const Group& group, const Labels& labels, std::vector<std::uint8_t>& flipped) {
    std::vector<Key> keys;
    keys.reserve(4 * group.patchCount());
    PointClusters weights(group.patchCount());
    const std::uint32_t equalWeights = weights.add(glm::vec3(0.0F), kWeightTolerance);
    for (std::size_t m = 0; m < group.meshes().size(); ++m) {
        const PatchKind kind = group.meshes()[m]->kind;
        for (std::size_t border = 4 * group.firstPatch(m); border < 4 * group.firstPatch(m + 1); ++border) {
            if (layout(kind).ends[border % 4][0] == kNone) continue;
            const auto number = static_cast<std::uint32_t>(border);
            Key key{labels.of(kind, number), equalWeights, number};
            flipped[border] = orient(key.points) ? 1 : 0;
            if (kind == PatchKind::rational) {
                const Curve curve = group.curve(number);
                key.weights = weights.add(logWeights(flipped[border] != 0 ? reversed(curve) : curve), kWeightTolerance);
            }
            keys.push_back(key);
        }
    }
    weights.settle();
    for (Key& key : keys) key.weights = weights.cluster(key.weights);
    return keys;
}

// One border that is shorter than the tolerance collapses all that are the same: neighbours must not decide differently.
void markDegenerate(const Group& group, std::span<const std::uint32_t> members, Matching& matching) {
    std::size_t extended = 0;
    bool collapse = false;
    for (const std::uint32_t border : members) {
        const double length = polygonLength(group.curve(border));
        collapse = collapse || length == 0.0 || length < group.tolerance(border);
        if (length > 0.0) ++extended;
    }
    if (!collapse) return;
    matching.collapsed += extended;
    for (const std::uint32_t border : members) matching.degenerate[border] = 1;
}

}  // namespace

Labels::Labels(const Group& group) : cornerPoints_(4 * group.patchCount()), innerPoints_(8 * group.patchCount()) {
    corners_.reserve(4 * group.patchCount());
    inner_.reserve(8 * group.patchCount());
    for (std::size_t m = 0; m < group.meshes().size(); ++m) add(*group.meshes()[m], group.firstPatch(m), group.meshTolerance(m));
    cornerPoints_.settle();
    innerPoints_.settle();
}

void Labels::add(const Mesh& mesh, std::size_t firstPatch, double tolerance) {
    const Layout& where = layout(mesh.kind);
    corners_.resize(4 * (firstPatch + mesh.patchCount()), 0);
    inner_.resize(2 * corners_.size(), 0);
    for (std::size_t patch = 0; patch < mesh.patchCount(); ++patch) {
        const glm::vec3* points = &mesh.points[patch * pointsPerPatch(mesh.kind)];
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t number = 4 * (firstPatch + patch) + k;
            if (where.corners[k] != kNone) corners_[number] = cornerPoints_.add(points[where.corners[k]], tolerance);
            if (where.ends[k][0] == kNone) continue;
            for (std::size_t j = 0; j < 2; ++j) inner_[2 * number + j] = innerPoints_.add(points[where.sides[k][j + 1]], tolerance);
        }
    }
}

std::array<std::uint32_t, 4> Labels::of(PatchKind kind, std::uint32_t border) const {
    const std::array<std::size_t, 2>& ends = layout(kind).ends[border % 4];
    const std::size_t number = border;
    return {corner(number / 4, ends[0]), innerPoints_.cluster(inner_[2 * number]), innerPoints_.cluster(inner_[2 * number + 1]),
            corner(number / 4, ends[1])};
}

Matching matchBorders(const Group& group, const Labels& labels) {
    Matching matching;
    matching.flipped.resize(4 * group.patchCount());
    matching.degenerate.resize(4 * group.patchCount());
    std::vector<Key> keys = makeKeys(group, labels, matching.flipped);
    std::sort(keys.begin(), keys.end());
    matching.borders.reserve(keys.size());
    for (std::size_t k = 0; k < keys.size(); ++k) {
        if (k == 0 || !keys[k].sameCurve(keys[k - 1])) matching.classes.push_back(k);
        matching.borders.push_back(keys[k].border);
    }
    matching.classes.push_back(keys.size());
    for (std::size_t k = 0; k < matching.classCount(); ++k) {
        const Key& first = keys[matching.classes[k]];
        if (first.points[0] == first.points[3]) markDegenerate(group, matching.members(k), matching);
    }
    return matching;
}

}  // namespace tessera::welding
