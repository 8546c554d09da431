// A model from the wild, drawn from several sides: pixels that show through it are holes in its data, not in how it is diced. The file is
// not part of this repository.
#include "frames.h"
#include "picture.h"
#include "sample_meshes.h"

#include "formats/mscene.h"
#include "tessera/weld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tessera::test {
namespace {

constexpr int width = 1280;
constexpr int height = 720;

using Curve = std::array<glm::vec3, 4>;  // a cubic's control points
using CurveBits = std::array<std::array<std::uint32_t, 3>, 4>;

// The points of a bicubic patch's border, by EdgeRecord's numbers of sides.
constexpr std::array<std::array<std::size_t, 4>, 4> borders{{{0, 1, 2, 3}, {3, 7, 11, 15}, {12, 13, 14, 15}, {0, 4, 8, 12}}};

CurveBits bitsOf(const Curve& curve) {
    CurveBits bits{};
    for (std::size_t i = 0; i < 4; ++i)
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            const float value = curve[i][axis] + 0.0F;  // -0 is 0
            bits[i][static_cast<std::size_t>(axis)] = std::bit_cast<std::uint32_t>(value);
        }
    return bits;
}

// The same for a curve and its reverse.
CurveBits keyOf(const Curve& curve) {
    const CurveBits bits = bitsOf(curve);
    return std::min(bits, CurveBits{bits[3], bits[2], bits[1], bits[0]});
}

// Borders that no other border of the mesh equals to the bit. Requires a mesh of Bezier patches without edge records.
std::vector<Curve> boundaryOf(const Mesh& mesh) {
    std::map<CurveBits, std::pair<Curve, int>> users;
    for (std::size_t patch = 0; patch < mesh.patchCount(); ++patch) {
        for (const auto& border : borders) {
            Curve curve;
            for (std::size_t i = 0; i < 4; ++i) curve[i] = mesh.points[patch * pointsPerPatch(mesh.kind) + border[i]];
            const CurveBits key = keyOf(curve);
            if (std::count(key.begin(), key.end(), key.front()) == 4) continue;  // a pole
            auto& user = users[key];
            user.first = curve;
            ++user.second;
        }
    }
    std::vector<Curve> boundary;
    for (const auto& [key, user] : users)
        if (user.second == 1) boundary.push_back(user.first);
    return boundary;
}

using Place = std::pair<int, int>;  // a pixel: x, y

// The pixels whose centres are within a pixel of a boundary curve's picture.
std::set<Place> besideBoundary(const std::vector<Curve>& boundary, const reference::Placement& placement, const reference::View& view) {
    std::set<Place> result;
    for (const Curve& curve : boundary) {
        constexpr int steps = 256;  // a curve of no more than some 120 pixels: two points a pixel
        for (int step = 0; step <= steps; ++step) {
            const reference::Bernstein weights = reference::bernstein(static_cast<double>(step) / steps);
            glm::dvec3 point(0.0);
            for (std::size_t i = 0; i < 4; ++i) point += weights.value[i] * glm::dvec3(curve[i]);
            const glm::dvec3 place = view.project(placement(point));
            if (place.z <= 0.0) continue;
            const int left = static_cast<int>(std::floor(place.x - 0.5));
            const int top = static_cast<int>(std::floor(place.y - 0.5));
            for (int y = top - 1; y <= top + 2; ++y)
                for (int x = left - 1; x <= left + 2; ++x)
                    if (std::hypot(x + 0.5 - place.x, y + 0.5 - place.y) <= 1.0) result.insert({x, y});
        }
    }
    return result;
}

// A pixel deeper than all eight around it by more than `step`; the background, at infinity, is deeper than any surface.
struct Pinhole {
    int x;
    int y;
    double around;    // the greatest depth of the eight
    bool background;  // or the far side, seen through the near one
};

std::vector<Pinhole> pinholesOf(const Kept& picture, double step) {
    std::vector<Pinhole> holes;
    for (int y = 1; y + 1 < picture.height(); ++y) {
        for (int x = 1; x + 1 < picture.width(); ++x) {
            float around = 0.0F;
            for (int j = y - 1; j <= y + 1; ++j)
                for (int i = x - 1; i <= x + 1; ++i)
                    if (i != x || j != y) around = std::max(around, picture.z(i, j));
            const auto deepest = static_cast<double>(around);
            if (static_cast<double>(picture.z(x, y)) > deepest + step) holes.push_back({x, y, deepest, !picture.covered(x, y)});
        }
    }
    return holes;
}

// Whether the surfaces themselves are open at a pixel's centre, or within an eighth of a pixel of it: micropolygons, a pixel long at most,
// leave a curved outline by that much where its radius is a pixel.
bool openThere(const reference::RayCaster& caster, const reference::View& view, const Pinhole& hole, double step) {
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            const std::optional<reference::Hit> hit = caster.cast(view.ray(hole.x + 0.5 + i / 8.0, hole.y + 0.5 + j / 8.0), view.near());
            if (!hit || hit->t > hole.around + 0.5 * step) return true;
        }
    }
    return false;
}

struct Holes {
    std::size_t background = 0;   // show what is behind the model
    std::size_t farSide = 0;      // show another part of it
    std::size_t unexplained = 0;  // of both, those neither open in the data nor beside a boundary
};

class Killeroo : public testing::Test {
protected:
    void SetUp() override {
        const std::filesystem::path file = std::filesystem::path(TESSERA_SHARED_SCENES) / "killeroo.mscene";
        if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file.string() << ": the scenes are not part of this repository";
        scene = readMscene(file);
        report = weld(scene, 1e-5);
        ASSERT_EQ(scene.meshes.size(), 1U);
        ASSERT_EQ(scene.objects.size(), 1U);
        ASSERT_EQ(scene.meshes.front().kind, PatchKind::bezier);
        ASSERT_TRUE(scene.meshes.front().edges.empty());
        boundary = boundaryOf(scene.meshes.front());
    }

    // The file's own view, and around the middle, near enough to fill the picture.
    [[nodiscard]] std::vector<Camera> views() const {
        std::vector<Camera> result{scene.cameras.at(0)};
        const Bounds bounds = worldBounds(scene);
        const glm::dvec3 middle = 0.5 * (glm::dvec3(bounds.lower) + glm::dvec3(bounds.upper));
        const double size = glm::length(glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower));
        for (const glm::dvec3& away : {glm::dvec3{1, 0.3, 0.2}, {-0.4, 0.2, 1}, {0.1, -0.5, -1}, {-1, 0.6, -0.3}, {0.3, 1, 0.1}}) {
            result.push_back(reference::cameraAt(middle + 0.8 * size * glm::normalize(away), middle, 50.0));
            result.back().name = "view " + std::to_string(result.size());
        }
        return result;
    }

    [[nodiscard]] Holes holesIn(const Kept& picture, const reference::RayCaster& caster, const Camera& camera) const {
        const reference::View view(camera, width, height);
        const std::set<Place> beside = besideBoundary(boundary, reference::placement(scene.objects.front().transform), view);
        const Bounds bounds = worldBounds(scene);
        const double step = 0.01 * glm::length(glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower));
        Holes holes;
        for (const Pinhole& hole : pinholesOf(picture, step)) {
            ++(hole.background ? holes.background : holes.farSide);
            const bool inData = beside.contains({hole.x, hole.y}) || openThere(caster, view, hole, step);
            holes.unexplained += inData ? 0U : 1U;
        }
        return holes;
    }

    Scene scene;
    WeldReport report;
    std::vector<Curve> boundary;
};

TEST_F(Killeroo, BoundaryIsWhatTheReportSays) { EXPECT_EQ(boundary.size(), report.boundaryEdges); }

// Classical pictures, of the same data, show that such holes would be found.
TEST_F(Killeroo, ShowsNoPinholeThatIsNotInTheData) {
    Renderer renderer(testSettings());
    renderer.setScene(scene);
    const reference::RayCaster caster(scene);
    std::map<DiceMode, Holes> holes;
    for (const Camera& camera : views()) {
        for (const DiceMode mode : {DiceMode::classical, DiceMode::watertight}) {
            RenderOptions options = pictureOptions(width, height, 1);
            options.mode = mode;
            options.background = {1.0F, 0.0F, 1.0F, 0.0F};
            const Kept picture = draw(renderer, camera, options);
            EXPECT_GT(picture.coveredPixels(), 10000U);
            const Holes found = holesIn(picture, caster, camera);
            std::cout << camera.name << ", " << name(mode) << ": " << found.background << " pinholes to the background, " << found.farSide
                      << " to the far side, " << found.unexplained << " of them not in the data\n";
            holes[mode].unexplained += found.unexplained;
        }
    }
    EXPECT_EQ(holes[DiceMode::watertight].unexplained, 0U);
    EXPECT_GT(holes[DiceMode::classical].unexplained, 0U);
}

}  // namespace
}  // namespace tessera::test
