// Little cages around a single face, and what their vertices add to its limit surface.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <set>
#include <vector>

#include "subdivision/table_ring.h"
#include "tessera/cage.h"

namespace tessera::subdivision {

// Faces around corners, each face once, with the sharpness that they have there.
class RingCage {
public:
    // All faces around `corner`, which is a vertex of the cage, as those of `ring` are; the first face that is ever added is its own one.
    void addRing(std::uint32_t corner, const CornerRing& ring, std::uint32_t firstFace);
    // With so many vertices.
    [[nodiscard]] Cage cage(std::uint32_t vertices) const;

private:
    void addFace(std::array<std::uint32_t, 4> face);

    Cage cage_;
    std::set<std::array<std::uint32_t, 4>> faces_;
    std::set<std::array<std::uint32_t, 2>> creases_;
};

// The limit surface of a cage's first face, which OpenSubdiv's Bfr evaluates in double precision: exact at points that are vertices of
// level 5, but for lengths of tangents at irregular corners.
class FirstFace {
public:
    explicit FirstFace(const Cage& cage);
    ~FirstFace();
    FirstFace(const FirstFace&) = delete;
    FirstFace& operator=(const FirstFace&) = delete;

    // What each vertex of the cage adds to the position and to the tangents along u and v.
    [[nodiscard]] const std::array<std::vector<double>, 3>& at(double u, double v);

private:
    struct Surface;
    std::unique_ptr<Surface> surface_;
    std::array<std::vector<double>, 3> sums_;
};

}  // namespace tessera::subdivision
