// The renderer's pictures against the reference ray caster: coverage, depth, normals, ids and parameters at every pixel.
#include "picture.h"
#include "sample_meshes.h"

#include "tessera/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace tessera {
namespace {

using reference::Picture;
using reference::Pixel;
using reference::View;

constexpr int width = 160;
constexpr int height = 90;
constexpr int finer = 3;  // the reference has 3 x 3 rays a pixel, the middle one through its centre

// A range is diced when its sides, measured as chains of two segments, are 8 pixels or less; a micropolygon's side has an eighth
// of that in the mean, and 1.25 pixels where the parameter's speed is uneven along the range. Its middle, which the
// renderer reports, is within half a diagonal of the sample: 1.25 sqrt(2) / 2 = 0.9 pixels.
constexpr double middleReach = 1.0;

// What the reference knows about the pixel around (x, y), out to one pixel from its centre.
struct Vicinity {
    bool evenCoverage = true;  // no silhouette against the background
    bool smooth = true;        // one patch, no other silhouette, not seen from the side
    double slope = 0.0;        // greatest change of depth a pixel
    double bend = 0.0;         // greatest second difference of depth over a pixel
    double turn = 0.0;         // greatest angle between normals
};

class Reference {
public:
    Reference(const Scene& scene, const Camera& camera)
        : view_(camera, width, height), rays_(castPicture(reference::RayCaster(scene), View(camera, finer * width, finer * height))) {}

    [[nodiscard]] const View& view() const { return view_; }
    [[nodiscard]] const Pixel& centre(int x, int y) const { return rays_.at(finer * x + 1, finer * y + 1); }
    [[nodiscard]] Vicinity around(int x, int y) const {
        Vicinity result;
        const Pixel& middle = centre(x, y);
        for (int dy = -finer; dy <= finer; ++dy)
            for (int dx = -finer; dx <= finer; ++dx) look(middle, finer * x + 1 + dx, finer * y + 1 + dy, result);
        for (const glm::ivec2 step : {glm::ivec2(1, 0), {0, 1}, {1, 1}, {1, -1}}) {
            const auto z = [&](int k) { return rays_.at(finer * (x + k * step.x) + 1, finer * (y + k * step.y) + 1).z; };
            result.bend = std::max(result.bend, std::abs(z(-1) - 2 * z(0) + z(1)));
        }
        return result;
    }

    // Of depth, per pixel. Requires a smooth vicinity.
    [[nodiscard]] glm::dvec2 gradient(int x, int y) const {
        return 0.5 * glm::dvec2(centre(x + 1, y).z - centre(x - 1, y).z, centre(x, y + 1).z - centre(x, y - 1).z);
    }

private:
    [[nodiscard]] double cosine(const Pixel& pixel, int fx, int fy) const {
        return -glm::dot(pixel.normal, view_.ray((fx + 0.5) / finer, (fy + 0.5) / finer).direction);
    }
    // Depth along the picture, of the plane that touches the surface there, grows by no more than this a pixel.
    [[nodiscard]] double slope(const Pixel& pixel, int fx, int fy) const {
        return pixel.z * view_.pixelSize() / std::max(cosine(pixel, fx, fy), 1e-9);
    }
    void look(const Pixel& middle, int fx, int fy, Vicinity& result) const {
        const Pixel& pixel = rays_.at(fx, fy);
        result.evenCoverage = result.evenCoverage && pixel.covered == middle.covered;
        if (!pixel.covered || !middle.covered) {
            result.smooth = false;
            return;
        }
        const Pixel& next = rays_.at(fx + 1, fy);
        const Pixel& below = rays_.at(fx, fy + 1);
        const double here = slope(pixel, fx, fy);
        // Twice what both tangent planes say for a third of a pixel is a step, not a slope.
        const bool step = std::abs(next.z - pixel.z) > (here + slope(next, fx + 1, fy)) / finer ||
                          std::abs(below.z - pixel.z) > (here + slope(below, fx, fy + 1)) / finer;
        result.smooth = result.smooth && !step && pixel.hit.object == middle.hit.object && pixel.hit.patch == middle.hit.patch &&
                        cosine(pixel, fx, fy) > 0.15;
        result.slope = std::max(result.slope, here);
        result.turn = std::max(result.turn, std::acos(std::min(1.0, glm::dot(pixel.normal, middle.normal))));
    }

    View view_;
    Picture rays_;
};

// What the renderer says of a pixel.
struct Rendered {
    bool covered;
    double z;
    glm::dvec3 normal;
    int object, patch;
    double u, v;
};

class Drawn {
public:
    explicit Drawn(const Frame& frame) : frame_(frame) {}
    [[nodiscard]] Rendered at(int x, int y) const {
        const std::size_t p = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
        return {value("rgba", 4 * p + 3) > 0.0,
                value("Z", p),
                {value("N", 3 * p), value("N", 3 * p + 1), value("N", 3 * p + 2)},
                static_cast<int>(value("object.id", p)),
                static_cast<int>(value("patch.id", p)),
                value("uv", 2 * p),
                value("uv", 2 * p + 1)};
    }

private:
    [[nodiscard]] double value(std::string_view plane, std::size_t index) const { return frame_.plane(plane)->values[index]; }
    const Frame& frame_;
};

// A patch of the scene in world space.
struct WorldPatch {
    PatchKind kind;
    std::vector<glm::dvec3> points;
    std::vector<double> weights;

    [[nodiscard]] reference::SurfacePoint at(double u, double v) const { return reference::evaluate(kind, points, u, v, weights); }
    [[nodiscard]] reference::Points positions() const { return reference::Points(points).first(positionsPerPatch(kind)); }
};

WorldPatch worldPatch(const Scene& scene, int object, int patch) {
    const Object& placed = scene.objects.at(static_cast<std::size_t>(object));
    const Mesh& mesh = *scene.findMesh(placed.mesh);
    const auto number = static_cast<std::size_t>(patch);
    WorldPatch result{mesh.kind, reference::patchPoints(mesh, number), reference::patchWeights(mesh, number)};
    const reference::Placement placement = reference::placement(placed.transform);
    for (std::size_t k = 0; k < result.points.size(); ++k) {
        const bool isNormal = k >= positionsPerPatch(mesh.kind);
        result.points[k] = isNormal ? placement.rotation * result.points[k] : placement(result.points[k]);
    }
    return result;
}

// What single precision may add to a position: 1e-5 of the patch's size and 8 ulp of its largest coordinate from the eye.
double positionError(const WorldPatch& patch, double distance) {
    const double size = reference::patchSize(patch.positions());
    return 1e-5 * size + 8 * 0x1p-23 * (distance + size);
}

// Least squares for the shift of one picture against the other that explains their difference in depth.
class Shift {
public:
    void add(double difference, const glm::dvec2& gradient) {
        moment_ += difference * gradient;
        square_ += glm::outerProduct(gradient, gradient);
    }
    [[nodiscard]] double pixels() const { return glm::length(glm::inverse(square_) * moment_); }

private:
    glm::dvec2 moment_{0.0};
    glm::dmat2 square_{0.0};
};

class Comparison {
public:
    Comparison(const Scene& scene, const Camera& camera, const Frame& frame, DiceMode mode)
        : mode_(mode), scene_(scene), reference_(scene, camera), drawn_(frame), eye_(camera.transform.translation) {}

    void run() {
        for (int y = 1; y + 1 < height; ++y)
            for (int x = 1; x + 1 < width; ++x) pixel(x, y);
    }

    int covered = 0;     // pixels that the reference covers
    int compared = 0;    // of these, those with a smooth vicinity
    int atOutline = 0;   // pixels within a pixel of a silhouette
    int outlineOff = 0;  // of these, those whose coverage differs
    int pinholes = 0;    // pixels elsewhere that show through a crack
    Shift shift;         // by which the depths fit best

private:
    void pixel(int x, int y) {
        const Pixel& expected = reference_.centre(x, y);
        const Rendered seen = drawn_.at(x, y);
        const Vicinity vicinity = reference_.around(x, y);
        covered += expected.covered ? 1 : 0;
        if (!vicinity.evenCoverage) {
            ++atOutline;
            outlineOff += seen.covered != expected.covered ? 1 : 0;
            return;
        }
        if (expected.covered && (!seen.covered || seen.z > expected.z + vicinity.slope) && mayBeOpen(expected.hit)) {
            ++pinholes;
            return;
        }
        check(seen.covered == expected.covered, x, y, "coverage", seen.covered ? 1 : 0, 0);
        if (!vicinity.smooth || !seen.covered) return;
        ++compared;
        const bool samePatch = seen.object == static_cast<int>(expected.hit.object) && seen.patch == static_cast<int>(expected.hit.patch);
        check(samePatch, x, y, "patch", seen.patch, static_cast<double>(expected.hit.patch));
        if (samePatch) surface(x, y, expected, seen, vicinity);
    }

    // Watertight ranges meet without a crack; there a pixel that shows through must fail.
    [[nodiscard]] bool mayBeOpen(const reference::Hit& hit) const { return mode_ == DiceMode::classical && onRangeBorder(hit); }

    // Grids of different levels meet in T-junctions, which the classical mode leaves open by their sag. Such a crack lies on a border
    // between ranges: at a multiple of the greatest power of two that is 8 pixels or less, or of its half beside a finer range.
    [[nodiscard]] bool onRangeBorder(const reference::Hit& hit) const {
        const WorldPatch patch = worldPatch(scene_, static_cast<int>(hit.object), static_cast<int>(hit.patch));
        const reference::SurfacePoint s = patch.at(hit.u, hit.v);
        const auto off = [&](double parameter, const glm::dvec3& tangent) {
            const double step = 1e-6;
            const glm::dvec3 moved = reference_.view().project(s.position + step * tangent) - reference_.view().project(s.position);
            const double pixels = std::hypot(moved.x, moved.y) / step;
            const double side = std::exp2(std::floor(std::log2(8 / pixels))) / 2;
            return std::abs(parameter - std::round(parameter / side) * side) * pixels;
        };
        return std::min(off(hit.u, s.du), off(hit.v, s.dv)) < 0.1;
    }

    void surface(int x, int y, const Pixel& expected, const Rendered& seen, const Vicinity& vicinity) {
        const WorldPatch patch = worldPatch(scene_, seen.object, seen.patch);
        const double rounding = positionError(patch, glm::length(expected.hit.point - eye_));
        const double perCosine = vicinity.slope / (expected.z * reference_.view().pixelSize());
        // Over a right triangle with legs of s pixels a plane through its corners leaves a surface by s^2 / 4 of the second
        // derivative (that of the difference over a pixel): 0.4 of it. Snapping moves corners by half of 1/256 pixel each way
        // along the slope; rounding moves them anyhow.
        const double depthTolerance = 0.5 * vicinity.bend + vicinity.slope / 256 + rounding * perCosine;
        check(std::abs(seen.z - expected.z) <= depthTolerance, x, y, "depth", seen.z - expected.z, depthTolerance);

        shift.add(seen.z - expected.z, reference_.gradient(x, y));

        const reference::SurfacePoint middle = patch.at(seen.u, seen.v);
        const glm::dvec3 place = reference_.view().project(middle.position);
        const double off = std::hypot(place.x - x - 0.5, place.y - y - 0.5);
        check(off <= middleReach, x, y, "distance of (u, v) in pixels", off, middleReach);
        const double placeTolerance = middleReach * vicinity.slope + 2 * vicinity.bend + rounding * perCosine;
        check(std::abs(place.z - expected.z) <= placeTolerance, x, y, "depth at (u, v)", place.z - expected.z, placeTolerance);
        normals(x, y, expected, seen, vicinity, patch, middle, rounding);
    }

    // The normal is that of the micropolygon's middle. There it is exact but for rounding: an error e in both tangents turns
    // their product by e (|du| + |dv|) / |du x dv|; e is six times that of positions (a cubic's derivative has coefficients of
    // 3 and -3). And from the pixel's centre it turns no more than in reach of it, in twice the distance looked at.
    static void normals(int x, int y, const Pixel& expected, const Rendered& seen, const Vicinity& vicinity, const WorldPatch& patch,
                        const reference::SurfacePoint& middle, double rounding) {
        const glm::dvec3 exact = reference::shadingNormal(patch.kind, patch.points, seen.u, seen.v, patch.weights);
        const double sine = glm::length(glm::cross(exact, seen.normal));
        const double sides = glm::length(middle.du) + glm::length(middle.dv);
        const double tolerance = 6 * rounding * sides / glm::length(glm::cross(middle.du, middle.dv)) + 1e-6;
        check(sine <= tolerance, x, y, "normal at (u, v)", sine, tolerance);
        const double angle = std::acos(std::clamp(glm::dot(seen.normal, expected.normal), -1.0, 1.0));
        const double angleTolerance = 2 * vicinity.turn + tolerance + 1e-5;  // acos itself loses half the digits near 1
        check(angle <= angleTolerance, x, y, "normal", angle, angleTolerance);
    }

    static void check(bool holds, int x, int y, const char* what, double value, double tolerance) {
        if (!holds) ADD_FAILURE() << what << " at pixel (" << x << ", " << y << "): " << value << ", tolerance " << tolerance;
    }

    DiceMode mode_;
    const Scene& scene_;
    Reference reference_;
    Drawn drawn_;
    glm::dvec3 eye_;
};

Frame draw(Renderer& renderer, const Camera& camera, DiceMode mode) {
    RenderOptions options;
    options.mode = mode;
    options.width = width;
    options.height = height;
    options.pixelSamples = 1;
    options.splitBound = 8.0F;
    options.diceRate = 8;
    options.aovs = Aov::z | Aov::normal | Aov::object | Aov::patch | Aov::uv;
    return renderer.render(camera, options);
}

// At outlines micropolygons may err by their sag, some hundredths of a pixel: few of the pixels nearby are decided by that.
void expectAgreement(const Scene& scene, const std::vector<Camera>& cameras, double comparedShare, DiceMode mode) {
    RendererSettings settings;
    settings.cacheFolder = TESSERA_TEST_CACHE;
    Renderer renderer(settings);
    renderer.setScene(scene);
    for (const Camera& camera : cameras) {
        const std::string title = camera.name + " " + std::string(name(mode));
        SCOPED_TRACE(title);
        const Frame frame = draw(renderer, camera, mode);
        Comparison comparison(scene, camera, frame, mode);
        comparison.run();
        EXPECT_GT(comparison.covered, 500);
        EXPECT_GE(comparison.compared, comparedShare * comparison.covered);
        EXPECT_LE(comparison.outlineOff, 2 + comparison.atOutline / 50);
        // Snapping errs by 1/512 pixel at random, and sag pulls slopes of both directions alike: over a thousand pixels they cancel.
        EXPECT_LE(comparison.shift.pixels(), 0.01);
        EXPECT_LE(comparison.pinholes, 1 + comparison.covered / 2000);
        std::ostringstream counts;
        counts << comparison.covered << " covered, " << comparison.compared << " compared, " << comparison.outlineOff << " of "
               << comparison.atOutline << " differ at outlines, " << comparison.pinholes << " pinholes, shift "
               << comparison.shift.pixels();
        ::testing::Test::RecordProperty(title, counts.str());
    }
}

void expectAgreement(const Scene& scene, const std::vector<Camera>& cameras, double comparedShare) {
    for (const DiceMode mode : {DiceMode::classical, DiceMode::watertight}) expectAgreement(scene, cameras, comparedShare, mode);
}

Camera named(Camera camera, const std::string& name) {
    camera.name = name;
    return camera;
}

std::vector<Camera> teapotCameras() {
    return {named(reference::cameraAt({3.2, 4.5, 2.8}, {0.2, 0, 1.4}, 40), "slanting"),
            named(reference::cameraAt({0.03, 0.02, 9}, {0, 0.01, 0}, 35), "above"),
            named(reference::cameraAt({-2.5, 1.2, 0.9}, {0, 0, 1.3}, 50), "close")};
}

std::vector<Camera> frontAndSide() {
    return {named(reference::cameraAt({0.5, 1, 5}, {0, 0, 0}, 35), "front"),
            named(reference::cameraAt({4, 0.2, -3}, {0, 0, 0}, 30), "side")};
}

// The built-in teapot with its axis along z, however it is placed.
TEST(Agreement, TeapotOfBezierPatches) {
    Scene scene = builtinScene("teapot");
    scene.objects.at(0).transform = {};
    expectAgreement(scene, teapotCameras(), 0.45);
}

TEST(Agreement, TeapotOfGregoryPatches) {
    Scene scene = builtinScene("teapot");
    scene.objects.at(0).transform = {};
    for (Mesh& mesh : scene.meshes) mesh = reference::asGregory(mesh);
    expectAgreement(scene, teapotCameras(), 0.45);
}

TEST(Agreement, BumpyBezierPatches) {
    const Scene scene = reference::sceneOf({reference::bumpyBezierMesh(1, 8)});
    expectAgreement(scene, frontAndSide(), 0.4);
}

TEST(Agreement, RationalGregoryPatches) {
    const Scene scene = reference::sceneOf({reference::parted(reference::asGregory(reference::bumpyBezierMesh(2, 6)), 0.25, 3)});
    expectAgreement(scene, frontAndSide(), 0.4);
}

// Both kinds in one scene, an object used twice, turned and moved.
TEST(Agreement, PlacedObjectsOfBothKinds) {
    Scene scene = reference::sceneOf(
        {reference::bumpyBezierMesh(5, 3), reference::parted(reference::asGregory(reference::bumpyBezierMesh(6, 3)), 0.2, 7)});
    scene.objects.push_back(scene.objects[0]);
    scene.objects[1].transform.rotation = glm::quat(0.5F, 1.0F, -0.3F, 0.2F);
    scene.objects[2].transform.rotation = glm::quat(1.0F, 0.1F, 0.8F, -0.4F);
    scene.objects[2].transform.translation = {1.5F, -0.5F, 0.3F};
    expectAgreement(scene, {named(reference::cameraAt({1, 1, 7}, {0.5, 0, 0}, 30), "front")}, 0.4);
}

// Classical mode does not draw these.
TEST(Agreement, RationalPatches) {
    const Scene scene = reference::sceneOf({reference::weighted(reference::bumpyBezierMesh(3, 6), 3.0, 4)});
    expectAgreement(scene, frontAndSide(), 0.4, DiceMode::watertight);
}

TEST(Agreement, CurvedTriangles) {
    expectAgreement(reference::sceneOf({reference::bumpyPnMesh(4, 12)}), frontAndSide(), 0.3, DiceMode::watertight);
}

// An eye among the patches: some cross the near plane, and what is nearer must be cut off there.
TEST(Agreement, PatchesThroughTheNearPlane) {
    const Scene scene = reference::sceneOf({reference::bumpyBezierMesh(9, 10)});
    Camera camera = named(reference::cameraAt({0.1, 0.3, 0.8}, {0, 0, -0.2}, 60), "among");
    camera.near = 0.25F;
    expectAgreement(scene, {camera}, 0.4);
}

}  // namespace
}  // namespace tessera
