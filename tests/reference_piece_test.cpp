// Tests of the boxes of pieces of the reference surfaces, on which the ray caster's search rests.
#include "patch_piece.h"
#include "patch_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace tessera::reference {
namespace {

// A Gregory patch of nothing but one blend, where the pads are closest to what they hold.
std::vector<glm::dvec3> loneBlend() {
    std::vector<glm::dvec3> points(20, glm::dvec3(0.0));
    points[12] = {0.5, -0.5, 0.25};
    points[16] = -points[12];
    return points;
}

// A piece reached by halving: at random, or always towards the corner at (0, 0), where blends bend most.
Piece somePiece(const PatchShape& shape, Random& random, int cuts, bool towardsCorner) {
    Piece piece = wholePiece(shape);
    for (int i = 0; i < cuts; ++i) {
        const auto [first, second] = halves(piece, i % 2 == 0);
        piece = towardsCorner || random.unit() < 0.5 ? first : second;
    }
    return piece;
}

void expectWithin(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& pad, const char* what) {
    const glm::dvec3 excess = glm::abs(a - b) - pad;
    EXPECT_LE(std::max({excess.x, excess.y, excess.z}), 1e-13) << what;
}

// The denominator of a rational patch and its derivatives, as x coordinates; 1 of any other.
SurfacePoint weightOf(const Sample& sample, const glm::dvec2& at) {
    if (sample.weights.empty()) return {glm::dvec3(1, 0, 0), {}, {}};
    std::vector<glm::dvec3> weights;
    for (const double weight : sample.weights) weights.emplace_back(weight, 0, 0);
    return evaluate(PatchKind::bezier, weights, at.x, at.y);
}

// The product with a weight, by the product rule.
SurfacePoint times(const SurfacePoint& s, const SurfacePoint& weight) {
    const double w = weight.position.x;
    return {w * s.position, w * s.du + weight.du.x * s.position, w * s.dv + weight.dv.x * s.position};
}

// The surface, of rational patches times its weight, stays within the pads of the patch over the enclosure's net, and so of that net's
// hull.
TEST(ReferencePiece, EnclosesTheSurfaceAndItsDerivatives) {
    Random random(99);
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const Sample sample = seed % 8 == 1 ? Sample{PatchKind::gregory, loneBlend()} : someSample(seed);
        const PatchShape shape = makeShape(sample.kind, sample.points, sample.weights);
        const Piece piece = somePiece(shape, random, static_cast<int>(seed % 12), seed % 3 == 0);
        const Enclosure enclosure = enclose(shape, piece);
        const Box box = boxOf(enclosure);
        const glm::dvec2 width = piece.rectangle.width();
        for (int k = 0; k < 100; ++k) {
            const bool corner = k < 20;
            const glm::dvec2 local(corner ? k % 2 : random.unit(), corner ? k / 2 % 2 : random.unit());
            const glm::dvec2 at = piece.rectangle.lower + width * local;
            const SurfacePoint n = evaluate(PatchKind::bezier, enclosure.net, local.x, local.y);
            const SurfacePoint s = times(sample.at(at.x, at.y), weightOf(sample, at));
            expectWithin(sample.at(at.x, at.y).position, 0.5 * (box.lower + box.upper), 0.5 * (box.upper - box.lower), "box");
            expectWithin(s.position, n.position, enclosure.pad, "position");
            expectWithin(width.x * s.du, n.du, enclosure.slopePadU, "du");
            expectWithin(width.y * s.dv, n.dv, enclosure.slopePadV, "dv");
        }
    }
}

// Without this the search would not end: the box must shrink onto the surface faster than the piece.
TEST(ReferencePiece, PaddingFallsWithTheSquareOfTheWidth) {
    const PatchShape shape = makeShape(PatchKind::gregory, blendedSample(2).points);
    Piece piece = wholePiece(shape);
    double before = glm::length(enclose(shape, piece).pad);
    for (int i = 0; i < 6; ++i) {
        piece = halves(halves(piece, true).first, false).first;
        const double now = glm::length(enclose(shape, piece).pad);
        EXPECT_NEAR(now, before / 4, 1e-12);
        before = now;
    }
}

}  // namespace
}  // namespace tessera::reference
