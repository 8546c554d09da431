// Cells of Gregory and bicubic patches against OpenSubdiv's own patches and its limit surface, and the distance measured between them.
#include "subdivision/gregory_cells.h"

#include "limit_cages.h"
#include "patch_eval.h"
#include "subdivision/limit_distance.h"
#include "subdivision/limit_evaluator.h"

#include <gtest/gtest.h>
#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTable.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/ptexIndices.h>
#include <opensubdiv/far/stencilTable.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

namespace Far = OpenSubdiv::Far;
using subdivision::Cell;

struct Made {
    explicit Made(const Cage& given)
        : cage(given),
          refiner(subdivision::makeRefiner(cage)),
          domains(subdivision::makeDomains(*refiner)),
          cells(subdivision::gregoryCells(*refiner, cage.points, domains)) {}

    Cage cage;
    std::unique_ptr<subdivision::Refiner> refiner;
    subdivision::QuadDomains domains;
    std::vector<Cell> cells;
};

reference::SurfacePoint at(const Cell& cell, double u, double v) {
    return reference::evaluate(cell.kind, std::span(cell.points).first(pointsPerPatch(cell.kind)), u, v);
}

glm::dvec2 inDomain(const Cell& cell, double u, double v) {
    return {std::ldexp(cell.u + u, -static_cast<int>(cell.levelU)), std::ldexp(cell.v + v, -static_cast<int>(cell.levelV))};
}

// OpenSubdiv's evaluation of its own patches, with all of its points as stencils of the cage's.
class FarPatches {
public:
    FarPatches(const Made& made, const subdivision::GregoryIsolation& isolation) : ptex_(*made.refiner) {
        Far::PatchTableFactory::Options options(static_cast<unsigned>(isolation.level));
        options.useInfSharpPatch = true;
        options.generateLegacySharpCornerPatches = false;
        options.SetPatchPrecision<double>();
        refiner_.reset(Far::TopologyRefinerFactory<Far::TopologyDescriptor>::Create(*made.refiner));
        auto adaptive = options.GetRefineAdaptiveOptions();
        adaptive.SetSecondaryLevel(isolation.irregularLevel);
        if (isolation.faces.empty()) adaptive.SetIsolationLevel(0);
        refiner_->RefineAdaptive(adaptive, Far::ConstIndexArray(isolation.faces.data(), static_cast<int>(isolation.faces.size())));
        table_.reset(Far::PatchTableFactory::Create(*refiner_, options));
        map_ = std::make_unique<Far::PatchMap>(*table_);
        using Stencils = Far::StencilTableFactoryReal<double>;
        Stencils::Options all;
        all.generateIntermediateLevels = true;
        all.generateControlVerts = true;
        std::unique_ptr<const Far::StencilTableReal<double>> stencils(Stencils::Create(*refiner_, all));
        const auto* local = table_->GetLocalPointStencilTable<double>();
        if (table_->GetNumLocalPoints() > 0) stencils.reset(Stencils::AppendLocalPointStencilTable(*refiner_, stencils.get(), local));
        for (int k = 0; k < stencils->GetNumStencils(); ++k) {
            const auto stencil = stencils->GetStencil(k);
            glm::dvec3 sum(0.0);
            for (int j = 0; j < stencil.GetSize(); ++j) {
                const auto vertex = static_cast<std::size_t>(stencil.GetVertexIndices()[j]);
                sum += stencil.GetWeights()[j] * glm::dvec3(made.cage.points[vertex]);
            }
            points_.push_back(sum);
        }
    }

    [[nodiscard]] glm::dvec3 at(const subdivision::QuadDomain& domain, const glm::dvec2& uv) const {
        const int face = ptex_.GetFaceId(static_cast<int>(domain.face)) + std::max(domain.subFace, 0);
        const auto* handle = map_->FindPatch(face, uv.x, uv.y);
        EXPECT_NE(handle, nullptr);
        if (handle == nullptr) return {};
        std::array<double, 20> weights{};
        table_->EvaluateBasis(*handle, uv.x, uv.y, weights.data());
        const auto vertices = table_->GetPatchVertices(*handle);
        glm::dvec3 sum(0.0);
        for (int k = 0; k < vertices.size(); ++k)
            sum += weights[static_cast<std::size_t>(k)] * points_[static_cast<std::size_t>(vertices[k])];
        return sum;
    }

private:
    Far::PtexIndices ptex_;
    std::unique_ptr<subdivision::Refiner> refiner_;
    std::unique_ptr<const Far::PatchTable> table_;
    std::unique_ptr<Far::PatchMap> map_;
    std::vector<glm::dvec3> points_;
};

constexpr std::array<double, 5> kInside{0.013, 0.27, 0.51, 0.77, 0.991};

// limitCages(), and random ones.
std::vector<NamedCage> allCages() {
    std::vector<NamedCage> cages = limitCages();
    for (std::uint32_t seed = 0; seed < 8; ++seed) cages.push_back({"random " + std::to_string(seed), randomCage(seed)});
    return cages;
}

TEST(GregoryCells, CoverEveryDomainOnce) {
    for (const auto& [name, cage] : allCages()) {
        const Made made(cage);
        std::vector<double> covered(made.domains.domains.size());
        for (const Cell& cell : made.cells) covered.at(cell.domain) += std::ldexp(1.0, -static_cast<int>(cell.levelU + cell.levelV));
        for (const double area : covered) EXPECT_EQ(area, 1.0) << name;
        std::vector<std::vector<bool>> taken(covered.size(), std::vector<bool>(64 * 64));
        for (const Cell& cell : made.cells) {
            const std::uint32_t size = 64U >> cell.levelU;
            ASSERT_GT(size, 0U);
            for (std::uint32_t k = 0; k < size * size; ++k) {
                auto spot = taken[cell.domain].begin() + (cell.v * size + k / size) * 64 + cell.u * size + k % size;
                EXPECT_FALSE(*spot) << name;
                *spot = true;
            }
        }
    }
}

TEST(GregoryCells, AreOpenSubdivsPatchesToTheLastDigits) {
    for (const auto& [name, cage] : allCages()) {
        const Made made(cage);
        const FarPatches far(made, subdivision::gregoryIsolation(*made.refiner));
        double worst = 0;
        for (const Cell& cell : made.cells)
            for (const double v : kInside)
                for (const double u : kInside)
                    worst = std::max(
                        worst, glm::distance(at(cell, u, v).position, far.at(made.domains.domains[cell.domain], inDomain(cell, u, v))));
        // OpenSubdiv 3.5 finds patch parameters in single precision at places.
        EXPECT_LT(worst, 1e-6) << name;
    }
}

TEST(GregoryCells, BicubicOnesAreTheLimitSurface) {
    std::size_t checked = 0;
    for (const auto& [name, cage] : allCages()) {
        const Made made(cage);
        subdivision::LimitEvaluator limit(*made.refiner, made.cage.points);
        double worst = 0;
        for (const Cell& cell : made.cells) {
            // Something may be sharp still where halving had to end; sub-faces are a level down.
            const auto deepest = subdivision::kDeepestGregoryLevel - (made.domains.domains[cell.domain].subFace < 0 ? 0 : 1);
            if (cell.kind != PatchKind::bezier || static_cast<int>(cell.levelU) == deepest) continue;
            ASSERT_TRUE(limit.select(made.domains.domains[cell.domain]));
            ++checked;
            for (const double v : kInside) {
                for (const double u : kInside) {
                    const glm::dvec2 uv = inDomain(cell, u, v);
                    worst = std::max(worst, glm::distance(at(cell, u, v).position, limit.position(uv.x, uv.y)));
                }
            }
        }
        EXPECT_LT(worst, 1e-10) << name;
    }
    EXPECT_GT(checked, 100U);
}

constexpr std::array<glm::dvec2, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

double sineBetween(const glm::dvec3& a, const glm::dvec3& b) { return glm::length(glm::cross(glm::normalize(a), glm::normalize(b))); }

TEST(GregoryCells, CornersLieOnTheLimitSurface) {
    for (const auto& [name, cage] : limitCages()) {
        const Made made(cage);
        subdivision::LimitEvaluator limit(*made.refiner, made.cage.points);
        double worst = 0, worstAngle = 0;
        for (const Cell& cell : made.cells) {
            ASSERT_TRUE(limit.select(made.domains.domains[cell.domain]));
            for (const glm::dvec2& corner : kCorners) {
                const glm::dvec2 uv = inDomain(cell, corner.x, corner.y);
                const auto patch = at(cell, corner.x, corner.y);
                const subdivision::LimitPoint exact = limit.evaluate(uv.x, uv.y);
                worst = std::max(worst, glm::distance(patch.position, exact.position));
                const glm::dvec3 a = glm::cross(patch.du, patch.dv), b = glm::cross(exact.du, exact.dv);
                // A single smooth face at a boundary or crease has parallel tangents there.
                if (glm::length(b) < 1e-9) continue;
                EXPECT_GT(glm::dot(a, b), 0.0) << name;
                worstAngle = std::max(worstAngle, sineBetween(a, b));
            }
        }
        // Darts and tips are approximated after some halving; elsewhere normals alone are, by up to 5 degrees.
        const bool tips = subdivision::gregoryIsolation(*made.refiner).irregularLevel > 0;
        EXPECT_LT(worst, tips ? 0.007 : 1e-14) << name;
        EXPECT_LT(worstAngle, tips ? 0.45 : 0.09) << name;
        const bool bicubic = std::all_of(made.cells.begin(), made.cells.end(), [](const Cell& c) { return c.kind == PatchKind::bezier; });
        EXPECT_LT(bicubic ? worstAngle : 0.0, 1e-14) << name;
    }
}

TEST(GregoryCells, HaveOneNormalAroundASmoothVertex) {
    std::size_t checked = 0;
    for (const auto& [name, cage] : limitCages()) {
        if (!cage.creases.empty() || !cage.corners.empty() || cage.boundary == BoundaryRule::edgeOnly) continue;
        const Made made(cage);
        std::vector<glm::dvec3> normals(made.domains.points);
        for (const Cell& cell : made.cells) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (inDomain(cell, kCorners[k].x, kCorners[k].y) != kCorners[k]) continue;
                const auto patch = at(cell, kCorners[k].x, kCorners[k].y);
                const glm::dvec3 normal = glm::normalize(glm::cross(patch.du, patch.dv));
                glm::dvec3& known = normals[made.domains.domains[cell.domain].corners[k]];
                if (known == glm::dvec3(0.0)) known = normal;
                EXPECT_LT(glm::distance(known, normal), 1e-12) << name;
                ++checked;
            }
        }
    }
    EXPECT_GT(checked, 1000U);
}

TEST(GregoryCells, AreOneADomainWithoutNeedForMore) {
    for (const auto& [name, cage] : limitCages()) {
        const Made made(cage);
        if (subdivision::gregoryIsolation(*made.refiner).level > 0) continue;
        EXPECT_EQ(made.cells.size(), made.domains.domains.size()) << name;
    }
    // The quads beside faces of five corners are halved, the rest is not.
    EXPECT_EQ(Made(prismCage(5)).cells.size(), 10U + 5U * 4U);
    const Made torus(torusCage(6, 5));
    for (const Cell& cell : torus.cells) EXPECT_EQ(cell.kind, PatchKind::bezier);
}

TEST(GregoryCells, LevelsAreThoseOfTheSharpestEdge) {
    const auto level = [](const Cage& cage) { return subdivision::gregoryIsolation(*subdivision::makeRefiner(cage)).level; };
    Cage cage = cubeCage();
    EXPECT_EQ(level(cage), 0);
    EXPECT_EQ(level(prismCage(5)), 1);
    cage.creases = {{4, 5}, {5, 7}, {7, 6}, {6, 4}};
    EXPECT_EQ(level(cage), 0);
    // A dart, then a tip.
    cage.creases = {{4, 5}};
    EXPECT_EQ(level(cage), 3);
    EXPECT_EQ(subdivision::gregoryIsolation(*subdivision::makeRefiner(cage)).faces.size(), 4U);
    cage.creases.clear();
    cage.corners = {{0}};
    EXPECT_EQ(level(cage), 3);
    cage.corners.clear();
    cage.creases = {{4, 5, 2.3F}};
    EXPECT_EQ(level(cage), 3);
    cage.corners = {{0, 3.5F}};
    EXPECT_EQ(level(cage), 4);
    cage.creases = {{4, 5, 9.5F}};
    EXPECT_EQ(level(cage), subdivision::kDeepestGregoryLevel);
}

TEST(GregoryCells, BilinearFacesStayFlat) {
    Cage cage = prismCage(5);
    cage.scheme = SubdivisionScheme::bilinear;
    const Made made(cage);
    subdivision::LimitEvaluator limit(*made.refiner, made.cage.points);
    ASSERT_EQ(made.cells.size(), made.domains.domains.size());
    for (const Cell& cell : made.cells) {
        ASSERT_TRUE(limit.select(made.domains.domains[cell.domain]));
        for (const double u : kInside) EXPECT_LT(glm::distance(at(cell, u, 0.3).position, limit.position(u, 0.3)), 1e-6);
    }
}

TEST(LimitDistance, IsNothingForExactCells) {
    for (const Cage& cage : {torusCage(6, 5), gridCage(4, 3)}) {
        const Made made(cage);
        const auto found = subdivision::limitDistance(*made.refiner, made.cage.points, made.domains, made.cells, 5);
        EXPECT_LT(found.greatest, 1e-12);
        EXPECT_EQ(found.cellsMeasured, made.cells.size());
    }
}

TEST(LimitDistance, IsWhatCellsWereMovedBy) {
    Made made(gridCage(4, 3));
    for (Cell& cell : made.cells)
        for (glm::dvec3& p : cell.points) p.z += 0.01;
    EXPECT_NEAR(subdivision::limitDistance(*made.refiner, made.cage.points, made.domains, made.cells, 4).greatest, 0.01, 1e-12);
    made.cells[5].points[5].z += 0.9;
    const auto found = subdivision::limitDistance(*made.refiner, made.cage.points, made.domains, made.cells, 4);
    EXPECT_NEAR(found.greatest, 0.01 + 0.9 * 16.0 / 81.0, 1e-12);
    EXPECT_EQ(found.cell, 5U);
    EXPECT_NEAR(found.u, 1.0 / 3.0, 1e-15);
    EXPECT_NEAR(found.v, 1.0 / 3.0, 1e-15);
}

TEST(LimitDistance, CountsNoSliding) {
    // Inner points of a flat patch that move within its plane.
    Made flat(gridCage(3, 3));
    Cell& middle = flat.cells.at(4);
    for (const std::size_t k : {5U, 6U, 9U, 10U}) middle.points[k] += glm::dvec3(0.15, -0.1, 0.0);
    EXPECT_LT(subdivision::limitDistance(*flat.refiner, flat.cage.points, flat.domains, flat.cells, 6).greatest, 1e-9);
}

TEST(LimitDistance, OfGregoryPatchesIsAboveNothingAndFarBelowTheFaces) {
    for (const auto& [name, cage] : limitCages()) {
        const Made made(cage);
        const auto found = subdivision::limitDistance(*made.refiner, made.cage.points, made.domains, made.cells, 7);
        const bool gregory = std::any_of(made.cells.begin(), made.cells.end(), [](const Cell& c) { return c.kind == PatchKind::gregory; });
        EXPECT_EQ(found.greatest > 1e-9, gregory) << name << ": " << found.greatest;
        EXPECT_LT(found.greatest, 0.026) << name;
        EXPECT_LT(found.evaluations, 250000U) << name;
    }
}

}  // namespace
}  // namespace tessera::test
