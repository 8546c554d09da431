// Makes of what was found in a group what its meshes shall hold: control points with the same bits, and edge records.
#include "scene/weld_apply.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace tessera::welding {

namespace {

bool allEqual(const std::array<float, 4>& weights) {
    return std::all_of(weights.begin(), weights.end(), [&](float weight) { return weight == weights[0]; });
}

// The curve of `border`, whole.
EdgeRecord recordOf(const Curve& curve) {
    EdgeRecord record;
    for (std::size_t k = 0; k < 4; ++k) {
        record.points[k] = glm::vec3(curve.points[k]);
        record.weights[k] = static_cast<float>(curve.weights[k]);
    }
    if (allEqual(record.weights)) record.weights.fill(1.0F);
    return record;
}

class Snapper {
public:
    Snapper(const Group& group, WeldReport& report) : group_(group), report_(report) {}

    void set(std::size_t patch, std::size_t point, const glm::vec3& value) {
        const Group::Place at = group_.place(patch);
        glm::vec3& stored = at.mesh->points[at.patch * pointsPerPatch(at.mesh->kind) + point];
        if (stored != value) {
            ++report_.snappedPoints;
            report_.largestGap = std::max(report_.largestGap, glm::distance(glm::dvec3(stored), glm::dvec3(value)));
        }
        stored = value;
    }

    // The inner points of `border`, in its own direction.
    void setInner(std::uint32_t border, const glm::vec3& first, const glm::vec3& second) {
        const std::array<std::size_t, 4>& side = layout(group_.place(border / 4).mesh->kind).sides[border % 4];
        set(border / 4, side[1], first);
        set(border / 4, side[2], second);
    }

private:
    const Group& group_;
    WeldReport& report_;
};

// Where each cluster of corners goes: to its first point, or where a finer border ends on a coarser one's curve, onto this.
std::vector<glm::vec3> cornerPlaces(const Group& group, const Labels& labels, const std::vector<CoarseBorder>& levels) {
    const PointClusters& corners = labels.cornerPoints();
    std::vector<glm::vec3> places(corners.size());
    for (std::uint32_t k = 0; k < corners.size(); ++k) places[k] = corners.point(corners.cluster(k));
    for (const CoarseBorder& coarse : levels) {
        const std::array<std::uint32_t, 4> ends = labels.of(group.place(coarse.border / 4).mesh->kind, coarse.border);
        EdgeRecord curve = recordOf(group.curve(coarse.border));
        curve.points[0] = corners.point(ends[0]);
        curve.points[3] = corners.point(ends[3]);
        for (const FinePart& part : coarse.parts) {
            const float step = std::ldexp(1.0F, -static_cast<int>(part.level));
            const auto index = static_cast<float>(part.index);
            if (index * step > 0.0F) places[part.from] = pointOnRecord(curve, index * step) + 0.0F;
            if ((index + 1.0F) * step < 1.0F) places[part.to] = pointOnRecord(curve, (index + 1.0F) * step) + 0.0F;
        }
    }
    return places;
}

void snapInner(const Group& group, const Matching& matching, std::span<const std::uint32_t> members, Snapper& snapper) {
    const Curve curve = group.curve(members.front());
    const glm::vec3 first = glm::vec3(curve.points[1]) + 0.0F, second = glm::vec3(curve.points[2]) + 0.0F;
    for (const std::uint32_t border : members) {
        if (matching.flipped[border] == matching.flipped[members.front()]) {
            snapper.setInner(border, first, second);
        } else {
            snapper.setInner(border, second, first);
        }
    }
}

void add(const Group& group, EdgeRecord record, std::uint32_t border) {
    const Group::Place at = group.place(border / 4);
    record.patch = static_cast<std::uint32_t>(at.patch);
    record.side = border % 4;
    at.mesh->edges.push_back(record);
}

PatchKind kindOf(const Group& group, std::uint32_t border) { return group.place(border / 4).mesh->kind; }
bool isRational(const Group& group, std::uint32_t border) { return kindOf(group, border) == PatchKind::rational; }

// Whether the users of a curve would draw it differently though its points are the same to the bit.
bool needRecord(const Group& group, const Matching& matching, std::span<const std::uint32_t> members) {
    const std::uint32_t lowest = members.front();
    const Curve curve = group.curve(lowest);
    return std::any_of(members.begin(), members.end(), [&](std::uint32_t border) {
        if (isRational(group, border) != isRational(group, lowest)) return true;
        const Curve other = group.curve(border);
        return (matching.flipped[border] == matching.flipped[lowest] ? other : reversed(other)).weights != curve.weights;
    });
}

void addClass(const Group& group, const Matching& matching, std::span<const std::uint32_t> members) {
    EdgeRecord record = recordOf(group.curve(members.front()));
    const auto polynomial = [&](std::uint32_t border) { return !isRational(group, border); };
    if (std::any_of(members.begin(), members.end(), polynomial)) record.weights.fill(1.0F);
    for (const std::uint32_t border : members) {
        record.reversed = matching.flipped[border] != matching.flipped[members.front()];
        add(group, record, border);
    }
}

void addLevels(const Group& group, const CoarseBorder& coarse) {
    EdgeRecord record = recordOf(group.curve(coarse.border));
    const auto polynomial = [&](const FinePart& part) { return !isRational(group, part.border); };
    if (std::any_of(coarse.parts.begin(), coarse.parts.end(), polynomial)) record.weights.fill(1.0F);
    record.cuts = coarse.cuts();
    add(group, record, coarse.border);
    for (const FinePart& part : coarse.parts) {
        record.level = part.level;
        record.index = part.index;
        record.reversed = part.reversed;
        add(group, record, part.border);
    }
}

}  // namespace

void snapPoints(const Group& group, const Labels& labels, const Matching& matching, const std::vector<CoarseBorder>& levels,
                WeldReport& report) {
    Snapper snapper(group, report);
    const std::vector<glm::vec3> places = cornerPlaces(group, labels, levels);
    for (std::size_t m = 0; m < group.meshes().size(); ++m) {
        const Layout& where = layout(group.meshes()[m]->kind);
        for (std::size_t patch = group.firstPatch(m); patch < group.firstPatch(m + 1); ++patch) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (where.corners[k] != kNone) snapper.set(patch, where.corners[k], places[labels.corner(patch, k)]);
            }
        }
    }
    for (std::size_t k = 0; k < matching.classCount(); ++k) {
        const std::span<const std::uint32_t> members = matching.members(k);
        if (matching.degenerate[members.front()] == 0) {
            if (members.size() > 1) snapInner(group, matching, members, snapper);
            continue;
        }
        for (const std::uint32_t border : members) {
            const glm::vec3& place = places[labels.of(kindOf(group, border), border)[0]];
            snapper.setInner(border, place, place);
        }
    }
}

void makeRecords(const Group& group, const Matching& matching, const std::vector<CoarseBorder>& levels) {
    for (Mesh* mesh : group.meshes()) mesh->edges.clear();
    for (std::size_t k = 0; k < matching.classCount(); ++k) {
        const std::span<const std::uint32_t> members = matching.members(k);
        if (members.size() == 1 || matching.degenerate[members.front()] != 0) continue;
        if (needRecord(group, matching, members)) addClass(group, matching, members);
    }
    for (const CoarseBorder& coarse : levels) addLevels(group, coarse);
    for (Mesh* mesh : group.meshes()) {
        std::sort(mesh->edges.begin(), mesh->edges.end(), [](const EdgeRecord& a, const EdgeRecord& b) {
            return 4 * std::uint64_t{a.patch} + a.side < 4 * std::uint64_t{b.patch} + b.side;
        });
    }
}

}  // namespace tessera::welding
