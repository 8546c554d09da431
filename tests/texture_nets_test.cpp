// Texture nets of cells against OpenSubdiv's face-varying limit, across seams and where the channel goes on.
#include "subdivision/texture_cells.h"

#include "limit_cages.h"
#include "patch_eval.h"
#include "subdivision/gregory_cells.h"
#include "tessera/texture.h"

#include <gtest/gtest.h>
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace tessera::test {
namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
using subdivision::Cell;
using subdivision::QuadDomain;

constexpr double kNever = std::numeric_limits<double>::infinity();

struct Made {
    explicit Made(const Cage& given) : cage(given), refiner(subdivision::makeRefiner(cage)), domains(subdivision::makeDomains(*refiner)) {}

    // A grid of 2^level squared bicubic cells a domain, whose points tell their parameters.
    [[nodiscard]] std::vector<Cell> grid(std::uint32_t level) const {
        std::vector<Cell> cells;
        const std::uint32_t side = 1U << level;
        for (std::uint32_t domain = 0; domain < domains.domains.size(); ++domain) {
            for (std::uint32_t k = 0; k < side * side; ++k) {
                Cell& cell = cells.emplace_back();
                cell.domain = domain;
                cell.levelU = cell.levelV = level;
                cell.u = k % side;
                cell.v = k / side;
                for (std::size_t p = 0; p < 16; ++p)
                    cell.points[p] = {(cell.u + static_cast<double>(p % 4) / 3) / side, (cell.v + static_cast<double>(p / 4) / 3) / side,
                                      0};
            }
        }
        return cells;
    }

    [[nodiscard]] std::vector<Cell> textured(std::vector<Cell> cells, double tolerance) const {
        subdivision::addTexture(*refiner, cage.texturePoints, domains, cells, tolerance);
        return cells;
    }

    Cage cage;
    std::unique_ptr<subdivision::Refiner> refiner;
    subdivision::QuadDomains domains;
};

glm::dvec2 textureOf(const Cell& cell, double u, double v) {
    Mesh mesh;
    for (const glm::dvec2& value : cell.texture) mesh.textureNets.emplace_back(value);
    return textureAt(mesh, 0, static_cast<float>(u), static_cast<float>(v));
}

glm::dvec2 inDomain(const Cell& cell, double u, double v) {
    return {std::ldexp(cell.u + u, -static_cast<int>(cell.levelU)), std::ldexp(cell.v + v, -static_cast<int>(cell.levelV))};
}

// The value at a place of a domain, of the cell that has it.
glm::dvec2 valueAt(const std::vector<Cell>& cells, std::uint32_t domain, const glm::dvec2& at) {
    for (const Cell& cell : cells) {
        if (cell.domain != domain) continue;
        const glm::dvec2 low = inDomain(cell, 0, 0), high = inDomain(cell, 1, 1);
        if (at.x < low.x || at.x > high.x || at.y < low.y || at.y > high.y) continue;
        return textureOf(cell, (at.x - low.x) / (high.x - low.x), (at.y - low.y) / (high.y - low.y));
    }
    ADD_FAILURE() << "no cell";
    return {};
}

// OpenSubdiv's own evaluation, asked for without this house's help.
class Oracle {
public:
    explicit Oracle(const Made& made) : made_(made), factory_(*made.refiner, options()) {}

    [[nodiscard]] glm::dvec2 at(const QuadDomain& domain, const glm::dvec2& uv) const {
        Bfr::Surface<double> surface;
        EXPECT_TRUE(factory_.InitFaceVaryingSurface(static_cast<int>(domain.face), &surface, 0));
        std::vector<double> values, points(static_cast<std::size_t>(surface.GetNumPatchPoints()) * 2);
        for (const glm::vec2& value : made_.cage.texturePoints) values.insert(values.end(), {double{value.x}, double{value.y}});
        surface.PreparePatchPoints(values.data(), 2, points.data(), 2);
        std::array<double, 2> place{uv.x, uv.y}, found{};
        // Faces of other than four corners: sub-faces lie in squares of one, halves of which are used.
        if (domain.subFace >= 0) surface.GetParameterization().ConvertNormalizedSubFaceToCoord(domain.subFace, &uv.x, place.data());
        surface.Evaluate(place.data(), points.data(), 2, found.data());
        return {found[0], found[1]};
    }

private:
    static Bfr::SurfaceFactory::Options options() {
        return Bfr::SurfaceFactory::Options().SetApproxLevelSmooth(10).SetApproxLevelSharp(10);
    }

    const Made& made_;
    Bfr::RefinerSurfaceFactory<> factory_;
};

double worstError(const Made& made, const std::vector<Cell>& cells) {
    const Oracle oracle(made);
    double worst = 0;
    for (const Cell& cell : cells)
        for (const double v : {0.0, 0.4, 0.85})
            for (const double u : {0.12, 0.5, 1.0})
                worst = std::max(worst,
                                 glm::distance(textureOf(cell, u, v), oracle.at(made.domains.domains[cell.domain], inDomain(cell, u, v))));
    return worst;
}

// Texture coordinates that go on everywhere: a vertex has one.
Cage withVertexTextures(Cage cage) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> noise(-0.2F, 0.2F);
    for (const glm::vec3& p : cage.points) cage.texturePoints.emplace_back(p.x + noise(random), p.y + 0.5F * p.z + noise(random));
    cage.faceTexturePoints = cage.faceVertices;
    return cage;
}

// A grid of regular vertices with a seam that turns a corner: its texture points are irregular there.
Cage gridWithSeam() {
    Cage cage = withVertexTextures(gridCage(4, 4));
    const std::uint32_t vertices = 25;
    for (std::size_t k = 0; k < vertices; ++k) cage.texturePoints.push_back(cage.texturePoints[k] + glm::vec2(10.0F, 0.0F));
    for (std::size_t face = 0; face < 16; ++face) {
        if (face % 4 < 2 || face / 4 < 2) continue;
        for (std::size_t k = 0; k < 4; ++k) cage.faceTexturePoints[4 * face + k] += vertices;
    }
    return cage;
}

TEST(TextureNets, AreTheLimitWhereItIsBicubic) {
    for (const Cage& plain : {torusCage(6, 5), gridCage(4, 3)}) {
        const Made made(withVertexTextures(plain));
        for (const std::uint32_t level : {0U, 1U, 3U}) {
            const std::vector<Cell> cells = made.textured(made.grid(level), 1e-5);
            EXPECT_EQ(cells.size(), made.grid(level).size());
            EXPECT_LT(worstError(made, cells), 1e-6);
        }
    }
}

TEST(TextureNets, AreWithin1em5OfTheLimitEverywhere) {
    for (const Cage& cage : {unfoldedCube(), gridWithSeam(), withVertexTextures(prismCage(5)), withVertexTextures(fanCage(7))}) {
        const Made made(cage);
        glm::vec2 lower = cage.texturePoints[0], upper = lower;
        for (const glm::vec2& p : cage.texturePoints) {
            lower = glm::min(lower, p);
            upper = glm::max(upper, p);
        }
        const std::vector<Cell> cells = made.textured(made.grid(0), 1e-5);
        EXPECT_GT(cells.size(), made.domains.domains.size());
        std::vector<Cell> larger;
        std::copy_if(cells.begin(), cells.end(), std::back_inserter(larger), [](const Cell& c) { return c.levelU < 10; });
        const auto size = static_cast<double>(glm::length(upper - lower));
        EXPECT_LT(worstError(made, larger), 1.1e-5 * size) << cage.name;
        EXPECT_LT(worstError(made, cells), 1e-4 * size) << cage.name;
    }
}

// OpenSubdiv's masks for face-varying limits, after one refinement: at corners, edges' middles and faces' middles.
TEST(TextureNets, HaveTheLimitAtCornersAndMiddles) {
    struct Value {
        glm::dvec2 v{0.0};
        void Clear() { v = glm::dvec2(0.0); }
        void AddWithWeight(const Value& other, double weight) { v += weight * other.v; }
    };
    const Made made(unfoldedCube());
    std::unique_ptr<subdivision::Refiner> refined(Far::TopologyRefinerFactory<Far::TopologyDescriptor>::Create(*made.refiner));
    Far::TopologyRefiner::UniformOptions options(1);
    options.fullTopologyInLastLevel = true;
    refined->RefineUniform(options);
    std::vector<Value> base(made.cage.texturePoints.size());
    for (std::size_t k = 0; k < base.size(); ++k) base[k].v = glm::dvec2(made.cage.texturePoints[k]);
    std::vector<Value> finer(static_cast<std::size_t>(refined->GetLevel(1).GetNumFVarValues(0))), limit(finer.size());
    const Far::PrimvarRefinerReal<double> refine(*refined);
    refine.InterpolateFaceVarying(1, base, finer);
    refine.LimitFaceVarying(finer, limit);
    const std::vector<Cell> cells = made.textured(made.grid(2), kNever);
    constexpr std::array<glm::dvec2, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (std::uint32_t domain = 0; domain < made.domains.domains.size(); ++domain) {
        const auto children = refined->GetLevel(0).GetFaceChildFaces(static_cast<int>(made.domains.domains[domain].face));
        for (int k = 0; k < 4; ++k) {
            const auto values = refined->GetLevel(1).GetFaceFVarValues(children[k], 0);
            for (int c = 0; c < 4; ++c) {
                const glm::dvec2 at = 0.5 * (corners[static_cast<std::size_t>(k)] + corners[static_cast<std::size_t>(c)]);
                EXPECT_LT(glm::distance(valueAt(cells, domain, at), limit[static_cast<std::size_t>(values[c])].v), 1e-6)
                    << domain << k << c;
            }
        }
    }
}

TEST(TextureNets, GoOnAcrossEdgesWithoutASeamAndJumpAtSeams) {
    const Made made(unfoldedCube());
    const std::vector<Cell> even = made.textured(made.grid(1), kNever), cut = made.textured(made.grid(0), 1e-5);
    struct Side {
        std::uint32_t domain;
        std::size_t side;
        bool reversed;
        std::pair<std::uint32_t, std::uint32_t> textures;  // of the line's ends
    };
    std::map<std::uint32_t, std::vector<Side>> sides;
    for (std::uint32_t d = 0; d < made.domains.domains.size(); ++d) {
        const QuadDomain& domain = made.domains.domains[d];
        constexpr std::array<std::pair<std::size_t, std::size_t>, 4> ends{{{0, 1}, {1, 2}, {3, 2}, {0, 3}}};
        for (std::size_t k = 0; k < 4; ++k) {
            const auto [a, b] = ends[k];
            std::pair<std::uint32_t, std::uint32_t> textures{made.cage.faceTexturePoints[4 * domain.face + a],
                                                             made.cage.faceTexturePoints[4 * domain.face + b]};
            if (domain.sides[k].reversed) std::swap(textures.first, textures.second);
            sides[domain.sides[k].line].push_back({d, k, domain.sides[k].reversed, textures});
        }
    }
    const auto along = [](const std::vector<Cell>& cells, const Side& side, double t) {
        const double s = side.reversed ? 1 - t : t;
        const std::array<glm::dvec2, 4> place{{{s, 0}, {1, s}, {s, 1}, {0, s}}};
        return valueAt(cells, side.domain, place[side.side]);
    };
    std::size_t seams = 0;
    for (const auto& [line, both] : sides) {
        ASSERT_EQ(both.size(), 2U);
        const bool seam = both[0].textures != both[1].textures;
        seams += seam ? 1 : 0;
        // Cells of different sizes have nets of their own.
        for (const auto& [cells, allowed] : {std::pair(&even, 1e-6), std::pair(&cut, 2.2e-5)}) {
            double apart = 0;
            for (const double t : {0.0, 0.01, 0.3, 0.62, 0.999, 1.0})
                apart = std::max(apart, glm::distance(along(*cells, both[0], t), along(*cells, both[1], t)));
            EXPECT_TRUE(seam ? apart > 0.1 : apart < allowed) << line << ": " << apart;
        }
    }
    EXPECT_EQ(sides.size(), 12U);
    EXPECT_EQ(seams, 7U);
}

TEST(TextureNets, CutsLeaveTheSurfaceAsItIs) {
    const Made made(gridWithSeam());
    EXPECT_EQ(made.textured(made.grid(0), kNever).size(), 16U);
    const std::vector<Cell> cells = made.textured(made.grid(0), 1e-5);
    EXPECT_GT(cells.size(), 16U);
    EXPECT_LT(cells.size(), 400U);
    for (const Cell& cell : cells) {
        for (const double t : {0.1, 0.77}) {
            const auto at = reference::evaluate(PatchKind::bezier, std::span(cell.points).first(16), t, 1 - t);
            EXPECT_LT(glm::distance(glm::dvec2(at.position), inDomain(cell, t, 1 - t)), 1e-14);
        }
    }
}

TEST(TextureNets, OfASingleValueAreNotCut) {
    for (const glm::vec2& value : {glm::vec2(0.3F, 0.7F), glm::vec2(-1000.1F, 0.0F)}) {
        Cage cage = cubeCage();
        cage.texturePoints.assign(1, value);
        cage.faceTexturePoints.assign(cage.faceVertices.size(), 0);
        const Made made(cage);
        const std::vector<Cell> cells = made.grid(0);
        EXPECT_EQ(made.textured(cells, 1e-5).size(), cells.size());
    }
}

TEST(TextureNets, GregoryCellsAreNotCut) {
    const Made made(unfoldedCube());
    std::vector<Cell> cells = subdivision::gregoryCells(*made.refiner, made.cage.points, made.domains);
    ASSERT_EQ(cells.size(), 6U);
    cells = made.textured(cells, 1e-5);
    EXPECT_EQ(cells.size(), 6U);
    EXPECT_LT(worstError(made, cells), 0.01);
}

TEST(TextureAt, IsThePatchsOwnWithoutNets) {
    EXPECT_EQ(textureAt(Mesh{}, 3, 0.25F, 0.75F), glm::vec2(0.25F, 0.75F));
    Mesh mesh;
    for (std::size_t k = 0; k < 32; ++k) mesh.textureNets.emplace_back(0.1F * static_cast<float>(k * k % 17), 3.0F - static_cast<float>(k));
    EXPECT_EQ(textureAt(mesh, 1, 0.0F, 0.0F), mesh.textureNets[16]);
    EXPECT_EQ(textureAt(mesh, 1, 1.0F, 0.0F), mesh.textureNets[19]);
    EXPECT_EQ(textureAt(mesh, 1, 0.0F, 1.0F), mesh.textureNets[28]);
    EXPECT_EQ(textureAt(mesh, 1, 1.0F, 1.0F), mesh.textureNets[31]);
}

}  // namespace
}  // namespace tessera::test
