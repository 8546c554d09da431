// A patch's new vertices have following numbers in the order of the pattern (mesh/weld_numbers.h): one is new, and has not been met
// before, where its number is the next one.
#include "formats/unit_vertices.h"

#include <cstring>

#include "mesh/pattern.h"

namespace tessera {
namespace {

MeshVertex vertexOf(const MeshPiece& piece, std::uint64_t k) {
    if (piece.positions.empty()) return piece.vertices[k];
    MeshVertex vertex{};
    std::memcpy(vertex.position, piece.positions.data() + 3 * k, sizeof(vertex.position));
    return vertex;
}

}  // namespace

UnitVertices::UnitVertices(const MeshOutline& outline, WeldScope scope) : outline_(outline), weld_(outline_, scope) {}

void UnitVertices::read(const MeshPiece& piece, const MeshUnit& unit) {
    fresh_.clear();
    if (unit.unit == 0) beginPatch(unit.patch);
    if (patternUnits(outline_.patterns[unit.patch]) == 1) {
        readWhole(piece, unit);
    } else {
        readPart(piece, unit);
    }
}

void UnitVertices::beginPatch(std::size_t patch) {
    weld_.loop(patch, loop_);
    firstInner_ = weld_.firstInner(patch);
    next_ = weld_.firstNew(patch);
}

void UnitVertices::readWhole(const MeshPiece& piece, const MeshUnit& unit) {
    numbers_.assign(loop_.begin(), loop_.end());
    for (std::uint64_t k = 0; numbers_.size() < unit.vertices; ++k) numbers_.push_back(firstInner_ + k);
    for (std::size_t k = 0; k < numbers_.size(); ++k) {
        if (numbers_[k] != next_) continue;
        fresh_.push_back(vertexOf(piece, unit.firstVertex + k));
        ++next_;
    }
}

void UnitVertices::readPart(const MeshPiece& piece, const MeshUnit& unit) {
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
        if (onLoop) heldLoop_[inPattern] = vertexOf(piece, unit.firstVertex + k);
        if (side || numbers_[k] != next_) continue;
        fresh_.push_back(vertexOf(piece, unit.firstVertex + k));
        ++next_;
    }
}

}  // namespace tessera
