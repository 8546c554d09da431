// Rates that a tessellation gives to sides and patches: neighbours agree, nothing is without bound, and what is not seen is left out.
#include "mesh_rig.h"

#include "border_models.h"
#include "closed_models.h"
#include "patch_eval.h"
#include "ray_caster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>

namespace tessera::test {
namespace {

using splitting::BorderLook;
using splitting::SharedBorder;

constexpr std::array<double, 4> someTolerances{0.1, 0.02, 1e-3, 3e-5};

// By object and patch.
using Placed = std::map<std::pair<std::uint32_t, std::uint32_t>, mesh_pattern>;

Placed byPatch(const MeshRig& rig, const std::vector<mesh_pattern>& patterns) {
    Placed result;
    for (std::size_t k = 0; k < patterns.size(); ++k) result[{rig.placed()[k].object, rig.placed()[k].index_in_mesh}] = patterns[k];
    return result;
}

bool same(const std::vector<mesh_pattern>& a, const std::vector<mesh_pattern>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(mesh_pattern)) == 0;
}

// Segments on a whole curve, by each of its users; all are the same where all agree.
void expectAgreement(const SharedBorder& shared, const Placed& patterns) {
    std::uint32_t first = 0;
    for (std::size_t k = 0; k < shared.users.size(); ++k) {
        const splitting::BorderUser& user = shared.users[k];
        const std::uint32_t whole = patterns.at({static_cast<std::uint32_t>(k), 0}).side[user.side] << user.level;
        if (k == 0) first = whole;
        EXPECT_EQ(whole, first) << "user " << k << " of " << shared.text;
        EXPECT_EQ(whole == 0, shared.onePoint) << shared.text;
    }
}

void expectNeighboursAgree(BorderLook look, int cases, std::uint64_t seed) {
    reference::Random random(seed);
    MeshRig rig;
    for (int k = 0; k < cases; ++k) {
        const SharedBorder shared = splitting::sharedBorder(look, random);
        rig.place(shared.scene);
        for (const double tolerance : someTolerances) expectAgreement(shared, byPatch(rig, rig.factors(viewOf(tolerance))));
        const Camera camera = reference::cameraAt(random.inCube(2.5), random.inCube(0.7), 50);
        expectAgreement(shared, byPatch(rig, rig.factors(viewOf(camera, 0.7, 1280, 720, false))));
    }
}

TEST(SideRates, AgreeOnSharedCurvesOfAnyKindAndDirection) { expectNeighboursAgree(BorderLook::own, 60, 1); }

TEST(SideRates, AgreeOnRecordedCurvesOfUsersOfAnyLevel) { expectNeighboursAgree(BorderLook::recorded, 60, 2); }

// At the last tolerance, to the bit, that gives a rate, and the next one, a difference of one rounding between users would show.
TEST(SideRates, AgreeToTheLastBitOfTheTolerance) {
    reference::Random random(4);
    MeshRig rig;
    for (int k = 0; k < 40; ++k) {
        const SharedBorder shared = splitting::sharedBorder(k % 2 == 0 ? BorderLook::own : BorderLook::recorded, random);
        rig.place(shared.scene);
        const auto at = [&](float tolerance) { return byPatch(rig, rig.factors(viewOf(tolerance))); };
        const auto rate = [&](float tolerance) { return at(tolerance).at({0U, 0U}).side[shared.users.front().side]; };
        float low = 1e-3F;
        float high = 2e-3F;
        const std::uint32_t finer = rate(low);
        while (std::nextafter(low, high) < high) {
            const float middle = 0.5F * (low + high);
            (rate(middle) == finer ? low : high) = middle;
        }
        expectAgreement(shared, at(low));
        expectAgreement(shared, at(high));
    }
}

TEST(SideRates, AreNoneOfCurvesThatAreOnePoint) { expectNeighboursAgree(BorderLook::onePoint, 20, 3); }

TEST(SideRates, AreTheSameForAnyNumberOfLanes) {
    const Scene scene = closedModels().front().scene;
    MeshRig native;
    native.place(scene);
    for (const int lanes : {8, 1}) {
        MeshRig rig(lanes);
        rig.place(scene);
        for (const double tolerance : someTolerances) EXPECT_TRUE(same(native.factors(viewOf(tolerance)), rig.factors(viewOf(tolerance))));
    }
}

// Borders of a closed model, by the bits of their corners' places, have two users each.
TEST(SideRates, AgreeAllOverClosedModels) {
    MeshRig rig;
    for (const ClosedModel& model : closedModels()) {
        SCOPED_TRACE(model.name);
        rig.place(model.scene);
        for (const ViewKind kind : {ViewKind::far, ViewKind::near, ViewKind::inside}) {
            const std::vector<mesh_pattern> patterns = rig.factors(viewOf(randomView(model.scene, kind, 7), 0.5, 640, 480, false));
            std::map<std::uint32_t, std::size_t> users;
            for (const mesh_pattern& p : patterns)
                for (const std::uint32_t side : p.side) users[side] += 1;
            for (const auto& [rate, count] : users) {
                EXPECT_TRUE(rate == 0 || count % 2 == 0) << "of rate " << rate;
            }
        }
    }
}

// As tolerance falls, rates rise or stay.
TEST(SideRates, RiseAsToleranceFalls) {
    MeshRig rig;
    for (const ClosedModel& model : closedModels()) {
        rig.place(model.scene);
        std::vector<mesh_pattern> before = rig.factors(viewOf(0.3));
        for (double tolerance = 0.2; tolerance > 1e-5; tolerance *= 0.6) {
            const std::vector<mesh_pattern> patterns = rig.factors(viewOf(tolerance));
            for (std::size_t k = 0; k < patterns.size(); ++k) {
                for (std::size_t s = 0; s < 4 && before[k].form != MESH_NOTHING; ++s) EXPECT_GE(patterns[k].side[s], before[k].side[s]);
            }
            before = patterns;
        }
    }
}

TEST(SideRates, AreThreeAtLeastOfCurvesThatComeBack) {
    Mesh mesh = reference::bumpyBezierMesh(3, 1);
    mesh.points[3] = mesh.points[0];
    MeshRig rig;
    rig.place(reference::sceneOf({mesh}));
    EXPECT_EQ(rig.factors(viewOf(1e3)).front().side[0], 3U);
}

// What a pattern must keep to, whatever the patch.
void expectSound(const mesh_pattern& p) {
    EXPECT_LE(p.form, MESH_FAN_3);
    for (const std::uint32_t side : p.side) EXPECT_LE(side, MESH_RATE_MOST);
    if (p.form != MESH_RING && p.form != MESH_TRIANGLE_RING) return;
    EXPECT_LE(p.cells_u, MESH_RATE_MOST + 2);
    EXPECT_LE(p.cells_v, MESH_RATE_MOST + 2);
    EXPECT_GT(p.low_u, 0U);
    EXPECT_GT(p.low_v, 0U);
    EXPECT_LT(p.high_u, 1U << 24U);
    if (p.form == MESH_TRIANGLE_RING) {
        EXPECT_EQ(p.low_u + p.low_v<p.high_u, p.cells_u> 0);
        return;
    }
    EXPECT_LT(p.high_v, 1U << 24U);
    EXPECT_GE(std::min(p.cells_u, p.cells_v), 2U);
    EXPECT_EQ(p.low_u<p.high_u, p.cells_u> 2);
    EXPECT_EQ(p.low_v<p.high_v, p.cells_v> 2);
}

std::vector<Mesh> extremes() {
    std::vector<Mesh> meshes;
    for (const float size : {1e-9F, 1e-3F, 1.0F, 5e8F}) {
        for (Mesh mesh :
             {reference::bumpyBezierMesh(1, 6), reference::parted(reference::asGregory(reference::bumpyBezierMesh(2, 6)), 0.3, 4),
              reference::weighted(reference::bumpyBezierMesh(3, 6), 1e6, 5), reference::bumpyPnMesh(4, 6)}) {
            for (glm::vec3& point : mesh.points) point *= size * 0.8F;
            for (std::size_t k = 0; k < pointsPerPatch(mesh.kind); ++k) mesh.points[k] = mesh.points[0];  // the first is a point
            meshes.push_back(mesh);
        }
    }
    return meshes;
}

TEST(PatchRates, AreSoundOfExtremePatches) {
    const Scene scene = reference::sceneOf(extremes());
    for (const int lanes : {0, 1}) {
        MeshRig rig(lanes);
        rig.place(scene);
        for (const double tolerance : {1e-30, 1e-6, 1.0, 1e9, 1e30}) {
            for (const mesh_pattern& p : rig.factors(viewOf(tolerance, 1e-38))) expectSound(p);
        }
        const Camera camera = reference::cameraAt({3, 4, 5}, {0, 0, 0}, 50);
        for (const mesh_pattern& p : rig.factors(viewOf(camera, 1e-6, 640, 480, false))) expectSound(p);
    }
}

TEST(PatchRates, SayWhereMoreIsAskedForThanThereMayBe) {
    MeshRig rig;
    rig.place(reference::sceneOf({reference::bumpyBezierMesh(1, 2)}));
    for (const mesh_pattern& p : rig.factors(viewOf(1e-12, 1e-12))) EXPECT_EQ(p.refused, 1U);
    for (const mesh_pattern& p : rig.factors(viewOf(1e-3))) EXPECT_EQ(p.refused, 0U);
}

}  // namespace
}  // namespace tessera::test
