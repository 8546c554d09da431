// How near two borders without neighbours come to being the same: looks among those whose ends have the same middle, more or less.
#include "scene/weld_misses.h"

#include "scene/weld_clusters.h"

#include <algorithm>

namespace tessera::welding {

namespace {

constexpr double kReach = 100.0;  // tolerances
constexpr std::size_t kMostCompared = 8;

glm::dvec3 middle(const Curve& curve) { return 0.5 * (curve.points[0] + curve.points[3]); }

bool endsWithin(const Curve& a, const Curve& b, double reach) {
    return glm::distance(a.points[0], b.points[0]) <= reach && glm::distance(a.points[3], b.points[3]) <= reach;
}

}  // namespace

double nearestMiss(const Group& group, std::span<const std::uint32_t> borders) {
    double reach = 0.0;
    for (const std::uint32_t border : borders) reach = std::max(reach, kReach * group.tolerance(border));
    if (!(reach > 0.0)) return 0.0;
    CellGrid grid(2.0 * reach, borders.size());
    double least = 0.0;
    for (const std::uint32_t border : borders) {
        const Curve curve = group.curve(border), backwards = reversed(curve);
        std::size_t compared = 0;
        grid.visitNear(middle(curve), kReach * group.tolerance(border), [&](std::uint32_t other) {
            const Curve beside = group.curve(other);
            const double near = kReach * std::min(group.tolerance(border), group.tolerance(other));
            for (const Curve& way : {curve, backwards}) {
                if (!endsWithin(way, beside, near)) continue;
                const double apart = distance(way, beside);
                if (apart > 0.0 && (least == 0.0 || apart < least)) least = apart;
            }
            return ++compared < kMostCompared;
        });
        grid.insert(middle(curve), border);
    }
    return least;
}

}  // namespace tessera::welding
