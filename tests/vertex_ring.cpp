// The quadrilaterals around one vertex, subdivided until there is nothing left of them.
#include "vertex_ring.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tessera::test {

namespace {

constexpr float kForEver = 10.0F;
constexpr int kMostSteps = 120;   // a ring shrinks to less than 3/4 with each
constexpr int kNormalSteps = 60;  // where neighbours in the spectrum stand as 1 to 2 their rest is 1e-18 then

enum class Rule { smooth, crease, corner };

Rule ruleOf(float sharpness, const std::vector<float>& edges) {
    const auto sharp = std::count_if(edges.begin(), edges.end(), [](float s) { return s > 0.0F; });
    if (sharpness > 0.0F || sharp > 2) return Rule::corner;
    return sharp == 2 ? Rule::crease : Rule::smooth;
}

glm::dvec3 byRule(Rule rule, const VertexRule& at, const std::vector<float>& edgeSharpness) {
    if (rule == Rule::corner) return at.vertex;
    glm::dvec3 sum(0.0);
    if (rule == Rule::crease) {
        for (std::size_t k = 0; k < at.edges.size(); ++k)
            if (edgeSharpness[k] > 0.0F) sum += at.edges[k];
        return 0.75 * at.vertex + 0.125 * sum;
    }
    const auto n = static_cast<double>(at.edges.size());
    for (const glm::dvec3& edge : at.edges) sum += edge;
    for (const glm::dvec3& face : at.facePoints) sum += face;
    return (n - 2.0) / n * at.vertex + sum / (n * n);
}

bool lasting(float sharpness) { return sharpness <= 0.0F || sharpness >= kForEver; }

double width(const VertexRing& ring) {
    double size = 0.0;
    for (const glm::dvec3& edge : ring.edges) size = std::max(size, glm::distance(edge, ring.vertex));
    for (const glm::dvec3& corner : ring.across) size = std::max(size, glm::distance(corner, ring.vertex));
    return size;
}

// The ring around its own vertex and of size 1.
VertexRing centred(VertexRing ring) {
    const double size = width(ring);
    const double scale = size > 0.0 ? 1.0 / size : 1.0;
    for (glm::dvec3& edge : ring.edges) edge = scale * (edge - ring.vertex);
    for (glm::dvec3& corner : ring.across) corner = scale * (corner - ring.vertex);
    ring.vertex = glm::dvec3(0.0);
    return ring;
}

void setNormal(LimitPoint& point, const glm::dvec3& one, const glm::dvec3& other) {
    const glm::dvec3 normal = glm::cross(one, other);
    const double length = glm::length(normal);
    // Directions from a few sums of numbers up to 1: below this they are rounding, or as good as parallel.
    if (length <= 1e-7 * glm::length(one) * glm::length(other) || glm::length(other) < 1e-9) return;
    point.normal = normal / length;
    point.hasNormal = true;
}

// Smooth all around: the ring's first harmonic, which outlives all others.
void smoothNormal(LimitPoint& point, const VertexRing& ring) {
    const auto n = static_cast<double>(ring.edges.size());
    if (!ring.closed() || ring.edges.size() < 3) return;
    glm::dvec3 cosines(0.0), sines(0.0);
    for (std::size_t k = 0; k < ring.edges.size(); ++k) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / n;
        cosines += std::cos(angle) * ring.edges[k];
        sines += std::sin(angle) * ring.edges[k];
    }
    setNormal(point, cosines, sines);
}

// Edges from one sharp edge to the next around `quad`, counter-clockwise.
std::vector<glm::dvec3> sectorAround(const VertexRing& ring, std::size_t quad) {
    const std::size_t n = ring.edges.size();
    std::size_t first = quad;
    while (ring.edgeSharpness[first] <= 0.0F) first = (first + n - 1) % n;
    std::vector<glm::dvec3> sector{ring.edges[first]};
    do {
        first = (first + 1) % n;
        sector.push_back(ring.edges[first]);
    } while (ring.edgeSharpness[first] <= 0.0F);
    return sector;
}

// Beside creases and sharp edges: the direction along them and the sector's first sine, which outlives others.
void sectorNormal(LimitPoint& point, const VertexRing& ring, std::size_t quad, Rule rule) {
    const std::vector<glm::dvec3> sector = sectorAround(ring, quad);
    const std::size_t quads = sector.size() - 1;
    if (rule == Rule::corner) {
        // The tangents of a single quadrilateral are its edges. Of more it depends on where one comes from.
        if (quads == 1) setNormal(point, sector.front() - ring.vertex, sector.back() - ring.vertex);
        return;
    }
    if (quads == 1) return;
    glm::dvec3 inwards(0.0);
    for (std::size_t k = 1; k < quads; ++k)
        inwards += std::sin(std::numbers::pi * static_cast<double>(k) / static_cast<double>(quads)) * (sector[k] - ring.vertex);
    setNormal(point, sector.front() - sector.back(), inwards);
}

}  // namespace

float lessSharp(float sharpness) {
    if (sharpness >= kForEver) return sharpness;
    return sharpness > 1.0F ? sharpness - 1.0F : 0.0F;
}

double creaseShare(float sharpness) { return std::clamp(static_cast<double>(sharpness), 0.0, 1.0); }

glm::dvec3 VertexRule::next() const {
    std::vector<float> after;
    for (const float s : edgeSharpness) after.push_back(lessSharp(s));
    const Rule rule = ruleOf(sharpness, edgeSharpness), ruleAfter = ruleOf(lessSharp(sharpness), after);
    const glm::dvec3 moved = byRule(rule, *this, edgeSharpness);
    if (rule == ruleAfter) return moved;
    double sum = 0.0, count = 0.0;
    const auto vanish = [&](float before, float later) {
        if (before <= 0.0F || later > 0.0F) return;
        sum += static_cast<double>(before);
        count += 1.0;
    };
    vanish(sharpness, lessSharp(sharpness));
    for (std::size_t k = 0; k < after.size(); ++k) vanish(edgeSharpness[k], after[k]);
    const double share = std::min(sum / count, 1.0);
    return share * moved + (1.0 - share) * byRule(ruleAfter, *this, after);
}

VertexRing VertexRing::next() const {
    const std::size_t n = edges.size();
    VertexRing ring;
    for (std::size_t k = 0; k < across.size(); ++k) ring.across.push_back(0.25 * (vertex + edges[k] + across[k] + edges[(k + 1) % n]));
    for (std::size_t k = 0; k < n; ++k) {
        const glm::dvec3 middle = 0.5 * (vertex + edges[k]);
        const double share = creaseShare(edgeSharpness[k]);
        glm::dvec3 point = middle;
        if (share < 1.0) point = share * middle + (1.0 - share) * (0.5 * middle + 0.25 * (ring.across[(k + n - 1) % n] + ring.across[k]));
        ring.edges.push_back(point);
        ring.edgeSharpness.push_back(lessSharp(edgeSharpness[k]));
    }
    ring.vertex = VertexRule{vertex, sharpness, edges, edgeSharpness, ring.across}.next();
    ring.sharpness = lessSharp(sharpness);
    return ring;
}

LimitPoint VertexRing::limit(std::size_t quad) const {
    VertexRing ring = *this;
    const auto waning = [](const VertexRing& at) {
        return !lasting(at.sharpness) || !std::all_of(at.edgeSharpness.begin(), at.edgeSharpness.end(), lasting);
    };
    while (waning(ring)) ring = ring.next();
    const VertexRing settled = ring;
    LimitPoint point;
    for (int step = 0; step < kMostSteps && width(ring) > 1e-16 * glm::length(ring.vertex); ++step) ring = ring.next();
    point.position = ring.vertex;

    const auto sharp = std::count_if(settled.edgeSharpness.begin(), settled.edgeSharpness.end(), [](float s) { return s > 0.0F; });
    const Rule rule = ruleOf(settled.sharpness, settled.edgeSharpness);
    if (sharp == 1 || (rule == Rule::corner && sharp < 2)) return point;
    ring = centred(settled);
    for (int step = 0; step < kNormalSteps; ++step) ring = centred(ring.next());
    if (rule == Rule::smooth) {
        smoothNormal(point, ring);
    } else {
        sectorNormal(point, ring, quad, rule);
    }
    return point;
}

}  // namespace tessera::test
