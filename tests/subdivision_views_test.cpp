// Pictures of subdivided cages have no pinhole: over closed cages nothing of the background shows where the solid certainly is, nor its far
// side, from a hundred views.
#include "closed_models.h"
#include "frames.h"
#include "leaks.h"
#include "subdivision_shapes.h"
#include "tessera/subdivision.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

constexpr int kSide = 128;  // pixels, both ways
constexpr std::size_t kViewsOfAShape = 5;

RenderOptions watertightOptions(std::size_t k) {
    RenderOptions options = pictureOptions(kSide, kSide, 1);
    options.mode = DiceMode::watertight;
    options.background = {1.0F, 0.0F, 1.0F, 0.0F};
    options.method = k % 3 == 2 ? SplitMethod::breadth : SplitMethod::bounded;
    options.gridSize = std::array{8, 16, 2, 32, 4}[k % 5];
    options.shadingRate = std::array{1.0F, 4.0F, 0.25F}[k / 3 % 3];
    return options;
}

// Closed, and around one middle.
std::vector<NamedCage> solids(std::size_t count) {
    std::vector<NamedCage> chosen;
    const std::vector<NamedCage> all = allShapes();
    for (std::size_t k = 0; k < all.size() && chosen.size() < count; ++k) {
        const NamedCage& shape = all[(k * 37 + 5) % all.size()];
        if (drawnOf(shape.cage).closed() && !shape.name.starts_with("shells")) chosen.push_back(shape);
    }
    return chosen;
}

TEST(SubdivisionViews, ShowNothingThroughClosedCages) {
    constexpr std::array kinds{ViewKind::near, ViewKind::far, ViewKind::grazing, ViewKind::throughNearPlane};
    Renderer renderer(testSettings());
    std::size_t view = 0;
    int covered = 0;
    for (const NamedCage& shape : solids(20)) {
        Scene scene = sceneOf(shape);
        SubdivisionOptions how;
        how.surface = view / kViewsOfAShape % 3 == 2 ? SubdivisionSurface::gregory : SubdivisionSurface::exact;
        static_cast<void>(subdivide(scene, how));
        renderer.setScene(scene);
        const reference::RayCaster caster(scene);
        for (std::size_t k = 0; k < kViewsOfAShape; ++k, ++view) {
            const Camera camera = randomView(scene, kinds[(view + view / 4) % kinds.size()], 5000 + view);
            const Leaks leaks = leaksOf(draw(renderer, camera, watertightOptions(view)), caster, camera);
            SCOPED_TRACE(shape.name + ", view " + std::to_string(view) + ": " + leaks.first);
            EXPECT_EQ(leaks.open, 0);
            EXPECT_EQ(leaks.through, 0);
            covered += leaks.covered;
        }
    }
    EXPECT_EQ(view, 100U);
    EXPECT_GT(covered, 100 * 1000);
}

}  // namespace
}  // namespace tessera::test
