// Neighbours join pieces over their common borders, each with whether it runs against the piece's first patch.
#include "mesh/orientation.h"

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "mesh/weld_keys.h"
#include "surface/patch_source.h"

namespace tessera {
namespace {

// Patches that are known to run alike or against each other: a forest, each patch with whether it runs against its parent.
class Pieces {
public:
    explicit Pieces(std::size_t patches) : parents_(patches), against_(patches) {
        for (std::size_t k = 0; k < patches; ++k) parents_[k] = static_cast<std::uint32_t>(k);
    }

    // The piece's first patch, and whether `patch` runs against it.
    std::pair<std::uint32_t, bool> find(std::uint32_t patch) {
        std::uint32_t root = patch;
        bool against = false;
        while (parents_[root] != root) {
            against ^= against_[root];
            root = parents_[root];
        }
        // All on the way hang on the root from now on.
        for (bool left = against; parents_[patch] != root && patch != root;) {
            const std::uint32_t next = parents_[patch];
            const bool step = against_[patch];
            parents_[patch] = root;
            against_[patch] = left;
            left ^= step;
            patch = next;
        }
        return {root, against};
    }

    void join(std::uint32_t a, std::uint32_t b, bool against) {
        const auto [rootA, againstA] = find(a);
        const auto [rootB, againstB] = find(b);
        if (rootA == rootB) return;
        // The lesser is the piece's first patch.
        const std::uint32_t root = rootA < rootB ? rootA : rootB, child = rootA < rootB ? rootB : rootA;
        parents_[child] = root;
        against_[child] = (againstA != againstB) != against;
    }

private:
    std::vector<std::uint32_t> parents_;
    std::vector<bool> against_;
};

// A patch on one side of a part of a curve.
struct BorderUse {
    std::uint32_t patch = 0;
    std::uint32_t curve = 0;
    std::uint32_t low = 0;  // of 256 parts of the curve, the finest that records know
    std::uint32_t high = 0;
    bool rises = false;  // whether the patch's loop follows the curve there
    std::uint32_t next = 0;
};

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t finestLevel = 8;

class BorderUses {
public:
    explicit BorderUses(const Scene& scene) : keys_(scene) {}

    void add(std::uint32_t placed, std::uint32_t object, std::uint32_t patch) {
        if (object != object_) keys_.setObject(object);
        object_ = object;
        for (std::uint32_t side = 0; side < 4; ++side) {
            if (side == 2 && keys_.isTriangle()) continue;
            const BorderCurve curve = keys_.curve(patch, side);
            if (curve.folded) continue;  // it has no direction; so have points
            const std::uint32_t number = curves_.of(curve.key);
            if (number == firstUse_.size()) firstUse_.push_back(none);
            const std::uint32_t parts = 1U << (finestLevel - curve.level);
            const bool alongLoop = side < 2;
            uses_.push_back({placed, number, curve.index * parts, (curve.index + 1) * parts, alongLoop != curve.turned, firstUse_[number]});
            firstUse_[number] = static_cast<std::uint32_t>(uses_.size() - 1);
        }
    }

    void joinNeighbours(Pieces& pieces) const {
        for (const BorderUse& use : uses_) {
            const BorderUse* other = nullptr;
            std::size_t before = 0, over = 0;
            // Two settle it: where thousands meet, as copies of an object in one place do, none looks at all the others.
            for (std::uint32_t k = firstUse_[use.curve]; k != none && over < 2; k = uses_[k].next) {
                const BorderUse& one = uses_[k];
                if (&one == &use || one.low >= use.high || use.low >= one.high) continue;
                // Borders that very many patches share must not take the square of their number.
                if (++over > 1) break;
                other = &one;
                before += one.low <= use.low && one.high >= use.high ? 1U : 0U;
            }
            // Across a part of a border there is one neighbour, of the same level or coarser; what is finer finds this one from its side.
            if (over == 1 && before == 1) pieces.join(use.patch, other->patch, use.rises == other->rises);
        }
    }

private:
    BorderKeys keys_;
    std::uint32_t object_ = none;
    KeyNumbers<CurveKey> curves_;
    std::vector<std::uint32_t> firstUse_;  // of each curve
    std::vector<BorderUse> uses_;
};

}  // namespace

std::vector<std::uint32_t> turnedPatches(const Scene& scene) {
    const PatchSource source(scene);
    Pieces pieces(source.patches());
    BorderUses uses(scene);
    std::uint32_t placed = 0;
    source.forPatches(0, source.patches(), [&](std::uint32_t object, std::uint32_t patch) { uses.add(placed++, object, patch); });
    uses.joinNeighbours(pieces);
    std::vector<std::array<std::uint32_t, 2>> counts(source.patches());  // of each root: along and against it
    for (std::uint32_t patch = 0; patch < source.patches(); ++patch) {
        const auto [root, against] = pieces.find(patch);
        ++counts[root][against ? 1 : 0];
    }
    std::vector<std::uint32_t> turned((source.patches() + std::size_t{31}) / 32);
    for (std::uint32_t patch = 0; patch < source.patches(); ++patch) {
        const auto [root, against] = pieces.find(patch);
        const bool moreAgainst = counts[root][1] > counts[root][0];
        if (against != moreAgainst) turned[patch / 32] |= 1U << (patch % 32);
    }
    return turned;
}

}  // namespace tessera
