// Numbers of a mesh's vertices with those of patches' borders shared, known before any vertex is made.
// Two borders share their vertices where they are made by the same arithmetic from the same bits: the same placed control points and
// weights, in either direction, or parts of the same record's curve; two corners where their placed control point is the same, or the same
// place of a record's curve. Such vertices have the same bits, whatever makes them. A border that runs back upon itself shares its own.
// Memory grows with the number of patches, not of vertices.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tessera/mesh_sink.h"

namespace tessera {

enum class WeldScope {
    patch,   // nothing is shared
    object,  // within an object
    scene,
};

class WeldNumbers {
public:
    // Of the scene's control points as they are. Objects' patches must follow each other.
    WeldNumbers(const MeshOutline& outline, WeldScope scope);

    [[nodiscard]] std::uint64_t vertexCount() const { return firstNew_.back(); }

    // The first of the vertices that come with a patch (index into MeshOutline::patches, or the number of them) and are in none before it:
    // its new ones are numbered in the order of the pattern's own numbers, up to firstNew(patch + 1).
    [[nodiscard]] std::uint64_t firstNew(std::size_t patch) const { return firstNew_[patch]; }

    // The first of a patch's inner vertices, all of which are new; the others follow in order.
    [[nodiscard]] std::uint64_t firstInner(std::size_t patch) const;

    // The numbers of the vertices on a patch's loop, in its order. `numbers` is used again.
    void loop(std::size_t patch, std::vector<std::uint64_t>& numbers) const;

private:
    friend class WeldMaker;

    static constexpr std::uint32_t none = 0xFFFFFFFFU;

    // Some of a curve's vertices, [low, high) of 0 to its segments, numbered from `first` on, from the last one where they fall.
    struct Run {
        std::uint32_t low = 0;
        std::uint32_t high = 0;
        std::uint64_t first = 0;
        bool falls = false;
        std::uint32_t next = none;  // of the same curve
    };
    struct Curve {
        std::uint32_t segments = 0;
        std::uint32_t firstRun = none;
        bool folded = false;  // runs back upon itself: vertex k is vertex segments - k
    };
    // What a side uses of its curve: as many vertices as it has segments, and one, from vertex `low` on. `rises`: along the loop.
    struct Side {
        std::uint32_t curve = none;
        std::uint32_t low = 0;
        bool rises = true;
    };
    struct PatchSides {
        std::array<Side, 4> sides;
        std::array<std::uint64_t, 4> corners{};  // numbers, where the sides begin, along the loop
    };

    void fill(const Side& side, std::span<std::uint64_t> inner) const;
    [[nodiscard]] std::uint64_t numberOn(const Curve& curve, std::uint32_t vertex) const;

    std::span<const mesh_pattern> patterns_;
    std::vector<std::uint64_t> firstNew_;  // of each patch, and the number of all
    std::vector<PatchSides> patches_;      // empty where nothing is shared
    std::vector<Curve> curves_;
    std::vector<Run> runs_;
};

}  // namespace tessera
