// Meshes from tables on the device: the limit surface, with the same bits on both sides of every edge, at every level.
#include <gtest/gtest.h>
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>

#include <CL/cl.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "mesh/weld_numbers.h"
#include "subdivision/refiner.h"
#include "table_cages.h"
#include "tessera/error.h"
#include "tessera/subdivision_tables.h"

namespace tessera {
namespace {

using Bits = std::array<std::uint32_t, 3>;

Bits bitsOf(const float* p) {
    return {std::bit_cast<std::uint32_t>(p[0]), std::bit_cast<std::uint32_t>(p[1]), std::bit_cast<std::uint32_t>(p[2])};
}

struct Kept {
    std::vector<MeshVertex> vertices;
    std::vector<std::uint32_t> indices;
};

Kept keep(const DeviceMesh& mesh) {
    Kept kept;
    kept.vertices.resize(mesh.sizes.vertices);
    kept.indices.resize(3 * mesh.sizes.triangles);
    clEnqueueReadBuffer(mesh.queue, mesh.vertices, CL_TRUE, 0, kept.vertices.size() * sizeof(MeshVertex), kept.vertices.data(), 0, nullptr,
                        nullptr);
    clEnqueueReadBuffer(mesh.queue, mesh.indices, CL_TRUE, 0, kept.indices.size() * 4, kept.indices.data(), 0, nullptr, nullptr);
    return kept;
}

Scene sceneOf(const Cage& cage) {
    Scene scene;
    scene.name = "test";
    scene.cages.push_back(cage);
    Object object;
    object.name = "object";
    object.mesh = cage.name;
    object.transform.rotation = glm::quat(0.9F, 0.1F, -0.3F, 0.2F);
    object.transform.translation = glm::vec3(0.3F, -2.0F, 1.1F);
    scene.objects.push_back(object);
    return scene;
}

RendererSettings settings(int lanes = 0) {
    RendererSettings out;
    out.lanes = lanes;
    out.cacheFolder = TESSERA_TEST_CACHE;
    return out;
}

TableTessellator& tessellator() {
    static TableTessellator shared(settings());
    return shared;
}

// Edges of triangles that have no other way round, corners told apart by their bits.
std::size_t openEdges(const Kept& mesh) {
    std::map<Bits, std::uint32_t> numbers;
    std::vector<std::uint32_t> numberOf;
    for (const MeshVertex& v : mesh.vertices)
        numberOf.push_back(numbers.try_emplace(bitsOf(v.position), static_cast<std::uint32_t>(numbers.size())).first->second);
    std::map<std::array<std::uint32_t, 2>, int> balance;
    for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t a = numberOf[mesh.indices[k + c]], b = numberOf[mesh.indices[k + (c + 1) % 3]];
            balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    }
    return static_cast<std::size_t>(std::count_if(balance.begin(), balance.end(), [](const auto& edge) { return edge.second != 0; }));
}

// The limit surface of a cage of quadrilaterals in its object's place.
class Limit {
public:
    explicit Limit(const Scene& scene) : place_(matrix(scene.objects[0].transform)), refiner_(subdivision::makeRefiner(scene.cages[0])) {
        using Factory = OpenSubdiv::Bfr::RefinerSurfaceFactory<>;
        const Factory factory(*refiner_, Factory::Options().SetApproxLevelSmooth(10).SetApproxLevelSharp(10));
        std::vector<double> points;
        for (const glm::vec3& p : scene.cages[0].points) points.insert(points.end(), {double{p.x}, double{p.y}, double{p.z}});
        for (int face = 0; face < refiner_->GetLevel(0).GetNumFaces(); ++face) {
            surfaces_.emplace_back(factory.CreateVertexSurface<double>(face));
            std::vector<double>& patch = patches_.emplace_back(3 * static_cast<std::size_t>(surfaces_.back()->GetNumPatchPoints()));
            surfaces_.back()->PreparePatchPoints(points.data(), 3, patch.data(), 3);
        }
    }
    [[nodiscard]] glm::dvec3 at(std::uint32_t face, double u, double v) const {
        const std::array<double, 2> place{u, v};
        std::array<double, 3> p{};
        surfaces_[face]->Evaluate(place.data(), patches_[face].data(), 3, p.data());
        return {place_ * glm::dvec4(p[0], p[1], p[2], 1)};
    }

private:
    glm::dmat4 place_;
    std::unique_ptr<subdivision::Refiner> refiner_;
    std::vector<std::unique_ptr<OpenSubdiv::Bfr::Surface<double>>> surfaces_;
    std::vector<std::vector<double>> patches_;
};

TEST(Tables, ClosedCagesGiveClosedMeshesAtEveryLevel) {
    std::vector<Cage> cages = {test::cubeCage(), test::torusCage(3, 3), test::lensCage(5), test::prismCage(5), test::extrudedCage(8, 3)};
    test::tagAtRandom(cages.back(), 3, false);
    for (const Cage& cage : cages) {
        tessellator().setScene(sceneOf(cage));
        for (int level = 0; level <= 5; ++level) {
            TableOptions options;
            options.level = level;
            const Kept mesh = keep(tessellator().tessellate(options));
            EXPECT_EQ(openEdges(mesh), 0U) << cage.name << ", level " << level;
        }
    }
}

TEST(Tables, VerticesLieOnTheLimitSurfaceInBothOrders) {
    Cage cage = test::extrudedCage(5, 9);
    test::tagAtRandom(cage, 9, false);
    const Scene scene = sceneOf(cage);
    const Limit limit(scene);
    tessellator().setScene(scene);
    for (const TableOrder order : {TableOrder::global, TableOrder::unordered}) {
        for (const int level : {0, 1, 3, 5, 6}) {
            TableOptions options;
            options.level = level;
            options.order = order;
            const Kept mesh = keep(tessellator().tessellate(options));
            double worst = 0, worstLength = 0;
            for (const MeshVertex& v : mesh.vertices) {
                // In corners Bfr is not exact where creases end: tables_limit_test has a reference that is.
                const bool corner = (v.u == 0 || v.u == 1) && (v.v == 0 || v.v == 1);
                if (level <= 5 && !corner)
                    worst = std::max(worst, glm::length(limit.at(v.patch, double{v.u}, double{v.v}) -
                                                        glm::dvec3(v.position[0], v.position[1], v.position[2])));
                worstLength = std::max(worstLength, std::fabs(glm::length(glm::dvec3(v.normal[0], v.normal[1], v.normal[2])) - 1.0));
            }
            EXPECT_LT(worst, 1e-5) << level;
            EXPECT_LT(worstLength, 1e-5) << level;
            EXPECT_EQ(mesh.vertices.size() / (std::size_t{1} << 2 * std::max(level - 5, 0)),
                      cage.faceCount() * ((std::size_t{1} << std::min(level, 5)) + 1) * ((std::size_t{1} << std::min(level, 5)) + 1));
        }
    }
}

double distanceTo(const std::array<glm::dvec3, 3>& t, const glm::dvec3& p) {
    const glm::dvec3 e = t[1] - t[0], f = t[2] - t[0], n = glm::cross(e, f), d = p - t[0];
    const double square = glm::dot(n, n);
    if (square > 0) {
        const double a = glm::dot(glm::cross(d, f), n) / square, b = glm::dot(glm::cross(e, d), n) / square;
        if (a >= 0 && b >= 0 && a + b <= 1) return std::fabs(glm::dot(d, n)) / std::sqrt(square);
    }
    double least = 1e300;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 along = t[(k + 1) % 3] - t[k], from = p - t[k];
        const double length = glm::dot(along, along);
        const double at = length > 0 ? std::clamp(glm::dot(from, along) / length, 0.0, 1.0) : 0.0;
        least = std::min(least, glm::length(from - at * along));
    }
    return least;
}

// The greatest distance of points of the surface, some hundred of each face, from the triangles of their own face.
double worstDistance(const Kept& mesh, const Limit& limit) {
    std::map<std::uint32_t, std::vector<std::array<glm::dvec3, 3>>> triangles;
    const auto corner = [&](std::size_t k) {
        const float* const p = mesh.vertices[mesh.indices[k]].position;
        return glm::dvec3(p[0], p[1], p[2]);
    };
    for (std::size_t k = 0; k < mesh.indices.size(); k += 3)
        triangles[mesh.vertices[mesh.indices[k]].patch].push_back({corner(k), corner(k + 1), corner(k + 2)});
    double worst = 0;
    for (const auto& [patch, own] : triangles) {
        constexpr int side = 19;
        for (int k = 0; k <= side * side + 2 * side; ++k) {
            // Denser towards the corners, where irregular vertices are.
            const auto place = [](int i) { return 0.5 - 0.5 * std::cos(3.14159265358979 * i / side); };
            const glm::dvec3 p = limit.at(patch, place(k % (side + 1)), place(k / (side + 1)));
            double least = 1e300;
            for (const auto& triangle : own) least = std::min(least, distanceTo(triangle, p));
            worst = std::max(worst, least);
        }
    }
    return worst;
}

TEST(Tables, MeshesKeepTheirToleranceAndStayClosed) {
    for (const std::uint32_t seed : {1U, 4U}) {
        Cage cage = test::extrudedCage(6, seed);
        if (seed != 1) test::tagAtRandom(cage, seed, false);
        const Scene scene = sceneOf(cage);
        const Limit limit(scene);
        tessellator().setScene(scene);
        for (const double tolerance : {0.1, 0.02, 0.004}) {
            TableOptions options;
            options.tolerance = tolerance;
            const DeviceMesh made = tessellator().tessellate(options);
            const Kept mesh = keep(made);
            EXPECT_EQ(openEdges(mesh), 0U) << tolerance;
            // Patches of a mesh that took more steps are no longer the cage's.
            if (tessellator().tables().coarseSteps == 0) {
                const double worst = worstDistance(mesh, limit);
                EXPECT_LE(worst, tolerance);
                std::set<std::uint32_t> counts;
                std::map<std::uint32_t, std::uint32_t> each;
                for (const MeshVertex& v : mesh.vertices) ++each[v.patch];
                for (const auto& [patch, count] : each) counts.insert(count);
                EXPECT_GT(counts.size(), 1U) << "of one level alone";
            }
        }
    }
}

TEST(Tables, OnlyControlPointsAreUploadedForTheNextFrame) {
    Cage cage = test::extrudedCage(6, 2);
    tessellator().setScene(sceneOf(cage));
    TableOptions options;
    options.level = 3;
    const Kept first = keep(tessellator().tessellate(options));
    for (glm::vec3& p : cage.points) p.y *= 1.25F;
    tessellator().replacePoints(0, cage.points);
    const Kept second = keep(tessellator().tessellate(options));
    EXPECT_EQ(tessellator().statistics().uploadedBytes, cage.points.size() * sizeof(glm::vec3));
    EXPECT_EQ(openEdges(second), 0U);
    tessellator().setScene(sceneOf(cage));
    const Kept anew = keep(tessellator().tessellate(options));
    ASSERT_EQ(anew.vertices.size(), second.vertices.size());
    for (std::size_t k = 0; k < anew.vertices.size(); ++k)
        ASSERT_EQ(bitsOf(anew.vertices[k].position), bitsOf(second.vertices[k].position));
    EXPECT_NE(bitsOf(first.vertices[5].position), bitsOf(second.vertices[5].position));
}

// Takes a stream, and welds it by number.
class WeldingSink final : public MeshSink {
public:
    void begin(const MeshOutline& outline) override {
        numbers_ = std::make_unique<WeldNumbers>(outline, WeldScope::object);
        patches = outline.patches.size();
        bits.resize(numbers_->vertexCount());
        set.resize(numbers_->vertexCount());
    }
    void take(const MeshPiece& piece) override {
        ++pieces;
        for (const MeshUnit& unit : piece.units) {
            numbers_->loop(unit.patch, loop_);
            for (std::uint64_t k = 0; k < unit.vertices; ++k) {
                const std::uint64_t number = k < loop_.size() ? loop_[k] : numbers_->firstInner(unit.patch) + (k - loop_.size());
                const Bits here = bitsOf(piece.vertices[unit.firstVertex + k].position);
                if (set[number] && bits[number] != here) ++differing;
                bits[number] = here;
                set[number] = true;
            }
            triangles += unit.triangles;
        }
    }
    std::vector<Bits> bits;
    std::vector<bool> set;
    std::size_t differing = 0, pieces = 0, patches = 0;
    std::uint64_t triangles = 0;

private:
    std::unique_ptr<WeldNumbers> numbers_;
    std::vector<std::uint64_t> loop_;
};

TEST(Tables, StreamsWeldWhatIsSharedAndNothingElse) {
    Cage cage = test::extrudedCage(12, 5);
    Scene scene = sceneOf(cage);
    Object second = scene.objects[0];
    second.name = "second";
    second.transform.translation.x += 20;
    scene.objects.push_back(second);
    tessellator().setScene(scene);
    for (const bool adaptive : {false, true}) {
        TableOptions options;
        if (adaptive)
            options.tolerance = 0.02;
        else
            options.level = 4;
        WeldingSink sink;
        tessellator().stream(options, sink);
        EXPECT_EQ(sink.differing, 0U);
        EXPECT_EQ(std::count(sink.set.begin(), sink.set.end(), false), 0);
        const Kept mesh = keep(tessellator().tessellate(options));
        std::set<Bits> distinct;
        for (const MeshVertex& v : mesh.vertices) distinct.insert(bitsOf(v.position));
        EXPECT_EQ(sink.bits.size(), distinct.size());
        EXPECT_EQ(sink.triangles, mesh.indices.size() / 3);
        EXPECT_EQ(openEdges(mesh), 0U);
    }
}

TEST(Tables, MeshesAreTheSameForEveryNumberOfLanes) {
    Cage cage = test::extrudedCage(6, 4);
    test::tagAtRandom(cage, 4, false);
    TableTessellator eight(settings(8)), one(settings(1));
    for (const double tolerance : {0.0, 0.02}) {
        TableOptions options;
        options.tolerance = tolerance;
        if (tolerance == 0) options.level = 4;
        tessellator().setScene(sceneOf(cage));
        const Kept wide = keep(tessellator().tessellate(options));
        for (TableTessellator* const other : {&eight, &one}) {
            other->setScene(sceneOf(cage));
            const Kept narrow = keep(other->tessellate(options));
            EXPECT_EQ(narrow.indices, wide.indices);
            ASSERT_EQ(narrow.vertices.size(), wide.vertices.size());
            for (std::size_t k = 0; k < wide.vertices.size(); ++k) {
                const MeshVertex &a = wide.vertices[k], &b = narrow.vertices[k];
                ASSERT_EQ(bitsOf(a.position), bitsOf(b.position)) << k;
                ASSERT_EQ(std::tie(a.u, a.v, a.object, a.patch), std::tie(b.u, b.v, b.object, b.patch)) << k;
                for (int c = 0; c < 3; ++c) ASSERT_NEAR(a.normal[c], b.normal[c], 1e-5) << k;
            }
        }
    }
}

TEST(Tables, CoarseStepsKeepTheSurface) {
    const Cage cage = test::prismCage(4);
    tessellator().setScene(sceneOf(cage));
    const auto pointsAt = [&](int level) {
        TableOptions options;
        options.level = level;
        return keep(tessellator().tessellate(options));
    };
    // Level 6 is level 5 after a step: the vertices of level 5 are among its own.
    const Kept coarse = pointsAt(5), fine = pointsAt(6);
    EXPECT_EQ(openEdges(fine), 0U);
    std::map<std::array<long, 3>, int> near;
    const auto cell = [](const MeshVertex& v, int c) { return std::lround(v.position[c] * 4096); };
    for (const MeshVertex& v : fine.vertices)
        for (long x = -1; x <= 1; ++x)
            for (long y = -1; y <= 1; ++y)
                for (long z = -1; z <= 1; ++z) near[{cell(v, 0) + x, cell(v, 1) + y, cell(v, 2) + z}] = 1;
    std::size_t missing = 0;
    for (const MeshVertex& v : coarse.vertices) missing += near.contains({cell(v, 0), cell(v, 1), cell(v, 2)}) ? 0U : 1U;
    EXPECT_EQ(missing, 0U);
}

TEST(Tables, WhatIsNoCatmullClarkCageIsRefused) {
    Scene scene = sceneOf(test::cubeCage());
    scene.cages[0].scheme = SubdivisionScheme::bilinear;
    EXPECT_THROW(tessellator().setScene(scene), Error);
    EXPECT_THROW(tessellator().setScene(sceneOf(test::extrudedCage(4, 1)), 180, 1000), Error);
    tessellator().setScene(sceneOf(test::cubeCage()));
    EXPECT_THROW((void)tessellator().measure(TableOptions()), Error);
    TableOptions both;
    both.level = 2;
    both.tolerance = 0.1;
    EXPECT_THROW((void)tessellator().measure(both), Error);
    both.tolerance = 0;
    both.memoryBytes = 1000;
    EXPECT_THROW((void)tessellator().tessellate(both), Error);
}

}  // namespace
}  // namespace tessera
