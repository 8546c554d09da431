// Control points are placed as place.cl does it, so that what is the same to the bit on the device is the same here.
#include "mesh/weld_keys.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

#include "mesh/mesh_view.h"
#include "surface/source_mesh.h"

namespace tessera {
namespace {

std::uint32_t bitsOf(float x) { return x == 0.0F ? 0U : std::bit_cast<std::uint32_t>(x); }

}  // namespace

BorderKeys::BorderKeys(const Scene& scene) : objects_(worldObjects(scene)) {
    std::unordered_map<std::string_view, const Mesh*> byName;
    for (const Mesh& mesh : scene.meshes) byName.emplace(mesh.name, &mesh);
    meshes_.reserve(scene.objects.size());
    for (const Object& object : scene.objects) meshes_.push_back(byName.at(object.mesh));
}

void BorderKeys::setObject(std::uint32_t object) {
    object_ = &objects_[object];
    mesh_ = meshes_[object];
    borders_ = bordersOf(mesh_->kind);
}

const EdgeRecord* BorderKeys::record(std::uint32_t patch, std::uint32_t side) const {
    const auto before = [](const EdgeRecord& a, const std::array<std::uint32_t, 2>& b) {
        return a.patch != b[0] ? a.patch < b[0] : a.side < b[1];
    };
    const auto found = std::lower_bound(mesh_->edges.begin(), mesh_->edges.end(), std::array<std::uint32_t, 2>{patch, side}, before);
    return found != mesh_->edges.end() && found->patch == patch && found->side == side ? &*found : nullptr;
}

CurvePoint BorderKeys::placed(const glm::vec3& point, float weight, bool rational) const {
    const glm::vec3 p = rational ? weight * point : point;
    CurvePoint out{};
    for (std::size_t c = 0; c < 3; ++c) {
        const float* const row = object_->eye_from_object + 4 * c;
        out[c] = bitsOf(row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3] * (rational ? weight : 1.0F));
    }
    out[3] = rational ? bitsOf(weight) : 0U;
    return out;
}

BorderCurve BorderKeys::curve(std::uint32_t patch, std::uint32_t side) const {
    BorderCurve curve;
    const EdgeRecord* const edge = record(patch, side);
    if (edge != nullptr) {
        const bool rational = std::any_of(edge->weights.begin(), edge->weights.end(), [](float w) { return w != 1.0F; });
        for (std::size_t k = 0; k < 4; ++k) curve.key[k] = placed(edge->points[k], edge->weights[k], rational);
        curve.level = edge->level;
        curve.index = edge->index;
        curve.turned = edge->reversed;
    } else {
        const std::size_t first = patch * pointsPerPatch(mesh_->kind);
        const bool rational = mesh_->kind == PatchKind::rational;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t point = first + borders_[side][k];
            curve.key[k] = placed(mesh_->points[point], rational ? mesh_->weights[point] : 1.0F, rational);
        }
    }
    CurveKey other = curve.key;
    std::reverse(other.begin(), other.end());
    curve.folded = other == curve.key;
    if (other < curve.key) {
        curve.key = other;
        curve.turned = !curve.turned;
        curve.index = (1U << curve.level) - 1U - curve.index;
    }
    return curve;
}

CornerKey BorderKeys::corner(std::uint32_t patch, std::uint32_t side, bool last) const {
    const CurvePoint p = placed(mesh_->points[patch * pointsPerPatch(mesh_->kind) + borders_[side][last ? 3 : 0]], 1.0F, false);
    return {p[0], p[1], p[2]};
}

}  // namespace tessera
