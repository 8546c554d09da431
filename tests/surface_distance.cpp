// How far meshes and surfaces lie apart, both ways, in double precision.
#include "surface_distance.h"

#include "patch_eval.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tessera::test {

namespace {

constexpr int kCells = 40;  // along each axis

glm::dvec2 inside(PatchKind kind, glm::dvec2 uv) {
    uv = glm::clamp(uv, 0.0, 1.0);
    const double beyond = kind == PatchKind::pn ? uv.x + uv.y - 1.0 : 0.0;
    if (beyond <= 0.0) return uv;
    // Along the triangle's third side.
    const double u = std::clamp(uv.x - beyond / 2.0, 0.0, 1.0);
    return {u, 1.0 - u};
}

glm::dvec3 nearestOfSegment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double squared = glm::dot(along, along);
    return squared > 0.0 ? a + along * std::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : a;
}

// The foot of the perpendicular where it falls inside, else the nearest point of the three sides.
glm::dvec3 nearestOfTriangle(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double squared = glm::dot(normal, normal);
    bool within = squared > 0.0;
    for (std::size_t k = 0; k < 3 && within; ++k) within = glm::dot(glm::cross(t[(k + 1) % 3] - t[k], p - t[k]), normal) >= 0.0;
    if (within) return p - normal * (glm::dot(p - t[0], normal) / squared);
    glm::dvec3 best = nearestOfSegment(p, t[0], t[1]);
    for (std::size_t k = 1; k < 3; ++k) {
        const glm::dvec3 other = nearestOfSegment(p, t[k], t[(k + 1) % 3]);
        if (glm::distance(p, other) < glm::distance(p, best)) best = other;
    }
    return best;
}

}  // namespace

PlacedSurfaces::PlacedSurfaces(const Scene& scene) {
    for (const Object& object : scene.objects) {
        const Mesh& mesh = *scene.findMesh(object.mesh);
        const glm::dmat4 place = matrix(object.transform);
        firstOfObject_.push_back(patches_.size());
        for (std::size_t k = 0; k < mesh.patchCount(); ++k) {
            Patch& patch = patches_.emplace_back(Patch{mesh.kind, reference::patchPoints(mesh, k), reference::patchWeights(mesh, k)});
            for (glm::dvec3& point : patch.points) point = glm::dvec3(place * glm::dvec4(point, 1.0));
        }
    }
}

glm::dvec3 PlacedSurfaces::at(std::size_t patch, const glm::dvec2& uv) const {
    const Patch& p = patches_[patch];
    return reference::evaluate(p.kind, p.points, uv.x, uv.y, p.weights).position;
}

// Steps that would be right were the surface flat, halved until they come nearer.
glm::dvec3 PlacedSurfaces::downhill(const Patch& patch, const glm::dvec3& point, glm::dvec2 uv) const {
    uv = inside(patch.kind, uv);
    reference::SurfacePoint here = reference::evaluate(patch.kind, patch.points, uv.x, uv.y, patch.weights);
    for (int step = 0; step < 20; ++step) {
        const glm::dvec3 to = point - here.position;
        const double uu = glm::dot(here.du, here.du), vv = glm::dot(here.dv, here.dv), both = glm::dot(here.du, here.dv);
        const double tu = glm::dot(to, here.du), tv = glm::dot(to, here.dv), det = uu * vv - both * both;
        const glm::dvec2 alone(uu > 0.0 ? tu / uu : 0.0, vv > 0.0 ? tv / vv : 0.0);
        std::array<glm::dvec2, 3> ways{alone, glm::dvec2(alone.x, 0.0), glm::dvec2(0.0, alone.y)};
        if (det > 1e-9 * uu * vv) ways[0] = glm::dvec2(tu * vv - tv * both, tv * uu - tu * both) / det;
        bool nearer = false;
        // On a border the way down may be along it alone.
        for (int trial = 0; trial < 24 && !nearer; ++trial) {
            const glm::dvec2 next = inside(patch.kind, uv + std::ldexp(1.0, -(trial / 3)) * ways[static_cast<std::size_t>(trial % 3)]);
            const reference::SurfacePoint there = reference::evaluate(patch.kind, patch.points, next.x, next.y, patch.weights);
            nearer = glm::distance(there.position, point) < glm::length(to) * (1.0 - 1e-6);
            if (!nearer) continue;
            uv = next;
            here = there;
        }
        if (!nearer) break;
    }
    return here.position;
}

glm::dvec3 PlacedSurfaces::nearest(std::size_t patch, const glm::dvec3& point, const glm::dvec2& from,
                                   const std::function<bool(const glm::dvec3&)>& enough) const {
    const Patch& surface = patches_[patch];
    glm::dvec3 best = at(patch, inside(surface.kind, from));
    const auto tryFrom = [&](const glm::dvec2& uv) {
        const glm::dvec3 other = downhill(surface, point, uv);
        if (glm::distance(other, point) < glm::distance(best, point)) best = other;
    };
    if (!enough(best)) tryFrom(from);
    for (int k = 0; k < 25 && !enough(best); ++k) tryFrom(glm::dvec2(k % 5, k / 5) / 4.0);
    return best;
}

NearTriangles::NearTriangles(const KeptMesh& mesh, double reach)
    : mesh_(mesh), reach_(reach), cells_(std::size_t{kCells} * kCells * kCells) {
    glm::dvec3 upper(-std::numeric_limits<double>::infinity());
    lower_ = -upper;
    for (std::size_t k = 0; k < mesh.indices.size(); ++k) {
        lower_ = glm::min(lower_, corner(k));
        upper = glm::max(upper, corner(k));
    }
    lower_ -= reach;
    cellSize_ = glm::max((upper + reach - lower_) / double{kCells}, glm::dvec3(1e-30));
    for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
        const std::array<glm::dvec3, 3> c{corner(3 * t), corner(3 * t + 1), corner(3 * t + 2)};
        const glm::ivec3 first = cellOf(glm::min(c[0], glm::min(c[1], c[2])) - reach);
        const glm::ivec3 last = cellOf(glm::max(c[0], glm::max(c[1], c[2])) + reach);
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) cells_[numberOf({x, y, z})].push_back(static_cast<std::uint32_t>(t));
    }
}

glm::ivec3 NearTriangles::cellOf(const glm::dvec3& point) const {
    return {glm::clamp((point - lower_) / cellSize_, 0.0, double{kCells - 1})};
}

std::size_t NearTriangles::numberOf(const glm::ivec3& cell) const {
    const glm::u64vec3 at(cell);
    return (at.z * kCells + at.y) * kCells + at.x;
}

glm::dvec3 NearTriangles::corner(std::size_t index) const {
    const float* const p = mesh_.vertices[mesh_.indices[index]].position;
    return {p[0], p[1], p[2]};
}

std::optional<glm::dvec3> NearTriangles::nearest(const glm::dvec3& point) const {
    std::optional<glm::dvec3> best;
    double least = reach_;
    for (const std::size_t t : cells_[numberOf(cellOf(point))]) {
        const glm::dvec3 other = nearestOfTriangle(point, {corner(3 * t), corner(3 * t + 1), corner(3 * t + 2)});
        const double distance = glm::distance(point, other);
        if (distance > least) continue;
        least = distance;
        best = other;
    }
    return best;
}

}  // namespace tessera::test
