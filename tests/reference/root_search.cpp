// Subdivision until a piece provably holds at most one root, then Newton's method on the patch itself. The ray is where x = y = 0, and
// so where x and y times a weight above 0 are: of rational patches both steps look at these, which are polynomials.
#include "root_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace tessera::reference {

namespace {

constexpr int mostPieces = 1000000;

// Below this share of its middle value the map's derivative varies so little that Newton's steps, kept inside the
// piece, shrink the error by 2q / (1 - q) = 2/3 or better from any start: there is one root at most and it is found.
constexpr double certainVariation = 0.25;

glm::dvec2 flat(const glm::dvec3& p) { return {p.x, p.y}; }

// The map (s, t) -> (x, y) of a piece over its own parameters, straightened by the inverse of its mean derivative.
struct Straightened {
    bool regular = false;
    bool mayHoldRoot = true;
    double variation = 0.0;  // of the straightened derivative, from the identity, in the maximum norm
};

glm::dmat2 meanDerivative(const Net& net) {
    glm::dmat2 sum(0.0);
    for (std::size_t k = 0; k < 4; ++k) {
        sum[0] += flat(net[4 * k + 3] - net[4 * k]);
        sum[1] += flat(net[12 + k] - net[k]);
    }
    return 0.25 * sum;
}

glm::dmat2 absolute(const glm::dmat2& m) { return {glm::abs(m[0]), glm::abs(m[1])}; }

// How far 3 x the net's differences along one parameter, straightened, are from the unit vector `unit`.
glm::dvec2 variationAlong(const Net& net, const glm::dmat2& inverse, std::size_t stride, const glm::dvec2& unit) {
    glm::dvec2 greatest(0.0);
    const std::size_t across = 5 - stride;  // the other one of 1 and 4
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t at = row * across + i * stride;
            greatest = glm::max(greatest, glm::abs(inverse * (3.0 * flat(net[at + stride] - net[at])) - unit));
        }
    }
    return greatest;
}

Straightened straighten(const Enclosure& e, double tolerance) {
    Straightened result;
    const glm::dmat2 mean = meanDerivative(e.net);
    const double determinant = glm::determinant(mean);
    // Nearly parallel derivatives straighten nothing: the inverse would be rounding.
    if (!(std::abs(determinant) > 1e-9 * glm::length(mean[0]) * glm::length(mean[1]))) return result;
    result.regular = true;
    const glm::dmat2 inverse = glm::inverse(mean);
    const glm::dmat2 size = absolute(inverse);
    const glm::dvec2 pad = size * (flat(e.pad) + tolerance);
    glm::dvec2 lower = inverse * flat(e.net[0]);
    glm::dvec2 upper = lower;
    for (const glm::dvec3& point : e.net) {
        const glm::dvec2 p = inverse * flat(point);
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    result.mayHoldRoot = lower.x - pad.x <= 0.0 && lower.y - pad.y <= 0.0 && upper.x + pad.x >= 0.0 && upper.y + pad.y >= 0.0;
    if (!result.mayHoldRoot) return result;
    const glm::dvec2 variation =
        variationAlong(e.net, inverse, 1, {1, 0}) + variationAlong(e.net, inverse, 4, {0, 1}) + size * flat(e.slopePadU + e.slopePadV);
    result.variation = std::max(variation.x, variation.y);
    return result;
}

// The greatest distance between neighbours of the net along one parameter.
double longestStep(const Net& net, std::size_t stride) {
    double longest = 0.0;
    const std::size_t across = 5 - stride;
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t at = row * across + i * stride;
            longest = std::max(longest, glm::length(net[at + stride] - net[at]));
        }
    }
    return longest;
}

class Search {
public:
    Search(const PatchShape& shape, const SearchLimits& limits) : shape_(shape), limits_(limits), whole_(wholePiece(shape).net) {}

    void visit(const Piece& piece) {
        if (outside(piece.rectangle)) return;
        if (++visited_ > mostPieces) throw std::runtime_error("reference ray caster: the search on a patch does not end");
        const Enclosure enclosure = enclose(shape_, piece);
        const Box box = boxOf(enclosure);
        const double slack = limits_.tolerance;
        if (box.lower.x > slack || box.upper.x < -slack || box.lower.y > slack || box.upper.y < -slack) return;
        if (box.upper.z <= limits_.nearest || box.lower.z >= nearest()) return;
        const Straightened map = straighten(enclosure, slack * greatestWeight(enclosure));
        if (!map.mayHoldRoot) return;
        if (map.regular && map.variation <= certainVariation) return keep(polish(piece.rectangle));
        if (tiny(box, piece.rectangle)) return keep(rootAt(piece.rectangle.middle()));
        visitHalves(piece, enclosure.net);
    }

    [[nodiscard]] const std::optional<Root>& result() const { return best_; }

private:
    [[nodiscard]] double nearest() const { return best_ ? best_->distance : limits_.farthest; }

    // Whether a piece has no inner point of the patch.
    [[nodiscard]] bool outside(const Rectangle& rectangle) const {
        return shape_.kind == PatchKind::pn && rectangle.lower.x + rectangle.lower.y >= 1.0;
    }

    // A piece that a single point stands for. The second case ends the search on patches without any width.
    [[nodiscard]] bool tiny(const Box& box, const Rectangle& rectangle) const {
        const glm::dvec3 size = box.upper - box.lower;
        const glm::dvec2 width = rectangle.width();
        const double small = 0.1 * limits_.tolerance;
        return std::max({size.x, size.y, size.z}) <= small || std::max(width.x, width.y) < 1e-14;
    }

    void visitHalves(const Piece& piece, const Net& net) {
        const auto [first, second] = halves(piece, longestStep(net, 1) >= longestStep(net, 4));
        const bool firstIsNearer = boxOf(enclose(shape_, first)).lower.z <= boxOf(enclose(shape_, second)).lower.z;
        visit(firstIsNearer ? first : second);
        visit(firstIsNearer ? second : first);
    }

    // A root of a triangle's polynomial beyond its third border is none, unless the border's nearest point is as good: what lies on
    // a border must not be missed from both sides. keep() asks for that.
    [[nodiscard]] Root rootAt(glm::dvec2 at) const {
        if (shape_.kind == PatchKind::pn) at -= 0.5 * std::max(0.0, at.x + at.y - 1.0);
        const glm::dvec3 position = evaluate(shape_.kind, shape_.points, at.x, at.y, shape_.weights).position;
        return {position.z, at, glm::length(flat(position))};
    }

    [[nodiscard]] SurfacePoint polynomial(const glm::dvec2& at) const {
        if (shape_.kind == PatchKind::gregory) return evaluate(PatchKind::gregory, shape_.points, at.x, at.y);
        return evaluate(PatchKind::bezier, whole_, at.x, at.y);
    }

    // Newton's method from the middle, kept inside the rectangle.
    [[nodiscard]] Root polish(const Rectangle& rectangle) const {
        glm::dvec2 at = rectangle.middle();
        for (int step = 0; step < 100; ++step) {
            const SurfacePoint s = polynomial(at);
            const glm::dmat2 derivative(flat(s.du), flat(s.dv));
            if (glm::determinant(derivative) == 0.0) break;
            const glm::dvec2 next = glm::clamp(at - glm::inverse(derivative) * flat(s.position), rectangle.lower, rectangle.upper);
            const glm::dvec2 moved = glm::abs(next - at);
            at = next;
            if (std::max(moved.x, moved.y) < 1e-15) break;
        }
        return rootAt(at);
    }

    void keep(const Root& root) {
        if (root.residual <= limits_.tolerance && root.distance > limits_.nearest && root.distance < nearest()) best_ = root;
    }

    const PatchShape& shape_;
    const SearchLimits& limits_;
    Net whole_;
    std::optional<Root> best_;
    int visited_ = 0;
};

}  // namespace

RayFrame rayFrame(const glm::dvec3& origin, const glm::dvec3& direction) {
    const glm::dvec3 other = std::abs(direction.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 a = glm::normalize(glm::cross(direction, other));
    const glm::dvec3 b = glm::cross(direction, a);
    return {glm::transpose(glm::dmat3(a, b, direction)), origin};
}

std::optional<Root> nearestRoot(const PatchShape& shape, const Piece& piece, const SearchLimits& limits) {
    Search search(shape, limits);
    search.visit(piece);
    return search.result();
}

}  // namespace tessera::reference
