// Samples become pixels: coverage against exact areas, convergence, background and premultiplied alpha.
#include "frames.h"
#include "picture_scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace tessera::test {
namespace {

constexpr int side = 64;  // of the picture, pixels

// All that lies on one side of a line through `through` at `degrees`, as one large patch.
class HalfPlane {
public:
    HalfPlane(double degrees, const glm::dvec2& through) : through_(through) {
        const double angle = glm::radians(degrees);
        along_ = {std::cos(angle), std::sin(angle)};
        inward_ = {-along_.y, along_.x};
    }

    [[nodiscard]] Scene scene(const Screen& screen) const {
        const auto corner = [&](double a, double b) {
            const glm::dvec2 place = through_ + a * along_ + b * inward_;
            return screen.at(place.x, place.y);
        };
        Scene scene;
        addObject(scene, bilinearPatch({corner(-200, 0), corner(200, 0), corner(200, 200), corner(-200, 200)}), {1, 1, 1});
        return scene;
    }

    // The exact share of a pixel that is covered: the pixel's square, clipped by the line.
    [[nodiscard]] double area(int x, int y) const {
        const std::array<glm::dvec2, 4> square{{{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}};
        std::vector<glm::dvec2> kept;
        for (std::size_t k = 0; k < 4; ++k) {
            const glm::dvec2 a = square[k];
            const glm::dvec2 b = square[(k + 1) % 4];
            const double da = glm::dot(a - through_, inward_);
            const double db = glm::dot(b - through_, inward_);
            if (da >= 0) kept.push_back(a);
            if ((da >= 0) != (db >= 0)) kept.push_back(a + da / (da - db) * (b - a));
        }
        double twice = 0.0;
        for (std::size_t k = 0; k < kept.size(); ++k) {
            const glm::dvec2 a = kept[k];
            const glm::dvec2 b = kept[(k + 1) % kept.size()];
            twice += a.x * b.y - a.y * b.x;
        }
        return 0.5 * std::abs(twice);
    }

private:
    glm::dvec2 through_;
    glm::dvec2 along_;
    glm::dvec2 inward_;
};

struct CoverageError {
    double largest = 0.0;
    double mean = 0.0;    // with its sign
    double spread = 0.0;  // root of the mean square
};

// Over the pixels that the line crosses.
CoverageError coverageError(const HalfPlane& half, const Kept& picture) {
    CoverageError error;
    int crossed = 0;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const double exact = half.area(x, y);
            const double off = static_cast<double>(picture.alpha(x, y)) - exact;
            if (exact == 0.0 || exact == 1.0) {
                EXPECT_LE(std::abs(off), 1e-6) << x << ", " << y;
                continue;
            }
            ++crossed;
            error.largest = std::max(error.largest, std::abs(off));
            error.mean += off;
            error.spread += off * off;
        }
    }
    error.mean /= crossed;
    error.spread = std::sqrt(error.spread / crossed);
    return error;
}

constexpr std::array angles{0.0, 3.0, 11.0, 22.5, 31.0, 45.0, 58.0, 67.0, 85.0, 90.0, 123.0, 171.0, 200.0, 285.0, 340.0};

class Samples : public testing::Test {
protected:
    Samples() : renderer(testSettings()), screen(side, side) {}

    Kept drawn(const Scene& scene, const RenderOptions& options) {
        renderer.setScene(scene);
        return draw(renderer, screen.camera(), options);
    }

    Renderer renderer;
    Screen screen;
};

// A line crosses at most 2 N - 1 of a pixel's N x N cells and all others are decided right; samples that share no row and no column
// err there in both directions, so that 1/N of the pixel is never reached. Over all lines the errors cancel, and they fall faster than
// 1/N: a regular grid, whose columns flip all at once, stays at 0.29 / N for upright and level edges.
TEST_F(Samples, CoverAPixelByItsAreaToOneOverN) {
    const glm::dvec2 step(0.1371, 0.2593);
    for (const int samples : {1, 2, 3, 4, 5, 8, 16}) {
        double mean = 0.0;
        double square = 0.0;
        for (std::size_t k = 0; k < angles.size(); ++k) {
            SCOPED_TRACE("angle " + std::to_string(angles[k]) + ", " + std::to_string(samples));
            const HalfPlane half(angles[k], glm::dvec2(31.37, 30.81) + static_cast<double>(k) * step);
            const CoverageError error = coverageError(half, drawn(half.scene(screen), pictureOptions(side, side, samples)));
            EXPECT_LT(error.largest, 1.0 / samples);
            mean += error.mean / static_cast<double>(angles.size());
            square += error.spread * error.spread / static_cast<double>(angles.size());
        }
        EXPECT_LE(std::abs(mean), 0.03 / samples) << samples;
        EXPECT_LE(std::sqrt(square), 0.3 * std::pow(samples, -1.25)) << samples;
    }
}

// A square of colour over half of a picture, edges through the middles of pixels.
Scene halfCovered(const Screen& screen, const glm::vec3& color) {
    Scene scene;
    addObject(scene, bilinearPatch({screen.at(16.5, 16.5), screen.at(48.5, 16.5), screen.at(48.5, 48.5), screen.at(16.5, 48.5)}), color);
    // Full light on a surface that faces the eye.
    Light light;
    light.name = "front";
    scene.lights.push_back(light);
    return scene;
}

TEST_F(Samples, TheBackgroundIsTransparentAndHasNoSurface) {
    const Kept picture = drawn(halfCovered(screen, {1, 1, 1}), pictureOptions(side, side, 4));
    // One pixel of a tile that holds nothing, one of a tile that does.
    for (const glm::ivec2 p : {glm::ivec2(60, 60), glm::ivec2(15, 20)}) {
        for (const float channel : picture.at("rgba", p.x, p.y)) EXPECT_EQ(channel, 0.0F);
        for (const float channel : picture.at("N", p.x, p.y)) EXPECT_EQ(channel, 0.0F);
        for (const float channel : picture.at("uv", p.x, p.y)) EXPECT_EQ(channel, 0.0F);
        EXPECT_EQ(picture.z(p.x, p.y), std::numeric_limits<float>::infinity());
        EXPECT_EQ(picture.object(p.x, p.y), -1);
        EXPECT_EQ(picture.patch(p.x, p.y), -1);
    }
}

// Colours are premultiplied: a half-covered pixel has half of the surface's and half of the background's alpha times its colour.
TEST_F(Samples, ColoursArePremultipliedAndBlendWithTheBackground) {
    const glm::vec3 color(0.9F, 0.6F, 0.3F);
    const Scene scene = halfCovered(screen, color);
    for (const glm::vec4 background : {glm::vec4(0, 0, 0, 0), glm::vec4(0.2F, 0.4F, 0.8F, 1.0F), glm::vec4(4.0F, 0.5F, 0.0F, 0.25F)}) {
        RenderOptions options = pictureOptions(side, side, 4);
        options.background = {background.r, background.g, background.b, background.a};
        const Kept picture = drawn(scene, options);
        const glm::vec4 behind(glm::vec3(background) * background.a, background.a);
        const glm::vec4 before(color, 1.0F);
        const auto expectPixel = [&](int x, int y, float share) {
            const std::span<const float> rgba = picture.at("rgba", x, y);
            for (int c = 0; c < 4; ++c) {
                EXPECT_NEAR(rgba[static_cast<std::size_t>(c)], share * before[c] + (1 - share) * behind[c], 2e-6F) << share << ", " << c;
            }
        };
        expectPixel(5, 5, 0.0F);
        expectPixel(15, 20, 0.0F);
        expectPixel(30, 30, 1.0F);
        expectPixel(16, 30, 0.5F);
        expectPixel(30, 48, 0.5F);
        expectPixel(48, 48, 0.25F);
    }
}

// Planes other than colour are the nearest sample's or, for normals, the mean over covered samples: not mixed with the background.
TEST_F(Samples, PlanesOfPartlyCoveredPixelsAreTheSurfaces) {
    const Kept picture = drawn(halfCovered(screen, {1, 1, 1}), pictureOptions(side, side, 4));
    for (const int x : {16, 30, 48}) {
        EXPECT_NEAR(picture.z(x, 48), screen.depth(), 1e-4);
        EXPECT_EQ(picture.object(x, 48), 0);
        EXPECT_EQ(picture.patch(x, 48), 0);
        EXPECT_NEAR(picture.at("N", x, 48)[2], 1.0F, 1e-6F);
    }
}

// Of two surfaces in one pixel Z, ids and parameters are those of the nearest sample, though it covers less.
TEST_F(Samples, PlanesTellOfTheNearestSample) {
    Scene scene = halfCovered(screen, {1, 1, 1});
    const double near = 0.5 * screen.depth();
    const auto corner = [&](double x, double y) { return screen.at(x, y, near); };
    addObject(scene, bilinearPatch({corner(30.75, 30.75), corner(40, 30.75), corner(40, 40), corner(30.75, 40)}), {1, 0, 0});
    const Kept picture = drawn(scene, pictureOptions(side, side, 4));
    EXPECT_EQ(picture.object(30, 30), 1);
    EXPECT_NEAR(picture.z(30, 30), near, 1e-4);
    EXPECT_NEAR(picture.at("rgba", 30, 30)[1], 15.0F / 16.0F, 1e-6F);
    EXPECT_EQ(picture.object(29, 30), 0);
}

}  // namespace
}  // namespace tessera::test
