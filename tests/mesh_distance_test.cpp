// What the tessellator promises of distances, over whole meshes: no point of a mesh lies farther from the surfaces than was asked for, and
// no point of the surfaces farther from the mesh, in world units or in pixels of a camera's picture.
#include "closed_models.h"
#include "mesh_kept.h"
#include "sample_meshes.h"
#include "surface_distance.h"
#include "tessera/weld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Closed models of all kinds, and built-in scenes whose surfaces are open.
std::vector<ClosedModel> models() {
    std::vector<ClosedModel> all = closedModels();
    for (const std::string name : {"teapot", "nurbs", "quadrics", "pn"}) all.push_back({name, builtinScene(name)});
    for (ClosedModel& model : all) weld(model.scene);
    return all;
}

double sizeOf(const Scene& scene) {
    const Bounds box = worldBounds(scene);
    return glm::length(glm::dvec3(box.upper) - glm::dvec3(box.lower));
}

// How distances are measured: in world units, or in pixels of a picture.
class Measure {
public:
    explicit Measure(const TessellateOptions& options) {
        if (!options.camera) return;
        eye_ = glm::inverse(matrix(options.camera->transform));
        const double slope = std::tan(options.camera->fovy * std::numbers::pi / 360.0);
        focal_ = options.height / 2.0 / slope;
        half_ = glm::dvec2(options.width, options.height) / 2.0;
        near_ = options.camera->near;
    }

    // Whether the point is anywhere that counts: in the picture.
    [[nodiscard]] bool counts(const glm::dvec3& point) const {
        if (focal_ == 0.0) return true;
        const glm::dvec3 at = seen(point);
        return at.z >= near_ && std::abs(at.x) <= half_.x && std::abs(at.y) <= half_.y;
    }

    [[nodiscard]] double between(const glm::dvec3& one, const glm::dvec3& other) const {
        if (focal_ == 0.0) return glm::distance(one, other);
        const glm::dvec3 a = seen(one), b = seen(other);
        return b.z > 0.0 ? glm::distance(glm::dvec2(a), glm::dvec2(b)) : kInfinite;
    }

    // World units that a step of `amount` takes at most, starting from a point that counts.
    [[nodiscard]] double world(double amount, const glm::dvec3& point) const {
        return focal_ == 0.0 ? amount : amount * seen(point).z / focal_;
    }

private:
    // Pixels from the picture's middle, and the depth.
    [[nodiscard]] glm::dvec3 seen(const glm::dvec3& point) const {
        const glm::dvec4 at = eye_ * glm::dvec4(point, 1.0);
        return {focal_ * at.x / -at.z, focal_ * at.y / -at.z, -at.z};
    }

    glm::dmat4 eye_{1.0};
    double focal_ = 0.0;  // pixels; 0 without a camera
    glm::dvec2 half_{0.0};
    double near_ = 0.0;
};

double bound(const TessellateOptions& options) { return options.camera ? options.pixelError : options.tolerance; }

// The greatest distance from places all over the triangles to the patches that they stand for.
double meshToSurface(const KeptMesh& mesh, const PlacedSurfaces& surfaces, const Measure& measure, double limit) {
    constexpr std::array<glm::dvec3, 7> places{{{1.0 / 3, 1.0 / 3, 1.0 / 3},
                                                {0.5, 0.5, 0.0},
                                                {0.5, 0.0, 0.5},
                                                {0.0, 0.5, 0.5},
                                                {0.6, 0.2, 0.2},
                                                {0.2, 0.6, 0.2},
                                                {0.2, 0.2, 0.6}}};
    double greatest = 0.0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        for (const glm::dvec3& place : places) {
            glm::dvec3 point(0.0);
            glm::dvec2 uv(0.0);
            for (int c = 0; c < 3; ++c) {
                const MeshVertex& vertex = mesh.vertices[mesh.indices[t + static_cast<std::size_t>(c)]];
                point += place[c] * glm::dvec3(vertex.position[0], vertex.position[1], vertex.position[2]);
                uv += place[c] * glm::dvec2(vertex.u, vertex.v);
            }
            if (!measure.counts(point)) continue;
            const MeshVertex& first = mesh.vertices[mesh.indices[t]];
            const auto enough = [&](const glm::dvec3& other) { return measure.between(point, other) <= 0.9 * limit; };
            const glm::dvec3 near = surfaces.nearest(surfaces.number(first.object, first.patch), point, uv, enough);
            greatest = std::max(greatest, measure.between(point, near));
        }
    }
    return greatest;
}

// The greatest distance from places all over the patches, `samples` in all or a little more, to any triangle.
double surfaceToMesh(const KeptMesh& mesh, const PlacedSurfaces& surfaces, const Measure& measure, double limit, double samples) {
    const int along = std::max(6, static_cast<int>(std::sqrt(samples / static_cast<double>(surfaces.patches()))));
    reference::Random random(11);
    std::vector<glm::dvec3> points;
    double reach = 0.0;
    for (std::size_t patch = 0; patch < surfaces.patches(); ++patch) {
        for (int k = 0; k < along * along; ++k) {
            glm::dvec2 uv = glm::min((glm::dvec2(k % along, k / along) + random.unit()) / (along - 1.0), glm::dvec2(1.0));
            if (surfaces.kind(patch) == PatchKind::pn) uv.y *= 1.0 - uv.x;
            const glm::dvec3 point = surfaces.at(patch, uv);
            if (!measure.counts(point)) continue;
            points.push_back(point);
            reach = std::max(reach, measure.world(limit, point));
        }
    }
    const NearTriangles near(mesh, 1.01 * reach);
    double greatest = 0.0;
    for (const glm::dvec3& point : points) {
        const std::optional<glm::dvec3> other = near.nearest(point);
        greatest = std::max(greatest, other ? measure.between(point, *other) : kInfinite);
    }
    return greatest;
}

// Both ways; returns the greater of the two distances as a share of what was asked for.
double expectWithin(Tessellator& tessellator, const PlacedSurfaces& surfaces, const TessellateOptions& options, const std::string& where) {
    const KeptMesh mesh = keep(tessellator.tessellate(options));
    const Measure measure(options);
    const double limit = bound(options);
    const double mesh_ = meshToSurface(mesh, surfaces, measure, limit);
    const double surface = surfaceToMesh(mesh, surfaces, measure, limit, 10000.0);
    EXPECT_LE(mesh_, limit) << where << ", from the mesh, " << mesh.indices.size() / 3 << " triangles";
    EXPECT_LE(surface, limit) << where << ", from the surface, " << mesh.indices.size() / 3 << " triangles";
    return std::max(mesh_, surface) / limit;
}

TEST(MeshDistance, StaysWithinTheToleranceBothWays) {
    Tessellator tessellator(meshTestSettings());
    for (const ClosedModel& model : models()) {
        tessellator.setScene(model.scene);
        const PlacedSurfaces surfaces(model.scene);
        for (const double share : {0.03, 3e-3, 4e-4}) {
            TessellateOptions options;
            options.tolerance = share * sizeOf(model.scene);
            const double reached = expectWithin(tessellator, surfaces, options, model.name + ", tolerance " + std::to_string(share));
            // A measure that saw nothing would be content with anything.
            if (model.name != "pn_flat") {
                EXPECT_GT(reached, 0.1) << model.name;
            }
        }
    }
}

TEST(MeshDistance, StaysWithinThePixelErrorBothWaysInThePicture) {
    constexpr std::array<ViewKind, 4> kinds{ViewKind::far, ViewKind::near, ViewKind::grazing, ViewKind::throughNearPlane};
    Tessellator tessellator(meshTestSettings());
    double greatest = 0.0;
    std::uint64_t seed = 0;
    for (const ClosedModel& model : closedModels()) {
        tessellator.setScene(model.scene);
        const PlacedSurfaces surfaces(model.scene);
        for (const double pixels : {0.3, 2.0}) {
            TessellateOptions options;
            options.pixelError = pixels;
            options.width = 128;
            options.height = 96;
            const ViewKind kind = kinds[seed % kinds.size()];
            options.camera = randomView(model.scene, kind, 40 + seed++);
            greatest =
                std::max(greatest, expectWithin(tessellator, surfaces, options,
                                                model.name + ", view " + std::to_string(seed) + ", pixels " + std::to_string(pixels)));
        }
    }
    EXPECT_GT(greatest, 0.1);
}

TEST(MeshDistance, StaysWithinThePixelErrorOfBuiltInPictures) {
    Tessellator tessellator(meshTestSettings());
    for (const std::string name : {"teapot", "nurbs", "quadrics", "pn"}) {
        Scene scene = builtinScene(name);
        weld(scene);
        tessellator.setScene(scene);
        TessellateOptions options;
        options.pixelError = 0.5;
        options.width = 640;
        options.height = 360;
        options.camera = scene.cameras.front();
        EXPECT_GT(expectWithin(tessellator, PlacedSurfaces(scene), options, name), 0.1) << name;
    }
}

}  // namespace
}  // namespace tessera::test
