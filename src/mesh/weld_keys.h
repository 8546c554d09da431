// What tells borders and corners of placed patches apart: the bits that their vertices are made from.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "surface/patch_shared.h"
#include "tessera/scene.h"

namespace tessera {

// Bits of floats, -0 as 0.
using CornerKey = std::array<std::uint32_t, 3>;
using CurvePoint = std::array<std::uint32_t, 4>;  // x, y, z, multiplied by w where the curve is rational; w, 0 where it is not
using CurveKey = std::array<CurvePoint, 4>;

// A border's curve as its users see it.
struct BorderCurve {
    CurveKey key{};       // in the one of its two directions whose bits come first
    bool turned = false;  // whether the border's own direction is the other
    bool folded = false;  // both are the same
    // The border is the part [index, index + 1] / 2^level of the key's curve, in its direction.
    std::uint32_t level = 0;
    std::uint32_t index = 0;
};

// Keys of the patches of one object after the other.
class BorderKeys {
public:
    // `scene` must stay.
    explicit BorderKeys(const Scene& scene);

    void setObject(std::uint32_t object);
    [[nodiscard]] bool isTriangle() const { return mesh_->kind == PatchKind::pn; }
    [[nodiscard]] const EdgeRecord* record(std::uint32_t patch, std::uint32_t side) const;
    // Of a record where there is one, else the patch's own border.
    [[nodiscard]] BorderCurve curve(std::uint32_t patch, std::uint32_t side) const;
    // Of a side's first or last control point, in its own direction.
    [[nodiscard]] CornerKey corner(std::uint32_t patch, std::uint32_t side, bool last) const;

private:
    [[nodiscard]] CurvePoint placed(const glm::vec3& point, float weight, bool rational) const;

    std::vector<placed_object> objects_;
    std::vector<const Mesh*> meshes_;  // of each object
    const Mesh* mesh_ = nullptr;
    const placed_object* object_ = nullptr;
    std::array<std::array<std::size_t, 4>, 4> borders_{};
};

// Numbers keys in the order in which they are first asked for.
template <typename Key>
class KeyNumbers {
public:
    // The key's number: the size before, where it is new.
    std::uint32_t of(const Key& key) {
        if (2 * (keys_.size() + 1) > slots_.size()) grow();
        std::uint32_t& slot = slotOf(key);
        if (slot == empty) {
            slot = static_cast<std::uint32_t>(keys_.size());
            keys_.push_back(key);
        }
        return slot;
    }
    void clear() {
        keys_.clear();
        slots_.clear();
    }

private:
    static constexpr std::uint32_t empty = std::numeric_limits<std::uint32_t>::max();

    static std::uint64_t hash(const Key& key) {
        constexpr std::size_t words = sizeof(Key) / sizeof(std::uint32_t);
        std::uint64_t sum = words;
        for (const std::uint32_t word : std::bit_cast<std::array<std::uint32_t, words>>(key)) {
            sum = (sum ^ word) * 0x9E3779B97F4A7C15U;
            sum ^= sum >> 29U;
        }
        return sum;
    }

    std::uint32_t& slotOf(const Key& key) {
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = hash(key) & mask;
        while (slots_[at] != empty && keys_[slots_[at]] != key) at = (at + 1) & mask;
        return slots_[at];
    }

    void grow() {
        slots_.assign(slots_.empty() ? 64 : 2 * slots_.size(), empty);
        for (std::uint32_t k = 0; k < keys_.size(); ++k) slotOf(keys_[k]) = k;
    }

    std::vector<Key> keys_;
    std::vector<std::uint32_t> slots_;  // a power of two of them, half of them empty at least
};

}  // namespace tessera
