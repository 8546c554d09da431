// A tree of boxes over pieces of patches; pieces whose box a ray meets go to the root search.
#include "ray_caster.h"

#include "root_search.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace tessera::reference {

namespace {

constexpr double residualOfSize = 1e-12;   // rounding takes a thousandth of it where the eye is within ten sizes of the scene
constexpr std::size_t mostLeaves = 65536;  // what finer boxes cost in memory is no longer won back in time
constexpr std::size_t leavesInNode = 4;

Box join(const Box& a, const Box& b) { return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)}; }

// Where the ray enters the box, or infinity when it misses it between `nearest` and `farthest`.
double entry(const Box& box, const Ray& ray, double nearest, double farthest) {
    for (int axis = 0; axis < 3; ++axis) {
        const double lower = box.lower[axis] - ray.origin[axis];
        const double upper = box.upper[axis] - ray.origin[axis];
        const double slope = ray.direction[axis];
        if (slope == 0.0) {
            if (lower > 0.0 || upper < 0.0) return std::numeric_limits<double>::infinity();
            continue;
        }
        nearest = std::max(nearest, std::min(lower / slope, upper / slope));
        farthest = std::min(farthest, std::max(lower / slope, upper / slope));
    }
    return nearest <= farthest ? nearest : std::numeric_limits<double>::infinity();
}

int levelsFor(std::size_t patches) {
    int levels = 0;
    while (levels < 3 && patches * (std::size_t{4} << (2 * levels)) <= mostLeaves) ++levels;
    return levels;
}

}  // namespace

Placement placement(const Transform& transform) {
    const glm::quat& q = transform.rotation;
    const double w = q.w;
    const glm::dvec3 axis(q.x, q.y, q.z);
    const double scale = 2.0 / (w * w + glm::dot(axis, axis));
    Placement result;
    for (int column = 0; column < 3; ++column) {
        glm::dvec3 unit(0.0);
        unit[column] = 1.0;
        // Rodrigues' rotation of a basis vector, in terms of the quaternion.
        result.rotation[column] = unit + scale * (w * glm::cross(axis, unit) + glm::cross(axis, glm::cross(axis, unit)));
    }
    result.translation = glm::dvec3(transform.translation);
    return result;
}

RayCaster::RayCaster(const Scene& scene) {
    for (std::size_t i = 0; i < scene.objects.size(); ++i) addObject(scene, i);
    if (placed_.empty()) return;
    const int levels = levelsFor(placed_.size());
    for (std::size_t i = 0; i < placed_.size(); ++i) addLeaves(i, wholePiece(placed_[i].shape), levels);
    Box all{placed_[0].shape.points[0], placed_[0].shape.points[0]};
    for (const PlacedPatch& placed : placed_)
        for (const glm::dvec3& point : placed.shape.points) all = join(all, {point, point});
    size_ = glm::length(all.upper - all.lower);
    // A hit may lie outside its piece by the residual allowed.
    for (Leaf& leaf : leaves_) leaf.box = {leaf.box.lower - residualOfSize * size_, leaf.box.upper + residualOfSize * size_};
    nodes_.reserve(leaves_.size());
    build(0, leaves_.size());
}

void RayCaster::addObject(const Scene& scene, std::size_t object) {
    const Placement place = placement(scene.objects[object].transform);
    for (const Mesh& mesh : scene.meshes) {
        if (mesh.name != scene.objects[object].mesh) continue;
        for (std::size_t patch = 0; patch < mesh.patchCount(); ++patch) {
            std::vector<glm::dvec3> points = patchPoints(mesh, patch);
            const std::size_t positions = positionsPerPatch(mesh.kind);
            for (std::size_t i = 0; i < points.size(); ++i) points[i] = i < positions ? place(points[i]) : place.rotation * points[i];
            placed_.push_back({object, patch, makeShape(mesh.kind, points, patchWeights(mesh, patch)), points});
        }
        return;
    }
}

void RayCaster::addLeaves(std::size_t placed, const Piece& piece, int levels) {
    const glm::dvec2& corner = piece.rectangle.lower;
    if (placed_[placed].shape.kind == PatchKind::pn && corner.x + corner.y >= 1.0) return;
    if (levels == 0) {
        leaves_.push_back({placed, piece, boxOf(enclose(placed_[placed].shape, piece))});
        return;
    }
    const auto [low, high] = halves(piece, true);
    for (const Piece& half : {low, high}) {
        const auto [first, second] = halves(half, false);
        addLeaves(placed, first, levels - 1);
        addLeaves(placed, second, levels - 1);
    }
}

std::size_t RayCaster::build(std::size_t first, std::size_t count) {
    const std::size_t self = nodes_.size();
    Box box = leaves_[first].box;
    for (std::size_t i = first; i < first + count; ++i) box = join(box, leaves_[i].box);
    nodes_.push_back({box, first, count, 0, 0});
    if (count <= leavesInNode) return self;
    const glm::dvec3 size = box.upper - box.lower;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const auto middle = [axis](const Leaf& leaf) { return leaf.box.lower[axis] + leaf.box.upper[axis]; };
    const auto begin = leaves_.begin() + static_cast<std::ptrdiff_t>(first);
    std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(count / 2), begin + static_cast<std::ptrdiff_t>(count),
                     [&middle](const Leaf& a, const Leaf& b) { return middle(a) < middle(b); });
    const std::size_t left = build(first, count / 2);
    const std::size_t right = build(first + count / 2, count - count / 2);
    nodes_[self].left = left;
    nodes_[self].right = right;
    return self;
}

std::optional<Hit> RayCaster::cast(const Ray& ray, double tMin, double tMax) const {
    const double length = glm::length(ray.direction);
    const Ray unitRay{ray.origin, ray.direction / length};
    const double nearest = tMin * length;
    double farthest = tMax * length;
    std::optional<Hit> best;
    std::vector<std::size_t> open;
    if (!nodes_.empty()) open.push_back(0);
    while (!open.empty()) {
        const Node& node = nodes_[open.back()];
        open.pop_back();
        if (!std::isfinite(entry(node.box, unitRay, nearest, farthest))) continue;
        if (node.left != 0) {
            const bool leftIsNearer =
                entry(nodes_[node.left].box, unitRay, nearest, farthest) <= entry(nodes_[node.right].box, unitRay, nearest, farthest);
            open.push_back(leftIsNearer ? node.right : node.left);
            open.push_back(leftIsNearer ? node.left : node.right);
            continue;
        }
        for (std::size_t i = node.first; i < node.first + node.count; ++i) {
            if (!std::isfinite(entry(leaves_[i].box, unitRay, nearest, farthest))) continue;
            const std::optional<Hit> hit = lookInto(leaves_[i], unitRay, nearest, farthest);
            if (!hit) continue;
            best = hit;
            farthest = hit->t;
        }
    }
    if (best) best->t /= length;
    return best;
}

std::optional<Hit> RayCaster::lookInto(const Leaf& leaf, const Ray& unitRay, double nearest, double farthest) const {
    const PlacedPatch& placed = placed_[leaf.placed];
    const RayFrame frame = rayFrame(unitRay.origin, unitRay.direction);
    const PatchShape shape = transformed(placed.shape, frame.linear, frame.origin);
    const Piece piece = transformed(leaf.piece, frame.linear, frame.origin);
    const std::optional<Root> root = nearestRoot(shape, piece, {nearest, farthest, residualOfSize * size_});
    if (!root) return std::nullopt;
    const double u = root->parameters.x;
    const double v = root->parameters.y;
    const Weights weights = placed.shape.weights;
    const glm::dvec3 point = evaluate(placed.shape.kind, placed.points, u, v, weights).position;
    const glm::dvec3 normal = unitNormal(placed.shape.kind, placed.points, u, v, weights);
    const glm::dvec3 shading = shadingNormal(placed.shape.kind, placed.points, u, v, weights);
    return Hit{root->distance, point, placed.object, placed.patch, u, v, normal, shading, root->residual};
}

}  // namespace tessera::reference
