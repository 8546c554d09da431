// The patches that weld() looks at together, and where the control points of their borders lie.
#include "scene/weld_group.h"

#include "scene/text.h"
#include "tessera/error.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <numeric>
#include <string_view>
#include <unordered_map>

namespace tessera::welding {

namespace {

constexpr std::array<std::array<std::size_t, 2>, 4> kQuadEnds{{{0, 1}, {1, 2}, {3, 2}, {0, 3}}};
constexpr Layout kNet{{0, 3, 15, 12}, {{{0, 1, 2, 3}, {3, 7, 11, 15}, {12, 13, 14, 15}, {0, 4, 8, 12}}}, kQuadEnds};
constexpr Layout kGregory{{0, 1, 2, 3}, {{{0, 4, 9, 1}, {1, 5, 10, 2}, {3, 11, 6, 2}, {0, 8, 7, 3}}}, kQuadEnds};
constexpr Layout kTriangle{{0, 3, kNone, 9},
                           {{{0, 1, 2, 3}, {3, 6, 8, 9}, {kNone, kNone, kNone, kNone}, {0, 4, 7, 9}}},
                           {{{0, 1}, {1, 3}, {kNone, kNone}, {0, 3}}}};

// Borders have numbers of 32 bits, of which one stands for none.
constexpr std::size_t kMostPatches = (std::size_t{1} << 30U) - 1;

double boundsDiagonal(const Mesh& mesh) {
    Bounds bounds;
    const std::size_t step = pointsPerPatch(mesh.kind), positions = positionsPerPatch(mesh.kind);
    for (std::size_t k = 0; k < mesh.points.size(); ++k) {
        if (k % step < positions) bounds.include(mesh.points[k]);
    }
    return bounds.empty() ? 0.0 : glm::distance(glm::dvec3(bounds.lower), glm::dvec3(bounds.upper));
}

using TransformBits = std::array<std::uint32_t, 7>;

TransformBits bitsOf(const Transform& transform) {
    const glm::vec3& t = transform.translation;
    const glm::quat& r = transform.rotation;
    const std::array<float, 7> values{t.x, t.y, t.z, r.w, r.x, r.y, r.z};
    TransformBits bits{};
    std::transform(values.begin(), values.end(), bits.begin(), [](float value) { return std::bit_cast<std::uint32_t>(value); });
    return bits;
}

std::size_t rootOf(std::vector<std::size_t>& parent, std::size_t item) {
    while (parent[item] != item) item = parent[item] = parent[parent[item]];
    return item;
}

}  // namespace

const Layout& layout(PatchKind kind) {
    switch (kind) {
        case PatchKind::gregory:
            return kGregory;
        case PatchKind::pn:
            return kTriangle;
        case PatchKind::bezier:
        case PatchKind::rational:
            break;
    }
    return kNet;
}

Group::Group(std::vector<Mesh*> meshes, double relativeTolerance) : meshes_(std::move(meshes)), firstPatch_{0} {
    for (const Mesh* mesh : meshes_) {
        firstPatch_.push_back(firstPatch_.back() + mesh->patchCount());
        // What is below the least distance of two numbers can only mean: the same.
        const double tolerance = relativeTolerance * boundsDiagonal(*mesh);
        tolerances_.push_back(tolerance < static_cast<double>(std::numeric_limits<float>::denorm_min()) ? 0.0 : tolerance);
    }
    if (patchCount() > kMostPatches) {
        throw Error("mesh " + quotedName(meshes_.front()->name) + " and those placed with it have more than " +
                    std::to_string(kMostPatches) + " patches; split the scene");
    }
}

Group::Place Group::place(std::size_t patch) const {
    const auto next = std::upper_bound(firstPatch_.begin(), firstPatch_.end(), patch);
    const auto index = static_cast<std::size_t>(next - firstPatch_.begin()) - 1;
    return {meshes_[index], index, patch - firstPatch_[index]};
}

Curve Group::curve(std::uint32_t border) const {
    const Place at = place(border / 4);
    const std::size_t first = at.patch * pointsPerPatch(at.mesh->kind);
    const std::array<std::size_t, 4>& points = layout(at.mesh->kind).sides[border % 4];
    Curve result;
    for (std::size_t k = 0; k < 4; ++k) {
        result.points[k] = at.mesh->points[first + points[k]];
        if (at.mesh->kind == PatchKind::rational) result.weights[k] = static_cast<double>(at.mesh->weights[first + points[k]]);
    }
    return result;
}

std::vector<std::vector<Mesh*>> meshesByTransform(Scene& scene) {
    std::unordered_map<std::string_view, std::size_t> byName;
    for (std::size_t k = 0; k < scene.meshes.size(); ++k) byName.emplace(scene.meshes[k].name, k);
    std::vector<std::size_t> parent(scene.meshes.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    std::map<TransformBits, std::size_t> firstWith;
    for (const Object& object : scene.objects) {
        const auto mesh = byName.find(object.mesh);
        if (mesh == byName.end()) continue;
        const std::size_t other = firstWith.emplace(bitsOf(object.transform), mesh->second).first->second;
        const std::size_t a = rootOf(parent, mesh->second), b = rootOf(parent, other);
        parent[std::max(a, b)] = std::min(a, b);
    }
    std::vector<std::vector<Mesh*>> groups;
    std::vector<std::size_t> groupOf(scene.meshes.size());
    for (std::size_t k = 0; k < scene.meshes.size(); ++k) {
        const std::size_t root = rootOf(parent, k);
        if (root == k) {
            groupOf[k] = groups.size();
            groups.emplace_back();
        }
        groups[groupOf[root]].push_back(&scene.meshes[k]);
    }
    return groups;
}

}  // namespace tessera::welding
