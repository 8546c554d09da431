// Pictures of both modes with as many micropolygons against what the reference ray caster sees, over models that both draw: watertight
// ones are nearer to it in depth and normals. In coverage neither is: what differs there are outlines, by the sag of micropolygons.
#include "closed_models.h"
#include "frames.h"
#include "picture.h"

#include "tessera/weld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

constexpr int side = 256;  // pixels, both ways

// How far pictures are from the reference, summed over their pixels.
struct Distance {
    std::size_t coverage = 0;  // pixels covered in one of the two alone
    std::size_t both = 0;      // pixels covered in both; the sums below are over these
    double depth = 0.0;        // of |dZ|, scene units
    double angle = 0.0;        // of the angle between normals, radians
    std::uint64_t micropolygons = 0;

    Distance& operator+=(const Distance& more) {
        coverage += more.coverage;
        both += more.both;
        depth += more.depth;
        angle += more.angle;
        micropolygons += more.micropolygons;
        return *this;
    }
    [[nodiscard]] double meanDepth() const { return depth / static_cast<double>(both); }
    [[nodiscard]] double meanAngle() const { return angle / static_cast<double>(both); }
};

std::ostream& operator<<(std::ostream& stream, const Distance& d) {
    return stream << d.micropolygons << " micropolygons, coverage differs at " << d.coverage << " pixels; over " << d.both
                  << " covered in both: mean |dZ| " << d.meanDepth() << ", mean angle of normals " << d.meanAngle() << " rad";
}

Distance distanceOf(const Kept& picture, const reference::Picture& expected) {
    Distance result;
    result.micropolygons = picture.statistics().micropolygons;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            const reference::Pixel& pixel = expected.at(x, y);
            const bool covered = picture.covered(x, y);
            result.coverage += covered != pixel.covered ? 1U : 0U;
            if (!covered || !pixel.covered) continue;
            const std::span<const float> n = picture.at("N", x, y);
            ++result.both;
            result.depth += std::abs(static_cast<double>(picture.z(x, y)) - pixel.z);
            result.angle += std::acos(std::clamp(glm::dot(glm::dvec3(n[0], n[1], n[2]), pixel.normal), -1.0, 1.0));
        }
    }
    return result;
}

// Classical ranges of up to `bound` pixels, cut into rate x rate: micropolygons of two pixels, of one, and smaller.
struct Density {
    float bound;
    int rate;
};
constexpr std::array densities{Density{16.0F, 8}, Density{8.0F, 8}, Density{5.0F, 8}};

RenderOptions classicalOptions(const Density& density) {
    RenderOptions options = pictureOptions(side, side, 1);
    options.mode = DiceMode::classical;
    options.splitBound = density.bound;
    options.diceRate = density.rate;
    return options;
}

// The watertight picture with the most micropolygons that are no more than `most`, by halving the shading rate's interval: a model wholly
// in the picture is all diced in either mode, so their mean areas are as their counts.
Kept drawWithAsMany(Renderer& renderer, const Camera& camera, std::uint64_t most) {
    RenderOptions options = pictureOptions(side, side, 1);
    options.mode = DiceMode::watertight;
    double tooFine = std::log(0.0625);
    double fits = std::log(65536.0);
    for (int step = 0; step < 16; ++step) {
        const double middle = 0.5 * (tooFine + fits);
        options.shadingRate = static_cast<float>(std::exp(middle));
        (renderer.render(camera, options).statistics.micropolygons > most ? tooFine : fits) = middle;
    }
    options.shadingRate = static_cast<float>(std::exp(fits));
    return draw(renderer, camera, options);
}

// As far away as makes the model some 200 of the picture's 256 pixels wide, wholly within it.
Camera allOf(const Scene& scene, std::uint64_t seed) {
    const Bounds bounds = worldBounds(scene);
    const glm::dvec3 middle = 0.5 * (glm::dvec3(bounds.lower) + glm::dvec3(bounds.upper));
    const double radius = 0.5 * glm::length(glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower));
    reference::Random random(seed);
    const glm::dvec3 away = glm::normalize(random.inCube(1.0) + glm::dvec3(1e-3, 0.0, 0.0));
    return seed % 2 == 0 ? reference::cameraAt(middle + 3.0 * radius * away, middle, 40.0)
                         : reference::cameraAt(middle + 2.0 * radius * away, middle, 62.0);
}

std::vector<ClosedModel> models() {
    std::vector<ClosedModel> result;
    const auto add = [&result](const std::string& name, std::vector<Mesh> meshes) {
        result.push_back({name, placedAnyhow(std::move(meshes), 300 + result.size())});
        weld(result.back().scene);
    };
    const Mesh teapot = builtinScene("teapot").meshes.front();
    add("cube of 6", {cubeSolid(31, 1)});
    add("cube of 54", {cubeSolid(32, 3)});
    add("polar", {polarSolid(33, 5, 4)});
    add("Bezier beside Gregory", mixedSolid(34, 2, {PatchKind::bezier, PatchKind::gregory}));
    add("teapot", {teapot});
    add("teapot of Gregory patches", {reference::asGregory(teapot)});
    add("sheets", {reference::bumpyBezierMesh(35, 6)});
    add("Gregory sheets", {reference::parted(reference::asGregory(reference::bumpyBezierMesh(36, 6)), 0.2, 37)});
    return result;
}

TEST(WatertightAgreement, CoverageDepthAndNormalsAreNearerThanClassicalOnes) {
    Renderer renderer(testSettings());
    std::array<Distance, densities.size()> classical;
    std::array<Distance, densities.size()> watertight;
    for (const ClosedModel& model : models()) {
        SCOPED_TRACE(model.name);
        renderer.setScene(model.scene);
        const reference::RayCaster caster(model.scene);
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            const Camera camera = allOf(model.scene, seed);
            const reference::Picture expected = castPicture(caster, reference::View(camera, side, side));
            for (std::size_t k = 0; k < densities.size(); ++k) {
                const Distance before = distanceOf(draw(renderer, camera, classicalOptions(densities[k])), expected);
                const Distance now = distanceOf(drawWithAsMany(renderer, camera, before.micropolygons), expected);
                classical[k] += before;
                watertight[k] += now;
            }
        }
    }
    for (std::size_t k = 0; k < densities.size(); ++k) {
        std::cout << "all, bound " << densities[k].bound << "\n    classical:  " << classical[k] << "\n    watertight: " << watertight[k]
                  << '\n';
        SCOPED_TRACE("bound " + std::to_string(densities[k].bound));
        EXPECT_LT(watertight[k].coverage, classical[k].coverage);
        EXPECT_LT(watertight[k].meanDepth(), classical[k].meanDepth());
        EXPECT_LT(watertight[k].meanAngle(), classical[k].meanAngle());
    }
}

}  // namespace
}  // namespace tessera::test
