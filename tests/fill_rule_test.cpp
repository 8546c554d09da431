// The fill rule: where patches abut, every sample is covered exactly once; on an edge, left and top are in, right and bottom are out.
#include "frames.h"
#include "picture_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

constexpr std::array<glm::vec3, 4> fourColors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}}};

// The eight ways in which u and v can run over a rectangle.
struct Orientation {
    bool swapped = false;
    bool mirrorU = false;
    bool mirrorV = false;

    // (s, t) of the rectangle, right and down, as (u, v) of the patch.
    [[nodiscard]] glm::dvec2 parameters(double s, double t) const {
        if (swapped) std::swap(s, t);
        return {mirrorU ? 1 - s : s, mirrorV ? 1 - t : t};
    }
    [[nodiscard]] Corners turned(const Corners& rectangle) const {
        Corners result;
        for (std::size_t k = 0; k < 4; ++k) {
            const bool right = k == 1 || k == 2;
            const bool below = k >= 2;
            const glm::dvec2 uv = parameters(right ? 1 : 0, below ? 1 : 0);
            result[(uv.y > 0.5 ? (uv.x > 0.5 ? 2U : 3U) : (uv.x > 0.5 ? 1U : 0U))] = rectangle[k];
        }
        return result;
    }
};

std::vector<Orientation> orientations() {
    std::vector<Orientation> all;
    for (unsigned k = 0; k < 8; ++k) all.push_back({(k & 1U) != 0, (k & 2U) != 0, (k & 4U) != 0});
    return all;
}

constexpr int margin = 3;  // of empty pixels

// Four square patches around the middle of a picture, corners on the centres of pixels, `cell` pixels a micropolygon.
struct Grid {
    int rate = 8;
    double cell = 1.0;

    [[nodiscard]] int side() const { return static_cast<int>(cell * rate); }  // of a patch, pixels
    [[nodiscard]] int pictureSide() const { return 2 * side() + 2 * margin; }

    // Column and row of the quarter that a pixel belongs to; -1 and below or 2 and above outside.
    [[nodiscard]] glm::ivec2 quarter(int x, int y) const {
        const auto part = [this](int pixel) { return pixel < margin ? -1 : (pixel - margin) / side(); };
        return {part(x), part(y)};
    }
    [[nodiscard]] static bool inside(const glm::ivec2& part) { return part.x >= 0 && part.x < 2 && part.y >= 0 && part.y < 2; }

    // The middle of the micropolygon that covers the pixel `from` its patch's first one, as a share of the patch's side. It holds the
    // pixel's centre when that is its left or top edge.
    [[nodiscard]] double middleOfMicropolygon(int from) const { return (std::floor(from / cell) + 0.5) * cell / side(); }
};

// Up to 64 pixels micropolygons are covered many at a time in 32 bits, beyond one at a time in 64; rates that fill no vector;
// micropolygons smaller than pixels.
std::vector<Grid> grids() {
    return {{1, 240}, {1, 64}, {1, 65}, {1, 7},   {1, 1},  {2, 65},   {3, 80}, {3, 64}, {3, 5},  {5, 66},   {5, 12},
            {8, 30},  {8, 1},  {9, 4},  {16, 16}, {16, 3}, {16, 0.5}, {17, 2}, {32, 7}, {32, 1}, {32, 0.25}};
}

std::string textOf(const Grid& grid, const Orientation& orientation) {
    std::ostringstream text;
    text << "rate " << grid.rate << ", " << grid.cell << " pixels a micropolygon, swapped " << orientation.swapped << ", mirrored "
         << orientation.mirrorU << orientation.mirrorV;
    return text.str();
}

class FaceOnGrid : public testing::Test {
protected:
    FaceOnGrid() : renderer(testSettings()) {}

    [[nodiscard]] static Scene quarters(const Grid& grid, const Orientation& orientation, bool lastFirst) {
        const Screen screen(grid.pictureSide(), grid.pictureSide());
        const int side = grid.side();
        Scene scene;
        for (int k = 0; k < 4; ++k) {
            const int part = lastFirst ? 3 - k : k;
            const int column = part % 2;
            const int row = part / 2;
            const double x = margin + 0.5 + side * column;
            const double y = margin + 0.5 + side * row;
            const Corners corners{screen.at(x, y), screen.at(x + side, y), screen.at(x + side, y + side), screen.at(x, y + side)};
            addObject(scene, bilinearPatch(orientation.turned(corners)), fourColors[static_cast<std::size_t>(part)]);
        }
        return scene;
    }

    Kept drawn(const Grid& grid, const Scene& scene, int pixelSamples) {
        RenderOptions options = pictureOptions(grid.pictureSide(), grid.pictureSide(), pixelSamples);
        options.mode = DiceMode::classical;
        options.diceRate = grid.rate;
        options.maxDepth = 0;
        renderer.setScene(scene);
        return draw(renderer, Screen(grid.pictureSide(), grid.pictureSide()).camera(), options);
    }

    Renderer renderer;
};

TEST_F(FaceOnGrid, LeftAndTopAreInRightAndBottomAreOut) {
    for (const Grid& grid : grids()) {
        for (const Orientation& orientation : orientations()) {
            const Kept picture = drawn(grid, quarters(grid, orientation, false), 1);
            int wrong = 0;
            for (int y = 0; y < picture.height(); ++y) {
                for (int x = 0; x < picture.width(); ++x) {
                    const glm::ivec2 part = grid.quarter(x, y);
                    wrong += picture.object(x, y) != (Grid::inside(part) ? 2 * part.y + part.x : -1) ? 1 : 0;
                }
            }
            EXPECT_EQ(wrong, 0) << textOf(grid, orientation);
        }
    }
}

// The parameters tell which micropolygon covers a sample on its edge or corner: of those that meet there, the one right below.
TEST_F(FaceOnGrid, OfMicropolygonsThatMeetAtASampleTheOneRightBelowCoversIt) {
    for (const Grid& grid : grids()) {
        if (grid.cell < 1.0) continue;  // several a pixel
        for (const Orientation& orientation : orientations()) {
            const Kept picture = drawn(grid, quarters(grid, orientation, false), 1);
            int wrong = 0;
            for (int y = 0; y < picture.height(); ++y) {
                for (int x = 0; x < picture.width(); ++x) {
                    const glm::ivec2 part = grid.quarter(x, y);
                    if (!Grid::inside(part)) continue;
                    const double s = grid.middleOfMicropolygon(x - margin - part.x * grid.side());
                    const double t = grid.middleOfMicropolygon(y - margin - part.y * grid.side());
                    const glm::dvec2 expected = orientation.parameters(s, t);
                    const std::span<const float> uv = picture.at("uv", x, y);
                    wrong += std::abs(uv[0] - expected.x) > 1e-6 || std::abs(uv[1] - expected.y) > 1e-6 ? 1 : 0;
                }
            }
            EXPECT_EQ(wrong, 0) << textOf(grid, orientation);
        }
    }
}

// Were a sample covered twice, the earlier object would have it.
TEST_F(FaceOnGrid, TheOrderOfPatchesDoesNotMatter) {
    for (const Grid& grid : grids()) {
        for (const int samples : {1, 3, 4}) {
            if (samples > 1 && grid.side() > 130) continue;  // much time for little more
            const Kept forward = drawn(grid, quarters(grid, {}, false), samples);
            const Kept backward = drawn(grid, quarters(grid, {}, true), samples);
            EXPECT_EQ(forward.planes().at("rgba").values, backward.planes().at("rgba").values) << textOf(grid, {}) << ", " << samples;
        }
    }
}

// Edges through the middles of pixels: with 4 x 4 samples half of each is covered, and a quarter at the corners.
TEST_F(FaceOnGrid, EdgesThroughTheMiddleOfPixelsCoverHalfTheirSamples) {
    for (const Grid& grid : grids()) {
        if (grid.side() > 240) continue;
        const Kept picture = drawn(grid, quarters(grid, {}, false), 4);
        const int last = grid.pictureSide() - margin;
        const auto share = [last](int p) { return p == margin || p == last ? 0.5F : (p > margin && p < last ? 1.0F : 0.0F); };
        int wrong = 0;
        for (int y = 0; y < picture.height(); ++y)
            for (int x = 0; x < picture.width(); ++x) wrong += picture.alpha(x, y) != share(x) * share(y) ? 1 : 0;
        EXPECT_EQ(wrong, 0) << textOf(grid, {});
    }
}

// Split down to 8 pixels: rates of 8 and less put vertices on samples.
TEST(FillRule, SplitPatchesCoverTheSameSquare) {
    Renderer renderer(testSettings());
    const Screen screen(80, 80);
    for (const Orientation& orientation : orientations()) {
        Scene scene;
        const Corners square{screen.at(8.5, 8.5), screen.at(72.5, 8.5), screen.at(72.5, 72.5), screen.at(8.5, 72.5)};
        addObject(scene, bilinearPatch(orientation.turned(square)), fourColors[0]);
        renderer.setScene(scene);
        for (const int rate : {1, 2, 3, 4, 5, 7, 8, 16, 17, 31, 32}) {
            RenderOptions options = pictureOptions(80, 80, 1);
            options.mode = DiceMode::classical;
            options.diceRate = rate;
            options.splitBound = 8.5F;
            const Kept picture = draw(renderer, screen.camera(), options);
            EXPECT_EQ(picture.statistics().rangesDiced, 64U);
            int wrong = 0;
            for (int y = 0; y < 80; ++y)
                for (int x = 0; x < 80; ++x) wrong += picture.covered(x, y) != (x >= 8 && x < 72 && y >= 8 && y < 72) ? 1 : 0;
            EXPECT_EQ(wrong, 0) << "rate " << rate;
        }
    }
}

// Quadrilaterals of all shapes that share edges, corners on the grid to which vertices are snapped: nothing shows through, nothing
// is covered twice. With `step` as the rate's multiple of 1/256 pixel, inner vertices of the edges are exact too.
Scene jitteredSheet(const Screen& screen, int cells, int size, int rate, int pixelSamples, std::uint64_t seed, bool lastFirst) {
    reference::Random random(seed);
    const double step = rate / (256.0 * pixelSamples);
    const int corners = cells + 1;
    std::vector<glm::dvec2> places;
    for (int k = 0; k < corners * corners; ++k) {
        const glm::ivec2 cell(k % corners, k / corners);
        const bool fixedX = cell.x == 0 || cell.x == cells;
        const bool fixedY = cell.y == 0 || cell.y == cells;
        const glm::dvec2 off(fixedX ? 0 : random.between(-0.4, 0.4), fixedY ? 0 : random.between(-0.4, 0.4));
        places.push_back(glm::round((0.5 + 1.0 * size * (glm::dvec2(cell) + off)) / step) * step + glm::dvec2(margin));
    }
    const auto corner = [&](int x, int y) {
        const glm::dvec2 place = places[static_cast<std::size_t>(y) * static_cast<std::size_t>(corners) + static_cast<std::size_t>(x)];
        return screen.at(place.x, place.y);
    };
    Scene scene;
    for (int k = 0; k < cells * cells; ++k) {
        const int part = lastFirst ? cells * cells - 1 - k : k;
        const int x = part % cells;
        const int y = part / cells;
        const Corners quad{corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)};
        const Orientation orientation{(part & 1) != 0, (part & 2) != 0, (part & 4) != 0};
        addObject(scene, bilinearPatch(orientation.turned(quad)), fourColors[static_cast<std::size_t>(x % 2 + 2 * (y % 2))]);
    }
    return scene;
}

TEST(FillRule, ASheetOfSlantedPatchesHasNoGapAndNoOverlap) {
    Renderer renderer(testSettings());
    for (const int size : {5, 13, 90}) {
        const int cells = size > 64 ? 3 : 9;
        const int side = cells * size + 2 * margin;
        const Screen screen(side, side);
        for (const int samples : {1, 2, 3, 4}) {
            for (const int rate : {1, 4, 8}) {
                SCOPED_TRACE(std::to_string(size) + " pixels, rate " + std::to_string(rate) + ", samples " + std::to_string(samples));
                RenderOptions options = pictureOptions(side, side, samples);
                options.mode = DiceMode::classical;
                options.maxDepth = 0;
                options.diceRate = rate;
                const auto drawn = [&](bool lastFirst) {
                    renderer.setScene(jitteredSheet(screen, cells, size, rate, samples, 77, lastFirst));
                    return draw(renderer, screen.camera(), options);
                };
                const Kept forward = drawn(false);
                int open = 0;
                for (int y = margin + 1; y < side - margin; ++y)
                    for (int x = margin + 1; x < side - margin; ++x) open += forward.alpha(x, y) != 1.0F ? 1 : 0;
                EXPECT_EQ(open, 0);
                EXPECT_EQ(forward.planes().at("rgba").values, drawn(true).planes().at("rgba").values);
            }
        }
    }
}

}  // namespace
}  // namespace tessera::test
