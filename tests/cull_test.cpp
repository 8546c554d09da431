// Culling takes nothing that can be seen: what an independent ray caster sees of a patch is in the picture.
#include "closed_models.h"
#include "frames.h"
#include "picture.h"
#include "picture_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace tessera::test {
namespace {

constexpr int width = 80;
constexpr int height = 56;

using PatchName = std::pair<std::size_t, std::size_t>;  // object, and patch of its mesh

// Chords sag: what is nearer than this share of the near plane's distance may be drawn before it, and so not at all.
constexpr double sureDepth = 1.1;

// Calls visit(x, y) for a pixel and its neighbours; false as soon as one is.
template <typename Visit>
bool allAround(int x, int y, const Visit& visit) {
    for (int down = -1; down <= 1; ++down)
        for (int right = -1; right <= 1; ++right)
            if (!visit(x + right, y + down)) return false;
    return true;
}

PatchName drawnAt(const Kept& picture, int x, int y) {
    return {static_cast<std::size_t>(picture.object(x, y)), static_cast<std::size_t>(picture.patch(x, y))};
}

struct Missing {
    std::size_t seen = 0;  // patches that fill a pixel and all around it in the ray caster's picture
    int pixels = 0;        // of these pixels, those at which the picture does not show the patch
    std::string first;
};

// The ray caster's picture with a pixel more on each side, so that what is culled along the picture's own border is missed too.
reference::Picture exactPicture(const reference::RayCaster& caster, Camera camera) {
    const double half = std::tan(glm::radians(static_cast<double>(camera.fovy)) / 2.0) * (height + 2) / height;
    camera.fovy = static_cast<float>(glm::degrees(2.0 * std::atan(half)));
    return castPicture(caster, reference::View(camera, width + 2, height + 2));
}

// Whether a pixel no farther than `reach` shows the patch.
bool showsWithin(const Kept& drawn, int x, int y, int reach, const PatchName& patch) {
    for (int j = std::max(y - reach, 0); j <= std::min(y + reach, height - 1); ++j)
        for (int i = std::max(x - reach, 0); i <= std::min(x + reach, width - 1); ++i)
            if (drawn.covered(i, j) && drawnAt(drawn, i, j) == patch) return true;
    return false;
}

Missing missingFrom(const Kept& drawn, const reference::Picture& exact, double near, int reach) {
    std::set<PatchName> seen;
    Missing missing;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const reference::Hit& hit = exact.at(x + 1, y + 1).hit;
            const PatchName patch{hit.object, hit.patch};
            const auto showsIt = [&](int i, int j) {
                const reference::Pixel& pixel = exact.at(i + 1, j + 1);
                return pixel.covered && pixel.z > sureDepth * near && PatchName{pixel.hit.object, pixel.hit.patch} == patch;
            };
            if (!allAround(x, y, showsIt)) continue;
            seen.insert(patch);
            // The tip of a nearer sheet may cover a pixel's middle with a chord where the curve passes by it.
            const bool hidden = drawn.covered(x, y) && static_cast<double>(drawn.z(x, y)) < exact.at(x + 1, y + 1).z;
            if (showsWithin(drawn, x, y, reach, patch) || (hidden && drawnAt(drawn, x, y) != patch)) continue;
            if (missing.pixels++ == 0) {
                missing.first = "patch " + std::to_string(patch.second) + " of object " + std::to_string(patch.first) + " at (" +
                                std::to_string(x) + ", " + std::to_string(y) + ")";
            }
        }
    }
    missing.seen = seen.size();
    return missing;
}

// Scenes whose objects stand around one middle, of all kinds of patches, and some without any order.
std::vector<ClosedModel> scenes() {
    std::vector<ClosedModel> result = closedModels();
    using namespace reference;
    const Mesh gregory = parted(asGregory(bumpyBezierMesh(42, 6)), 0.2, 43);
    result.push_back({"old_sheets", placedAnyhow({bumpyBezierMesh(41, 6), gregory}, 47)});
    result.push_back({"new_sheets", placedAnyhow({weighted(bumpyBezierMesh(44, 6), 5.0, 45), bumpyPnMesh(46, 6)}, 48)});
    return result;
}

// Classical mode knows the first two kinds of patches alone.
bool canDraw(DiceMode mode, const Scene& scene) {
    const auto isNew = [](const Mesh& mesh) { return mesh.kind != PatchKind::bezier && mesh.kind != PatchKind::gregory; };
    return mode == DiceMode::watertight || std::none_of(scene.meshes.begin(), scene.meshes.end(), isNew);
}

class Cull : public testing::TestWithParam<DiceMode> {};

TEST_P(Cull, TakesNothingThatTheRayCasterSees) {
    Renderer renderer(testSettings());
    constexpr std::array kinds{ViewKind::aside, ViewKind::grazing, ViewKind::throughNearPlane, ViewKind::far, ViewKind::inside};
    constexpr std::array methods{SplitMethod::bounded, SplitMethod::cpu, SplitMethod::breadth};
    constexpr std::array gridSizes{16, 32, 4, 8};
    // Classical mode has cracks, a pixel wide.
    const int reach = GetParam() == DiceMode::classical ? 1 : 0;
    std::size_t seen = 0;
    std::uint64_t seed = 5000;
    for (const ClosedModel& model : scenes()) {
        if (!canDraw(GetParam(), model.scene)) continue;
        renderer.setScene(model.scene);
        const reference::RayCaster caster(model.scene);
        for (std::size_t k = 0; k < 10; ++k) {
            RenderOptions options = pictureOptions(width, height, 1);
            options.mode = GetParam();
            options.method = methods[k % methods.size()];
            options.gridSize = gridSizes[k % gridSizes.size()];
            options.splitBound = std::array{8.0F, 16.0F}[k % 2];
            options.diceRate = std::array{8, 16}[k % 2];
            const Camera camera = randomView(model.scene, kinds[k % kinds.size()], ++seed);
            const reference::Picture exact = exactPicture(caster, camera);
            const Missing missing = missingFrom(draw(renderer, camera, options), exact, static_cast<double>(camera.near), reach);
            EXPECT_EQ(missing.pixels, 0) << model.name << ", view " << k << ", " << name(options.method) << ": " << missing.first;
            seen += missing.seen;
        }
    }
    EXPECT_GT(seen, GetParam() == DiceMode::watertight ? 500U : 200U);
    RecordProperty("patchesSeen", static_cast<int>(seen));
}

INSTANTIATE_TEST_SUITE_P(Modes, Cull, testing::Values(DiceMode::watertight, DiceMode::classical),
                         [](const auto& tested) { return std::string(name(tested.param)); });

}  // namespace
}  // namespace tessera::test
