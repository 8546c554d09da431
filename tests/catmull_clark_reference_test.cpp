// The reference of subdivision surfaces against OpenSubdiv's evaluation of the limit: two ways that share nothing.
#include "catmull_clark_reference.h"
#include "subdivision/refiner.h"
#include "subdivision_shapes.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace tessera::test {
namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Sdc = OpenSubdiv::Sdc;

class BfrLimit {
public:
    BfrLimit(const Cage& cage, const subdivision::Refiner& refiner, int levelSharp = 10) : factory_(refiner, options(levelSharp)) {
        for (const glm::vec3& point : cage.points) points_.insert(points_.end(), {point.x, point.y, point.z});
    }

    // Whether the face is drawn.
    bool take(int face) {
        if (!factory_.InitVertexSurface(face, &surface_)) return false;
        patchPoints_.resize(3 * static_cast<std::size_t>(surface_.GetNumPatchPoints()));
        surface_.PreparePatchPoints(points_.data(), 3, patchPoints_.data(), 3);
        return true;
    }

    [[nodiscard]] LimitPoint at(int subFace, double u, double v) const {
        std::array<double, 2> uv{u, v};
        const Bfr::Parameterization parameters = surface_.GetParameterization();
        if (parameters.HasSubFaces()) parameters.ConvertNormalizedSubFaceToCoord(subFace, std::array<double, 2>{u, v}.data(), uv.data());
        glm::dvec3 p, du, dv;
        surface_.Evaluate(uv.data(), patchPoints_.data(), 3, &p.x, &du.x, &dv.x);
        return {p, glm::normalize(glm::cross(du, dv)), true};
    }

private:
    static Bfr::RefinerSurfaceFactory<>::Options options(int levelSharp) {
        Bfr::RefinerSurfaceFactory<>::Options options;
        options.SetApproxLevelSmooth(10).SetApproxLevelSharp(levelSharp);
        return options;
    }

    Bfr::RefinerSurfaceFactory<> factory_;
    Bfr::Surface<double> surface_;
    std::vector<double> points_, patchPoints_;
};

// A way from the corners of the unit square that OpenSubdiv's last cells at irregular vertices do not take.
bool nearCorner(double u, double v) { return std::min(u, 1.0 - u) < 1.0 / 512 && std::min(v, 1.0 - v) < 1.0 / 512; }

bool atCorner(double u, double v) { return (u == 0.0 || u == 1.0) && (v == 0.0 || v == 1.0); }

bool lasting(const Crease& crease, std::uint32_t vertex) { return crease.sharpness >= 10.0F && (crease.a == vertex || crease.b == vertex); }

// Whether a crease that is sharp for ever ends there. OpenSubdiv takes the limit of smooth vertices for it, at its last level.
bool isDart(const Cage& cage, std::uint32_t vertex) {
    return std::count_if(cage.creases.begin(), cage.creases.end(), [&](const Crease& crease) { return lasting(crease, vertex); }) == 1;
}

bool hasDart(const Cage& cage, std::uint32_t face) {
    auto first = cage.faceVertices.begin();
    for (std::uint32_t f = 0; f < face; ++f) first += cage.faceSizes[f];
    return std::any_of(first, first + cage.faceSizes[face], [&](std::uint32_t vertex) { return isDart(cage, vertex); });
}

struct Worst {
    double distance = 0.0, angle = 0.0;  // of the size; radians
    std::string where, whereAngle;
};

void compare(const NamedCage& shape, std::mt19937& random, int samples, Worst& worst, std::size_t& points) {
    const auto refiner = subdivision::makeRefiner(shape.cage);
    BfrLimit bfr(shape.cage, *refiner);
    const CatmullClarkReference reference(shape.cage);
    const double size = sizeOf(shape.cage);
    for (std::uint32_t face = 0; face < shape.cage.faceCount(); ++face) {
        if (!bfr.take(static_cast<int>(face))) continue;
        const std::uint32_t corners = shape.cage.faceSizes[face];
        for (int k = 0; k < samples; ++k) {
            const double steps = std::array{4.0, 64.0, 4096.0}[random() % 3U];
            const auto parameter = [&] { return static_cast<double>(random() % static_cast<std::uint32_t>(steps + 1.0)) / steps; };
            const auto deep = [&] { return random() % 2U == 0 ? std::ldexp(1.0, -9) : 1.0 - std::ldexp(1.0, -9); };
            const double u = k % 4 == 0 ? deep() : parameter(), v = k % 4 == 0 ? deep() : parameter();
            const auto subFace = static_cast<std::uint32_t>(corners == 4 ? 0U : random() % corners);
            const LimitPoint expected = bfr.at(static_cast<int>(subFace), u, v), found = reference.at(face, subFace, u, v);
            const bool unsure = nearCorner(u, v) && (!atCorner(u, v) || hasDart(shape.cage, face));
            const double distance = unsure ? 0.0 : glm::distance(expected.position, found.position) / size;
            const std::string where = shape.name + ", face " + std::to_string(face) + "." + std::to_string(subFace) + " at (" +
                                      std::to_string(u) + ", " + std::to_string(v) + ")";
            ++points;
            if (distance > worst.distance) worst.distance = distance, worst.where = where;
            if (!found.hasNormal || nearCorner(u, v)) continue;
            const double angle = std::asin(std::min(1.0, glm::length(glm::cross(expected.normal, found.normal)))) +
                                 (glm::dot(expected.normal, found.normal) < 0.0 ? 3.0 : 0.0);
            if (angle > worst.angle) worst.angle = angle, worst.whereAngle = where;
        }
    }
}

TEST(CatmullClarkReference, AgreesWithOpenSubdivOnAllShapes) {
    std::mt19937 random(1);
    std::size_t points = 0;
    for (const NamedCage& shape : allShapes()) {
        Worst worst;
        const std::size_t before = points;
        compare(shape, random, 12, worst, points);
        EXPECT_GT(points, before) << shape.name;
        EXPECT_LT(worst.distance, 1e-9) << worst.where;
        EXPECT_LT(worst.angle, 1e-6) << worst.whereAngle;
    }
    EXPECT_GT(points, 20000U);
}

// Where the two disagree OpenSubdiv comes nearer the deeper it goes.
TEST(CatmullClarkReference, IsWhatOpenSubdivComesToAtDarts) {
    double greatest = 0.0;
    for (const NamedCage& shape : allShapes()) {
        if (shape.name != "drum_dart_10_0" && shape.name != "torus_darts_10_0" && shape.name != "box_edges_301_10_0") continue;
        const auto refiner = subdivision::makeRefiner(shape.cage);
        const CatmullClarkReference reference(shape.cage);
        for (std::uint32_t face = 0; face < shape.cage.faceCount(); ++face) {
            for (std::uint32_t corner = 0; corner < 4; ++corner) {
                if (!isDart(shape.cage, shape.cage.faceVertices[4 * face + corner])) continue;
                const double u = corner == 1 || corner == 2 ? 1.0 : 0.0, v = corner >= 2 ? 1.0 : 0.0;
                const glm::dvec3 expected = reference.at(face, 0, u, v).position;
                std::array<double, 4> distances{};
                for (std::size_t k = 0; k < 4; ++k) {
                    BfrLimit bfr(shape.cage, *refiner, 4 + 2 * static_cast<int>(k));
                    ASSERT_TRUE(bfr.take(static_cast<int>(face)));
                    distances[k] = glm::distance(bfr.at(0, u, v).position, expected) / sizeOf(shape.cage);
                }
                for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(distances[k + 1], 0.5 * distances[k] + 1e-12) << shape.name;
                EXPECT_LT(distances[3], 3e-5);
                greatest = std::max(greatest, distances[0]);
            }
        }
    }
    EXPECT_GT(greatest, 1e-5);
}

// Each side comes to an edge by faces of its own.
TEST(CatmullClarkReference, IsTheSameFromBothSidesOfEdges) {
    for (const NamedCage& shape : someShapes()) {
        const CatmullClarkReference reference(shape.cage);
        const double size = sizeOf(shape.cage);
        std::map<std::pair<std::uint32_t, std::uint32_t>, glm::dvec3> quarters;  // of edges, by the vertex that they are near
        std::size_t first = 0, shared = 0;
        for (std::uint32_t face = 0; face < shape.cage.faceCount(); ++face) {
            const std::uint32_t corners = shape.cage.faceSizes[face];
            const auto vertex = [&](std::uint32_t k) { return shape.cage.faceVertices[first + k % corners]; };
            const auto expectAt = [&](std::uint32_t a, std::uint32_t b, const glm::dvec3& position) {
                const auto [at, isNew] = quarters.emplace(std::pair(a, b), position);
                shared += isNew ? 0U : 1U;
                EXPECT_LT(glm::distance(at->second, position), 1e-13 * size) << shape.name;
            };
            for (std::uint32_t k = 0; k < corners; ++k) {
                const auto along = [&](double t) {
                    if (corners != 4)
                        return t < 0.5 ? reference.at(face, k, 2.0 * t, 0.0) : reference.at(face, (k + 1) % corners, 0.0, 2.0 - 2.0 * t);
                    if (k == 0) return reference.at(face, 0, t, 0.0);
                    if (k == 1) return reference.at(face, 0, 1.0, t);
                    return k == 2 ? reference.at(face, 0, 1.0 - t, 1.0) : reference.at(face, 0, 0.0, 1.0 - t);
                };
                expectAt(vertex(k), vertex(k + 1), along(0.25).position);
                expectAt(vertex(k + 1), vertex(k), along(0.75).position);
            }
            first += corners;
        }
        const Drawn drawn = drawnOf(shape.cage);
        EXPECT_TRUE(shared > 0U || drawn.boundaryEdges == drawn.faces * 4) << shape.name;
    }
}

}  // namespace
}  // namespace tessera::test
