// Pixels held against rays through them and all around them.
#include "leaks.h"

#include "picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace tessera::test {

namespace {

// The greatest depth at which the rays through the centres of a pixel and its eight neighbours first meet the model beyond the near
// plane; infinity where one does not.
double deepestAround(const reference::RayCaster& caster, const reference::View& view, int x, int y) {
    double deepest = 0.0;
    for (const int down : {0, -1, 1}) {
        for (const int right : {0, -1, 1}) {
            const std::optional<reference::Hit> hit = caster.cast(view.ray(x + right + 0.5, y + down + 0.5), view.near());
            if (!hit) return std::numeric_limits<double>::infinity();
            deepest = std::max(deepest, hit->t);
        }
    }
    return deepest;
}

// Models are 2 wide or so: this much beyond where the surface can be is its far side, seen through a crack in the near one.
constexpr double throughCrack = 0.05;

bool deeperThanANeighbour(const Kept& picture, int x, int y) {
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, picture.height() - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, picture.width() - 1); ++i)
            if (static_cast<double>(picture.z(x, y) - picture.z(i, j)) > throughCrack) return true;
    return false;
}

}  // namespace

Leaks leaksOf(const Kept& picture, const reference::RayCaster& caster, const Camera& camera) {
    const reference::View view(camera, picture.width(), picture.height());
    Leaks leaks;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            const bool covered = picture.alpha(x, y) >= 1.0F;
            leaks.covered += covered ? 1 : 0;
            if (covered && !deeperThanANeighbour(picture, x, y)) continue;
            const double deepest = deepestAround(caster, view, x, y);
            const bool open = !covered && std::isfinite(deepest);
            const bool through = covered && static_cast<double>(picture.z(x, y)) > deepest + throughCrack;
            leaks.open += open ? 1 : 0;
            leaks.through += through ? 1 : 0;
            if ((open || through) && leaks.first.empty()) leaks.first = "first at (" + std::to_string(x) + ", " + std::to_string(y) + ")";
        }
    }
    return leaks;
}

}  // namespace tessera::test
