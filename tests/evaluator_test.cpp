// The device's one function for surface points, which dice and shade call, against the reference in double precision.
#include "sample_meshes.h"

#include "patch_eval.h"
#include "ray_caster.h"

#include "device/session.h"
#include "film/film.h"
#include "render/frame_setup.h"
#include "surface/evaluate_shared.h"
#include "surface/patch_set.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace tessera {
namespace {

// A surface point as the device gives it, turned back from its eye space (z is the depth) to the axes of the camera.
reference::SurfacePoint fromDevice(const float* values) {
    const auto vector = [&](int first) { return glm::dvec3(values[first], values[first + 1], -static_cast<double>(values[first + 2])); };
    return {vector(0), vector(3), vector(6)};
}

class Evaluator {
public:
    Evaluator() : session_(-1, kernelSources(), TESSERA_TEST_CACHE) {}

    [[nodiscard]] std::vector<reference::SurfacePoint> run(const Scene& scene, const Camera& camera,
                                                           const std::vector<evaluate_point>& at) {
        RenderOptions options;
        options.mode = DiceMode::classical;
        const PatchSet patches = uploadPatches(scene, session_.memory, session_.timeline);
        frame_params frame = setUpFrame(camera, options, layOutFilm(options), false);
        setPatches(frame, patches);
        const std::vector<placed_object> placed = placeObjects(scene, eyeFromWorld(camera));
        const DeviceBuffer objects = buffer(placed.data(), placed.size() * sizeof(placed_object));
        const DeviceBuffer points = buffer(at.data(), at.size() * sizeof(evaluate_point));
        const DeviceBuffer out = session_.memory.allocate(Purpose::scene, "results", at.size() * 9 * sizeof(float));
        Timeline& timeline = session_.timeline;
        enqueuePlace(session_, frame, patches, objects.cl(), patches.eyePoints.cl());
        timeline.launch(
            session_.kernels.with("evaluate_points", frame, patches.eyePoints.cl(), points.cl(), static_cast<cl_uint>(at.size()), out.cl()),
            "evaluate_points", 4, 64);
        std::vector<float> values(at.size() * 9);
        timeline.read(out.cl(), values.data(), values.size() * sizeof(float));
        std::vector<reference::SurfacePoint> result;
        for (std::size_t i = 0; i < at.size(); ++i) result.push_back(fromDevice(values.data() + 9 * i));
        return result;
    }

private:
    [[nodiscard]] DeviceBuffer buffer(const void* data, std::size_t bytes) {
        DeviceBuffer result = session_.memory.allocate(Purpose::scene, "input", bytes);
        session_.timeline.write(result.cl(), data, bytes);
        return result;
    }

    DeviceSession session_;
};

// A lattice over each patch with its borders and corners, and points close to them.
std::vector<evaluate_point> lattice(std::uint32_t patches) {
    const std::array<float, 9> at{0.0F, 1e-6F, 0.01F, 0.2F, 0.5F, 0.77F, 0.99F, 1.0F - 0x1p-20F, 1.0F};
    std::vector<evaluate_point> points;
    for (std::uint32_t patch = 0; patch < patches; ++patch)
        for (const float v : at)
            for (const float u : at) points.push_back({patch, u, v});
    return points;
}

// The patches in the order in which the device numbers them, in the camera's axes. Requires Bezier objects first.
std::vector<std::pair<PatchKind, std::vector<glm::dvec3>>> patchesSeenFrom(const Scene& scene, const Camera& camera) {
    const reference::Placement eye = reference::placement(camera.transform);
    std::vector<std::pair<PatchKind, std::vector<glm::dvec3>>> result;
    for (const Object& object : scene.objects) {
        const Mesh& mesh = *scene.findMesh(object.mesh);
        for (std::size_t patch = 0; patch < mesh.patchCount(); ++patch) {
            std::vector<glm::dvec3> points = reference::patchPoints(mesh, patch);
            for (glm::dvec3& point : points)
                point = glm::transpose(eye.rotation) * (reference::placement(object.transform)(point) - eye.translation);
            result.emplace_back(mesh.kind, std::move(points));
        }
    }
    return result;
}

double ulp(double value) { return std::exp2(std::floor(std::log2(value)) - 23); }

// Positions: 1e-5 of the patch's size and 8 ulp of its largest coordinate (in the eye's axes, where the device computes). Tangents
// are sums of differences of points with coefficients up to 3: six times that. An error e in both tangents turns the normal
// by e (|du| + |dv|) / |du x dv|; where that is no small angle, at poles, there is nothing to compare.
void expectExact(const Scene& scene, const Camera& camera) {
    const auto patches = patchesSeenFrom(scene, camera);
    const std::vector<evaluate_point> at = lattice(static_cast<std::uint32_t>(patches.size()));
    const std::vector<reference::SurfacePoint> seen = Evaluator().run(scene, camera, at);
    std::size_t normals = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
        SCOPED_TRACE(::testing::Message() << "patch " << at[i].patch_index << ", u " << at[i].u << ", v " << at[i].v);
        const auto& [kind, points] = patches[at[i].patch_index];
        double largest = 0.0;
        for (const glm::dvec3& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        const double tolerance = 1e-5 * reference::patchSize(points) + 8 * ulp(largest);
        const reference::SurfacePoint exact = reference::evaluate(kind, points, at[i].u, at[i].v);
        EXPECT_LE(glm::length(seen[i].position - exact.position), tolerance);
        EXPECT_LE(glm::length(seen[i].du - exact.du), 6 * tolerance);
        EXPECT_LE(glm::length(seen[i].dv - exact.dv), 6 * tolerance);
        const double area = glm::length(glm::cross(exact.du, exact.dv));
        const double turn = 6 * tolerance * (glm::length(exact.du) + glm::length(exact.dv)) / area;
        if (!(turn < 0.1)) continue;
        ++normals;
        const glm::dvec3 normal = glm::normalize(glm::cross(seen[i].du, seen[i].dv));
        EXPECT_LE(glm::length(normal - reference::unitNormal(kind, points, at[i].u, at[i].v)), 1.1 * turn);
    }
    EXPECT_GT(normals, at.size() * 3 / 4);
}

TEST(Evaluator, AgreesOnTheTeapot) { expectExact(builtinScene("teapot"), reference::cameraAt({3, 4, 2}, {0, 0, 1}, 45)); }

TEST(Evaluator, AgreesOnBezierAndRationalGregoryPatches) {
    const Scene scene = reference::sceneOf(
        {reference::bumpyBezierMesh(1, 20), reference::parted(reference::asGregory(reference::bumpyBezierMesh(2, 20)), 0.3, 3)});
    expectExact(scene, reference::cameraAt({0.5, 1, 5}, {0, 0, 0}, 45));
}

TEST(Evaluator, AgreesOnTurnedObjectsFarFromTheOrigin) {
    Scene scene = reference::sceneOf(
        {reference::bumpyBezierMesh(4, 5), reference::parted(reference::asGregory(reference::bumpyBezierMesh(5, 5)), 0.3, 6)});
    for (Object& object : scene.objects) {
        object.transform.rotation = glm::quat(0.5F, 1.0F, -0.3F, 0.2F);
        object.transform.translation = {300.0F, -20.0F, 50.0F};
    }
    expectExact(scene, reference::cameraAt({301, -19, 55}, {300, -20, 50}, 45));
}

}  // namespace
}  // namespace tessera
