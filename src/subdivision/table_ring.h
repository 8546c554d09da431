// Neighbourhoods of quadrilaterals: the faces around a face's four corners, walked so that equal neighbourhoods read alike.
#pragma once

#include <opensubdiv/far/topologyLevel.h>

#include <array>
#include <cstdint>
#include <vector>

namespace tessera::subdivision {

using Level = OpenSubdiv::Far::TopologyLevel;
using Key = std::vector<std::uint32_t>;

// What lies around one corner, counter-clockwise. Numbers are positions of the ring.
struct CornerRing {
    bool closed = true;                    // else the first and the last edge are boundaries
    std::uint32_t own = 0;                 // the ring's face among `diagonals`; 0 where closed
    float sharpness = 0;                   // of the corner itself
    std::vector<std::uint32_t> ends;       // of the edges; open: one more than faces
    std::vector<std::uint32_t> diagonals;  // face i lies between the edges i and i + 1
    std::vector<float> edgeSharpness;      // parallel to `ends`

    [[nodiscard]] std::uint32_t faces() const { return static_cast<std::uint32_t>(diagonals.size()); }
    // An edge so many after edge `from`; closed rings wrap around.
    [[nodiscard]] std::uint32_t edge(std::uint32_t from, std::int32_t steps) const;
};

// Unfolded: each position stands for itself, though the mesh may have the same vertex in several.
struct FaceRing {
    std::uint32_t turn = 0;               // the face's corner that is the ring's corner 0
    std::vector<std::uint32_t> vertices;  // of the mesh, by position; the corners are positions 0 to 3
    std::array<CornerRing, 4> corners;
};

// All faces at the face's corners must have four corners.
[[nodiscard]] FaceRing walkRing(const Level& level, int face, std::uint32_t turn);
// The ring of the turn whose key comes first.
[[nodiscard]] FaceRing canonicalRing(const Level& level, int face);

// All that the limit surface's coefficients depend on: valences, boundaries, and the sharpness of corners and of the edges at them.
[[nodiscard]] Key ringKey(const FaceRing& ring);
// By position the first position with the same vertex; empty where all vertices differ.
[[nodiscard]] Key repeatsOf(const FaceRing& ring);

}  // namespace tessera::subdivision
