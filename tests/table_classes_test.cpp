// Tables of coefficients on the host: the same bits on both sides of every edge, and the limit surface.
#include <gtest/gtest.h>
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>

#include <bit>
#include <cmath>
#include <map>
#include <numbers>

#include "subdivision/table_faces.h"
#include "table_cages.h"

namespace tessera::subdivision {
namespace {

using Bits = std::array<std::uint32_t, 3>;

// Points of a cage at a table's step, and the sums over them as the device makes them.
class Sums {
public:
    explicit Sums(const Cage& cage, int steps = 0) : refiner_(makeRefiner(cage)) {
        faces_ = makeTableFaces(*refiner_, steps, store_);
        if (steps == 0) points_ = cage.points;
        for (std::size_t k = 0; k + 1 < faces_.starts.size(); ++k) {
            glm::vec3 sum(0);
            for (std::uint32_t e = faces_.starts[k]; e < faces_.starts[k + 1]; ++e)
                sum += faces_.weights[e] * cage.points[faces_.sources[e]];
            points_.push_back(sum);
        }
    }
    [[nodiscard]] const TableFaces& faces() const { return faces_; }
    [[nodiscard]] const TableStore& store() const { return store_; }

    [[nodiscard]] glm::vec3 at(std::size_t face, std::size_t component, std::uint32_t point) const {
        const table_face& f = faces_.faces[face];
        const RingTable& table = store_.tables()[f.table];
        glm::vec3 sum(0);
        for (std::uint32_t k = 0; k < table.rows; ++k) {
            const std::size_t entry = f.first_entry + k;
            const float weight = table.values[component][faces_.rowOf[entry] * tablePoints + point];
            for (int c = 0; c < 3; ++c) sum[c] = std::fma(weight, points_[faces_.byNumber[entry]][c], sum[c]);
        }
        return sum + 0.0F;
    }

private:
    std::unique_ptr<Refiner> refiner_;
    TableStore store_;
    TableFaces faces_;
    std::vector<glm::vec3> points_;
};

Bits bitsOf(const glm::vec3& p) {
    return {std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y), std::bit_cast<std::uint32_t>(p.z)};
}

std::uint32_t sidePoint(std::uint32_t side, std::uint32_t t) {
    const std::array<std::uint32_t, 4> of{t, 33 * t + 32, 33 * 32 + 32 - t, 33 * (32 - t)};
    return of[side];
}

// Every point of every edge has the same bits from each of its faces, every vertex from all of its own.
void expectSharedBits(const Cage& cage, int steps = 0) {
    const Sums sums(cage, steps);
    std::map<std::array<std::uint32_t, 2>, Bits> known;
    std::size_t differing = 0, compared = 0;
    const TableFaces& faces = sums.faces();
    for (std::size_t f = 0; f < faces.faces.size(); ++f) {
        for (std::uint32_t side = 0; side < 4; ++side) {
            const FaceSide s = faces.sides[f][side];
            for (std::uint32_t t = 0; t < 32; ++t) {
                const std::array<std::uint32_t, 2> key = t == 0 ? std::array<std::uint32_t, 2>{faces.corners[f][side], 0}
                                                                : std::array<std::uint32_t, 2>{s.edge, s.reversed ? 32 - t : t};
                const auto [found, added] = known.try_emplace(key, bitsOf(sums.at(f, 0, sidePoint(side, t))));
                if (added) continue;
                ++compared;
                if (found->second != bitsOf(sums.at(f, 0, sidePoint(side, t)))) ++differing;
            }
        }
    }
    EXPECT_EQ(differing, 0U) << cage.name << ", of " << compared;
    EXPECT_GT(compared, 0U);
}

// All points against Bfr on the whole cage: positions to 1e-5 of its size, normals to 0.1 degrees.
void expectLimit(const Cage& cage) {
    namespace Bfr = OpenSubdiv::Bfr;
    const Sums sums(cage);
    const auto refiner = makeRefiner(cage);
    using Factory = Bfr::RefinerSurfaceFactory<>;
    const Factory factory(*refiner, Factory::Options().SetApproxLevelSmooth(10).SetApproxLevelSharp(10));
    glm::vec3 lower(1e30F), upper(-1e30F);
    for (const glm::vec3& p : cage.points) lower = glm::min(lower, p), upper = glm::max(upper, p);
    const double size = static_cast<double>(glm::length(upper - lower));
    double worst = 0, worstAngle = 0;
    for (std::size_t f = 0; f < sums.faces().faces.size(); ++f) {
        const table_face& face = sums.faces().faces[f];
        const std::unique_ptr<Bfr::Surface<double>> surface(factory.CreateVertexSurface<double>(static_cast<int>(face.number)));
        ASSERT_NE(surface, nullptr);
        std::vector<double> patch(3 * static_cast<std::size_t>(surface->GetNumPatchPoints()));
        std::vector<double> points;
        for (const glm::vec3& p : cage.points) points.insert(points.end(), {double{p.x}, double{p.y}, double{p.z}});
        surface->PreparePatchPoints(points.data(), 3, patch.data(), 3);
        for (std::uint32_t point = 0; point < tablePoints; ++point) {
            const double s = point % 33 / 32.0, t = point / 33 / 32.0;
            const std::array<std::array<double, 2>, 4> turned{{{s, t}, {1 - t, s}, {1 - s, 1 - t}, {t, 1 - s}}};
            std::array<double, 3> p{}, du{}, dv{};
            surface->Evaluate(turned[face.turn].data(), patch.data(), 3, p.data(), du.data(), dv.data());
            // In corners Bfr is not exact where creases end: tables_limit_test has a reference that is.
            const bool corner = (s == 0 || s == 1) && (t == 0 || t == 1);
            const double apart = glm::length(glm::dvec3(sums.at(f, 0, point)) - glm::dvec3(p[0], p[1], p[2])) / size;
            if (!corner) worst = std::max(worst, apart);
            const glm::dvec3 exact =
                glm::cross(glm::normalize(glm::dvec3(du[0], du[1], du[2])), glm::normalize(glm::dvec3(dv[0], dv[1], dv[2])));
            const glm::dvec3 made = glm::cross(glm::dvec3(sums.at(f, 1, point)), glm::dvec3(sums.at(f, 2, point)));
            // Tangents within 1e-3 of each other's direction make no normal that could be told.
            if (!(glm::length(exact) > 1e-3)) continue;
            worstAngle = std::max(worstAngle, std::acos(std::clamp(glm::dot(glm::normalize(exact), glm::normalize(made)), -1.0, 1.0)));
        }
    }
    EXPECT_LT(worst, 1e-6) << cage.name;
    EXPECT_LT(worstAngle * 180 / std::numbers::pi, 0.1) << cage.name;
}

TEST(TableClasses, SharedPointsHaveTheSameBitsInSmallClosedCages) {
    expectSharedBits(test::cubeCage());
    expectSharedBits(test::torusCage(3, 3));
    expectSharedBits(test::torusCage(3, 5));
    expectSharedBits(test::torusCage(4, 6));
    for (const std::uint32_t valence : {2U, 3U, 4U, 5U, 7U}) expectSharedBits(test::lensCage(valence));
}

TEST(TableClasses, SharedPointsHaveTheSameBitsAtEveryValence) {
    for (const std::uint32_t valence : {3U, 4U, 5U, 6U, 9U, 23U, 50U}) {
        Cage cage = test::fanCage(valence);
        test::tagAtRandom(cage, valence, false);
        cage.creases.clear();
        cage.corners.clear();
        expectSharedBits(cage);
    }
}

TEST(TableClasses, SharedPointsHaveTheSameBitsWithRandomTags) {
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        for (const bool open : {false, true}) {
            std::vector<Cage> cages = {test::cubeCage(), test::torusCage(3, 4), test::fanCage(3 + seed), test::extrudedCage(6, seed)};
            for (Cage& cage : cages) {
                test::tagAtRandom(cage, seed, open);
                cage.boundary = seed == 2 ? BoundaryRule::edgeOnly : BoundaryRule::edgeAndCorner;
                expectSharedBits(cage);
            }
        }
    }
}

TEST(TableClasses, SharedPointsHaveTheSameBitsAfterACoarseStep) {
    Cage cage = test::prismCage(5);
    test::tagAtRandom(cage, 7, false);
    expectSharedBits(cage, 1);
    expectSharedBits(test::prismCage(3), 1);
    expectSharedBits(test::cubeCage(), 2);
}

TEST(TableClasses, TablesGiveTheLimitSurface) {
    expectLimit(test::cubeCage());
    expectLimit(test::torusCage(3, 3));
    for (const std::uint32_t valence : {2U, 3U, 6U}) expectLimit(test::lensCage(valence));
    for (const std::uint32_t valence : {3U, 5U, 8U, 50U}) expectLimit(test::fanCage(valence));
    for (const std::uint32_t seed : {1U, 2U}) {
        Cage cage = test::extrudedCage(4, seed);
        test::tagAtRandom(cage, seed, seed == 2);
        expectLimit(cage);
    }
}

TEST(TableClasses, NeighbourhoodsThatAreTheSameShareTheirTable) {
    const Sums torus(test::torusCage(5, 7)), cube(test::cubeCage());
    EXPECT_EQ(torus.store().tables().size(), 1U);
    EXPECT_EQ(torus.store().classes().edgeClasses(), 1U);
    EXPECT_EQ(torus.store().classes().vertexClasses(), 1U);
    EXPECT_EQ(cube.store().tables().size(), 1U);
}

}  // namespace
}  // namespace tessera::subdivision
