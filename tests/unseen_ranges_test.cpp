// How many of the ranges that are diced nobody can see: hulls of control points must not let through more than the classical mode's nine
// samples and 32-pixel ribbon do.
#include "closed_models.h"
#include "quad_rig.h"
#include "split_rig.h"

#include "patch_eval.h"
#include "ray_caster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace tessera::splitting {
namespace {

RenderOptions optionsOf(DiceMode mode) {
    RenderOptions options;
    options.width = 320;
    options.height = 240;
    options.pixelSamples = 1;
    options.mode = mode;
    return options;
}

// The patches as a camera sees them, in double precision.
class View {
public:
    View(const Scene& scene, const Camera& camera, const frame_params& frame, std::vector<placed_patch> placed)
        : scene_(scene), camera_(camera), frame_(frame), placed_(std::move(placed)) {}

    // Whether any of 17 x 17 points of a quadrilateral of a patch lies in the picture.
    [[nodiscard]] bool sees(std::uint32_t patch, const std::array<glm::dvec2, 4>& corners) const {
        const placed_patch& where = placed_[patch];
        const Object& object = scene_.objects[where.object];
        const Mesh& mesh = *scene_.findMesh(object.mesh);
        const std::vector<glm::dvec3> points = reference::patchPoints(mesh, where.index_in_mesh);
        const std::vector<double> weights = reference::patchWeights(mesh, where.index_in_mesh);
        const reference::Placement toWorld = reference::placement(object.transform);
        for (int k = 0; k < 17 * 17; ++k) {
            const double s = k % 17 / 16.0;
            const double t = k / 17 / 16.0;
            const glm::dvec2 at = glm::mix(glm::mix(corners[0], corners[1], s), glm::mix(corners[3], corners[2], s), t);
            if (inPicture(toWorld(reference::evaluate(mesh.kind, points, at.x, at.y, weights).position))) return true;
        }
        return false;
    }

private:
    [[nodiscard]] bool inPicture(const glm::dvec3& world) const {
        const glm::dvec3 eye = glm::transpose(rotationMatrix(camera_.transform)) * (world - glm::dvec3(camera_.transform.translation));
        const double depth = -eye.z;
        if (depth < static_cast<double>(camera_.near)) return false;
        const double x = static_cast<double>(frame_.centre_x) + static_cast<double>(frame_.focal) * eye.x / depth;
        const double y = static_cast<double>(frame_.centre_y) - static_cast<double>(frame_.focal) * eye.y / depth;
        return x >= 0.0 && x <= frame_.width && y >= 0.0 && y <= frame_.height;
    }

    const Scene& scene_;
    const Camera& camera_;
    const frame_params& frame_;
    std::vector<placed_patch> placed_;
};

struct Share {
    std::size_t diced = 0;
    std::size_t unseen = 0;

    [[nodiscard]] double value() const { return diced == 0 ? 0.0 : static_cast<double>(unseen) / static_cast<double>(diced); }
};

void addWatertight(QuadRig& rig, const Scene& scene, const Camera& camera, Share& share) {
    rig.place(scene, camera, optionsOf(DiceMode::watertight));
    const View view(scene, camera, rig.frame(), rig.host().placed);
    for (const quad_range& range : findBounded(rig, 40000).diced) {
        std::array<glm::dvec2, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = glm::dvec2(range.corner_u[k], range.corner_v[k]) / 16777216.0;
        ++share.diced;
        if (!view.sees(range.patch_index, corners)) ++share.unseen;
    }
}

void addClassical(SplitRig& rig, const Scene& scene, const Camera& camera, Share& share) {
    rig.place(scene, camera, optionsOf(DiceMode::classical));
    std::vector<placed_patch> placed(rig.patches().patches);
    rig.session().timeline.read(rig.patches().placed.cl(), placed.data(), placed.size() * sizeof(placed_patch));
    const View view(scene, camera, rig.frame(), placed);
    for (const range_t& range : depthFirst(rig.patches().patches, rig.hostBound()).diced) {
        const Side u = sideOf(range.u_side), v = sideOf(range.v_side);
        const double u0 = u.start, u1 = u0 + u.size, v0 = v.start, v1 = v0 + v.size;
        ++share.diced;
        if (!view.sees(range.patch_index, {{{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}}})) ++share.unseen;
    }
}

TEST(UnseenRanges, AreNoLargerShareOfTheDicedThanWithSamplesAndRibbon) {
    SplitRig classicalRig(kernelSources());
    QuadRig watertightRig(kernelSources());
    Share classical, watertight;
    for (const test::ClosedModel& model : test::closedModels()) {
        const bool both = std::all_of(model.scene.meshes.begin(), model.scene.meshes.end(),
                                      [](const Mesh& mesh) { return mesh.kind == PatchKind::bezier || mesh.kind == PatchKind::gregory; });
        if (!both) continue;
        for (const test::ViewKind kind : {test::ViewKind::near, test::ViewKind::grazing, test::ViewKind::inside}) {
            for (std::uint64_t seed = 0; seed < 4; ++seed) {
                const Camera camera = test::randomView(model.scene, kind, 500 + seed);
                addClassical(classicalRig, model.scene, camera, classical);
                addWatertight(watertightRig, model.scene, camera, watertight);
            }
        }
    }
    std::printf("diced ranges that nobody sees: classical %zu of %zu (%.1f %%), watertight %zu of %zu (%.1f %%)\n", classical.unseen,
                classical.diced, 100.0 * classical.value(), watertight.unseen, watertight.diced, 100.0 * watertight.value());
    EXPECT_GT(watertight.diced, 1000U);
    EXPECT_GT(classical.unseen, 50U);
    EXPECT_LE(watertight.value(), classical.value());
}

}  // namespace
}  // namespace tessera::splitting
