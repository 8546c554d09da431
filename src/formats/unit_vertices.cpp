// A patch's new vertices have following numbers in the order of the pattern (mesh/weld_numbers.h): one is new, and has not been met
// before, where its number is the next one.
#include "formats/unit_vertices.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

#include "mesh/pattern.h"
#include "tessera/texture.h"

namespace tessera {
namespace {

std::vector<const Mesh*> texturedMeshes(const Scene& scene) {
    std::unordered_map<std::string_view, const Mesh*> byName;
    for (const Mesh& mesh : scene.meshes)
        if (!mesh.textureNets.empty()) byName.emplace(mesh.name, &mesh);
    std::vector<const Mesh*> ofObjects;
    if (byName.empty()) return ofObjects;
    for (const Object& object : scene.objects) {
        const auto found = byName.find(object.mesh);
        ofObjects.push_back(found == byName.end() ? nullptr : found->second);
    }
    return ofObjects;
}

}  // namespace

UnitVertices::UnitVertices(const MeshOutline& outline, WeldScope scope)
    : outline_(outline), weld_(outline_, scope), textured_(texturedMeshes(outline.scene)) {}

void UnitVertices::read(const MeshPiece& piece, const MeshUnit& unit) {
    fresh_.clear();
    takeVertices(piece, unit);
    if (unit.unit == 0) beginPatch(unit.patch);
    if (patternUnits(outline_.patterns[unit.patch]) == 1) {
        readWhole();
    } else {
        readPart(unit);
    }
}

void UnitVertices::takeVertices(const MeshPiece& piece, const MeshUnit& unit) {
    if (piece.vertices.empty()) {
        made_.assign(unit.vertices, MeshVertex{});
        const float* position = piece.positions.data() + 3 * unit.firstVertex;
        for (MeshVertex& vertex : made_) {
            std::copy_n(position, 3, vertex.position);
            position += 3;
        }
        vertices_ = made_;
        return;
    }
    vertices_ = piece.vertices.subspan(unit.firstVertex, unit.vertices);
    const MeshPatch& patch = outline_.patches[unit.patch];
    const Mesh* const mesh = textured_.empty() ? nullptr : textured_[patch.object];
    if (mesh == nullptr) return;
    made_.assign(vertices_.begin(), vertices_.end());
    for (MeshVertex& vertex : made_) {
        const glm::vec2 texture = textureAt(*mesh, patch.patch, vertex.u, vertex.v);
        vertex.u = texture.x;
        vertex.v = texture.y;
    }
    vertices_ = made_;
}

void UnitVertices::beginPatch(std::size_t patch) {
    weld_.loop(patch, loop_);
    firstInner_ = weld_.firstInner(patch);
    next_ = weld_.firstNew(patch);
}

void UnitVertices::readWhole() {
    numbers_.assign(loop_.begin(), loop_.end());
    for (std::uint64_t k = 0; numbers_.size() < vertices_.size(); ++k) numbers_.push_back(firstInner_ + k);
    for (std::size_t k = 0; k < numbers_.size(); ++k) {
        if (numbers_[k] != next_) continue;
        fresh_.push_back(vertices_[k]);
        ++next_;
    }
}

void UnitVertices::readPart(const MeshUnit& unit) {
    unitVertexNumbers(outline_.patterns[unit.patch], unit.unit, numbers_);
    const bool side = numbers_.front() < loop_.size();
    if (side) heldLoop_.resize(loop_.size());
    if (!side && !heldLoop_.empty()) {
        for (std::size_t k = 0; k < loop_.size(); ++k) {
            if (loop_[k] != next_) continue;
            fresh_.push_back(heldLoop_[k]);
            ++next_;
        }
        heldLoop_.clear();
    }
    for (std::size_t k = 0; k < numbers_.size(); ++k) {
        const std::uint64_t inPattern = numbers_[k];
        const bool onLoop = inPattern < loop_.size();
        numbers_[k] = onLoop ? loop_[inPattern] : firstInner_ + (inPattern - loop_.size());
        if (onLoop) heldLoop_[inPattern] = vertices_[k];
        if (side || numbers_[k] != next_) continue;
        fresh_.push_back(vertices_[k]);
        ++next_;
    }
}

}  // namespace tessera
