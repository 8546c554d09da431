// What patches may cover of the picture, as the device says before it splits them: nothing that is seen lies outside.
#include "chunk_scenes.h"

#include "patch_eval.h"
#include "ray_caster.h"

#include "surface/patch_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tessera::chunks {
namespace {

struct Box {
    std::uint32_t left, right, top, bottom;  // tiles, the last ones included

    explicit Box(const patch_box& box)
        : left(box.columns & 0xffffU), right(box.columns >> 16U), top(box.rows & 0xffffU), bottom(box.rows >> 16U) {}
    [[nodiscard]] bool empty() const { return left > right || top > bottom; }
    [[nodiscard]] bool holds(double x, double y) const {
        return x >= 8.0 * left && x < 8.0 * (right + 1) && y >= 8.0 * top && y < 8.0 * (bottom + 1);
    }
};

// A point of the picture, pixels from its top left, and its depth.
struct Seen {
    double x = 0.0;
    double y = 0.0;
    double depth = 0.0;
};

// The scene before a camera in double precision.
class View {
public:
    View(const Camera& camera, const RenderOptions& options)
        : eye_(reference::placement(camera.transform)),
          near_(camera.near),
          width_(options.width),
          height_(options.height),
          focal_(0.5 * options.height / std::tan(camera.fovy * std::acos(-1.0) / 360.0)) {}

    [[nodiscard]] std::optional<Seen> at(const glm::dvec3& world) const {
        const glm::dvec3 p = glm::transpose(eye_.rotation) * (world - eye_.translation);
        if (-p.z < near_) return {};
        const Seen seen{0.5 * width_ - focal_ * p.x / p.z, 0.5 * height_ + focal_ * p.y / p.z, -p.z};
        if (seen.x < 0 || seen.y < 0 || seen.x >= width_ || seen.y >= height_) return {};
        return seen;
    }

private:
    reference::Placement eye_;
    double near_, width_, height_, focal_;
};

glm::dvec3 onRecord(const EdgeRecord& record, double along) {
    const double t = (record.index + along) / std::exp2(record.level);
    const std::array<double, 4> b = reference::bernstein(t).value;
    glm::dvec3 sum(0.0);
    double weight = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        sum += b[k] * record.weights[k] * glm::dvec3(record.points[k]);
        weight += b[k] * record.weights[k];
    }
    return sum / weight;
}

// Points of a patch and of the curves that draw its borders, in the world.
std::vector<glm::dvec3> samplesOf(const Scene& scene, const PlacedPatch& patch) {
    constexpr int steps = 8;
    const std::vector<glm::dvec3> points = reference::patchPoints(*patch.mesh, patch.index);
    const std::vector<double> weights = reference::patchWeights(*patch.mesh, patch.index);
    std::vector<glm::dvec3> samples;
    for (int j = 0; j <= steps; ++j) {
        for (int i = 0; i <= steps; ++i) {
            const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
            if (patch.mesh->kind == PatchKind::pn && u + v > 1.0) continue;
            samples.push_back(reference::evaluate(patch.mesh->kind, points, u, v, weights).position);
        }
    }
    for (const EdgeRecord& record : patch.mesh->edges)
        for (int i = 0; i <= steps && record.patch == patch.index; ++i) samples.push_back(onRecord(record, static_cast<double>(i) / steps));
    const reference::Placement place = reference::placement(scene.objects[patch.object].transform);
    for (glm::dvec3& sample : samples) sample = place(sample);
    return samples;
}

// Cameras at a surface, within, around and far from a scene that is some 14 wide, of all openings.
Camera anyCamera(const Scene& scene, Random& random, int run) {
    const std::vector<PlacedPatch> patches = placedPatches(scene);
    const auto chosen = static_cast<std::size_t>(random.between(0.0, static_cast<double>(patches.size()) - 0.01));
    const glm::dvec3 surface = samplesOf(scene, patches[chosen])[40];
    glm::dvec3 eye = surface + random.inCube(0.2);
    if (run % 4 == 1) eye = random.inCube(5.0);
    if (run % 4 == 2) eye = random.inCube(12.0);
    if (run % 4 == 3) eye = random.inCube(300.0);
    const glm::dvec3 target = run % 8 < 4 ? random.inCube(4.0) : eye + random.inCube(1.0);
    Camera camera = reference::cameraAt(eye, target, random.between(2.0, 130.0));
    camera.near = static_cast<float>(std::exp2(random.between(-10.0, 1.0)));
    return camera;
}

Scene anyScene(std::uint64_t seed) { return seed % 3 == 0 ? sceneOfEveryKind(seed) : sceneOfLoosePatches(seed); }

class PatchBoxes : public ::testing::Test {
protected:
    [[nodiscard]] std::vector<patch_box> boxes(const Scene& scene, const Camera& camera) {
        frame_params frame = frameFor(camera, options_);
        const PatchSet set = rig_.place(scene, placeObjects(scene, eyeFromWorld(camera)), frame);
        return rig_.read<patch_box>(set.boxes, set.patches);
    }

    PlaceRig rig_;
    RenderOptions options_ = smallPicture();
};

TEST_F(PatchBoxes, HoldAllThatIsSeenOfTheirPatches) {
    Random random(1);
    std::size_t seen = 0, empty = 0, narrow = 0;
    for (int run = 0; run < 96; ++run) {
        const Scene scene = anyScene(100 + static_cast<std::uint64_t>(run));
        const std::vector<PlacedPatch> patches = placedPatches(scene);
        const Camera camera = anyCamera(scene, random, run);
        const View view(camera, options_);
        const std::vector<patch_box> all = boxes(scene, camera);
        ASSERT_EQ(all.size(), patches.size());
        for (std::size_t k = 0; k < patches.size(); ++k) {
            const Box box(all[k]);
            empty += box.empty() ? 1U : 0U;
            narrow += !box.empty() && box.right - box.left < 10 ? 1U : 0U;
            for (const glm::dvec3& sample : samplesOf(scene, patches[k])) {
                const std::optional<Seen> point = view.at(sample);
                if (!point) continue;
                ++seen;
                ASSERT_TRUE(!box.empty() && box.holds(point->x, point->y))
                    << "run " << run << ", patch " << k << ", " << name(patches[k].mesh->kind) << ", at " << point->x << ", " << point->y;
                ASSERT_GE(point->depth, static_cast<double>(all[k].nearest)) << "run " << run << ", patch " << k;
            }
        }
    }
    EXPECT_GT(seen, 50000U);
    EXPECT_GT(empty, 2000U);
    EXPECT_GT(narrow, 2000U);
}

// A sheet of one control point a pixel's tenth wide, or less, far from the near plane.
Scene speckAt(const glm::vec3& place) {
    Mesh speck = reference::bumpyBezierMesh(1, 1);
    for (glm::vec3& point : speck.points) point = 1e-4F * point;
    Scene scene = reference::sceneOf({speck});
    scene.objects[0].transform.translation = place;
    return scene;
}

// The camera at the origin looks along -z: depth 10, focal length 203 / 2 / tan 45 degrees.
TEST_F(PatchBoxes, AreNoLargerThanTheirPatchesNeed) {
    Camera camera = reference::cameraAt({0, 0, 0}, {0, 0, -1}, 90);
    camera.near = 0.5F;
    const auto boxAt = [&](const glm::vec3& place) { return boxes(speckAt(place), camera).at(0); };
    const patch_box middle = boxAt({0.3F, 0.2F, -10.0F});  // pixel 168.0, 99.5
    EXPECT_EQ(Box(middle).left, 20U);
    EXPECT_EQ(Box(middle).right, 21U);
    EXPECT_EQ(Box(middle).top, 12U);
    EXPECT_EQ(Box(middle).bottom, 12U);
    EXPECT_NEAR(middle.nearest, 10.0F, 1e-3F);
    EXPECT_TRUE(Box(boxAt({0.0F, 0.0F, 3.0F})).empty()) << "behind";
    EXPECT_TRUE(Box(boxAt({0.0F, 0.0F, -0.49F})).empty()) << "nearer than near";
    for (const glm::vec3& aside : {glm::vec3(17, 0, -10), glm::vec3(-17, 0, -10), glm::vec3(0, 10.5F, -10), glm::vec3(0, -10.5F, -10)})
        EXPECT_TRUE(Box(boxAt(aside)).empty()) << aside.x << ", " << aside.y;
    const patch_box edge = boxAt({0.0F, 0.0F, -0.5F});  // across the near plane
    EXPECT_EQ(edge.columns, 41U << 16U);
    EXPECT_EQ(edge.rows, 25U << 16U);
    EXPECT_EQ(edge.nearest, 0.5F);
    EXPECT_TRUE(Box(boxAt({5.0F, 0.0F, -0.5F})).empty()) << "across the near plane, but aside";
}

// A hundredth of the picture anywhere in it, in the frame's bounds.
void narrowBounds(frame_params& frame, Random& random) {
    const double width = 2.0 * frame.centre_x, height = 2.0 * frame.centre_y;
    const double left = random.between(0.0, 0.9 * width), bottom = random.between(0.0, 0.9 * height);
    frame.cull_left = static_cast<float>(left);
    frame.cull_right = static_cast<float>(left + 0.1 * width);
    frame.cull_bottom = static_cast<float>(bottom);
    frame.cull_top = static_cast<float>(bottom + 0.1 * height);
}

bool within(const frame_params& frame, const Seen& seen) {
    const double up = 2.0 * frame.centre_y - seen.y;
    return seen.x >= frame.cull_left && seen.x <= frame.cull_right && up >= frame.cull_bottom && up <= frame.cull_top;
}

// Whole pictures: no chunk that the host leaves out has a patch that the device would draw. Parts of them: nothing in them is left out.
TEST_F(PatchBoxes, ChunksLeftOutHaveNothingToShow) {
    Random random(2);
    std::size_t leftOut = 0, shown = 0;
    for (int run = 0; run < 96; ++run) {
        const Scene scene = anyScene(200 + static_cast<std::uint64_t>(run));
        const std::vector<PlacedPatch> patches = placedPatches(scene);
        const PatchSource source(scene);
        const Camera camera = anyCamera(scene, random, run);
        const View view(camera, options_);
        const std::vector<patch_box> all = boxes(scene, camera);
        const std::vector<placed_object> placed = placeObjects(scene, eyeFromWorld(camera));
        frame_params whole = frameFor(camera, options_), narrow = whole;
        whole.cull_left = whole.cull_bottom = 0.0F;
        whole.cull_right = 2.0F * whole.centre_x;
        whole.cull_top = 2.0F * whole.centre_y;
        narrowBounds(narrow, random);
        const std::uint32_t each = run % 2 == 0 ? 1 : 5;
        for (std::uint32_t first = 0; first < source.patches(); first += each) {
            const std::uint32_t end = std::min(source.patches(), first + each);
            const bool mayAtAll = source.mayShow(first, end, whole, placed), mayHere = source.mayShow(first, end, narrow, placed);
            leftOut += mayHere ? 0U : 1U;
            shown += mayHere ? 1U : 0U;
            for (std::uint32_t k = first; k < end; ++k) {
                ASSERT_TRUE(mayAtAll || Box(all[k]).empty()) << "run " << run << ", patch " << k;
                if (mayHere) continue;
                for (const glm::dvec3& sample : samplesOf(scene, patches[k])) {
                    const std::optional<Seen> point = view.at(sample);
                    ASSERT_FALSE(point && within(narrow, *point)) << "run " << run << ", patch " << k;
                }
            }
        }
    }
    EXPECT_GT(leftOut, 1000U);
    EXPECT_GT(shown, 100U);
}

// Two boxes' patches at the origin; the last one's border is drawn by a curve that lies 100 to the side.
TEST_F(PatchBoxes, ChunksAreKeptForTheirRecordsAlone) {
    Mesh mesh = reference::bumpyBezierMesh(3, 300);
    EdgeRecord record;
    record.patch = 299;
    record.points = {glm::vec3(100, 0, 0), glm::vec3(100, 1, 0), glm::vec3(100, 2, 0), glm::vec3(100, 3, 0)};
    mesh.edges = {record};
    const Scene scene = reference::sceneOf({mesh});
    const PatchSource source(scene);
    const auto shows = [&](const Camera& camera, std::uint32_t first, std::uint32_t end) {
        return source.mayShow(first, end, frameFor(camera, options_), placeObjects(scene, eyeFromWorld(camera)));
    };
    const Camera there = reference::cameraAt({100, 0, 10}, {100, 0, 0}, 30);
    EXPECT_TRUE(shows(there, 299, 300));
    EXPECT_FALSE(shows(there, 0, 256));
    EXPECT_TRUE(shows(reference::cameraAt({0, 0, 10}, {0, 0, 0}, 30), 0, 256));
    EXPECT_FALSE(shows(reference::cameraAt({0, 0, 10}, {0, 0, 20}, 30), 0, 300)) << "behind";
}

}  // namespace
}  // namespace tessera::chunks
