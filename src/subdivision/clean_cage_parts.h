// The steps of cleanCage(), in this order: faces that can be drawn, turned the same way, vertices of one fan of faces each, tags.
// Sorting rather than hashing all through: no input, however made, is slow, and the outcome has one order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "subdivision/clean_cage.h"

namespace tessera::subdivision {

// Faces and what their corners have, face after face.
struct CageFaces {
    std::vector<std::uint32_t> starts{0};  // each face's first corner, and one past the last face's last
    std::vector<std::uint32_t> vertices;   // one a corner
    std::vector<std::uint32_t> textures;   // one a corner, or none at all
    std::vector<std::uint32_t> faceOf;     // of the given cage

    [[nodiscard]] std::size_t count() const { return starts.size() - 1; }
    [[nodiscard]] std::uint32_t size(std::size_t face) const { return starts[face + 1] - starts[face]; }
    [[nodiscard]] std::uint32_t next(std::size_t face, std::uint32_t corner) const {
        return corner + 1 == starts[face + 1] ? starts[face] : corner + 1;
    }
};

// The edge from a face's corner to its next.
struct CageSide {
    std::uint32_t low = 0, high = 0;  // vertices, low < high
    std::uint32_t face = 0;
    std::uint32_t corner = 0;  // among all corners

    [[nodiscard]] bool sameEdge(const CageSide& other) const { return low == other.low && high == other.high; }
};

// By vertices, so that those of an edge follow each other; then by corner.
[[nodiscard]] std::vector<CageSide> cageSides(const CageFaces& faces);

// Whether the face goes along the edge from its low to its high vertex.
[[nodiscard]] inline bool isForward(const CageFaces& faces, const CageSide& side) { return faces.vertices[side.corner] == side.low; }

// Whether an edge is one that two faces, which agree, have in common.
[[nodiscard]] inline bool isJoined(const CageFaces& faces, std::span<const CageSide> edge) {
    return edge.size() == 2 && isForward(faces, edge[0]) != isForward(faces, edge[1]);
}

// Calls visit(span of sides) for every edge.
template <typename Visit>
void forEachCageEdge(std::span<const CageSide> sides, Visit visit) {
    for (std::size_t first = 0; first < sides.size();) {
        std::size_t end = first + 1;
        while (end < sides.size() && sides[end].sameEdge(sides[first])) ++end;
        visit(sides.subspan(first, end - first));
        first = end;
    }
}

// Throws Error where lists do not fit each other or numbers pass 31 bits, as OpenSubdiv's do.
void checkCageLists(const Cage& cage);

// Faces of three to 65535 different vertices that exist and are finite; none twice; none at a vertex of too many.
[[nodiscard]] CageFaces usableFaces(const Cage& cage, CageReport& report);

// Turns faces so that neighbours agree, in each connected piece the fewer.
void orientFaces(CageFaces& faces, CageReport& report);

// Gives the corners new vertices, each of one fan of faces that are joined along edges. Returns the old vertex of each new one, rising.
[[nodiscard]] std::vector<std::uint32_t> cutVertices(CageFaces& faces, CageReport& report);

// Creases, corners and holes of `given` as they are to be for faces and vertices of `clean`.
void moveTags(const Cage& given, CleanCage& clean, const CageFaces& faces, CageReport& report);
void creaseByAngle(double angle, Cage& cage, const CageFaces& faces, CageReport& report);

// Creases that touch a face with an inner vertex of two faces: OpenSubdiv 3.5's Bfr misreads its own numbers of them, out of bounds.
void dropRiskyCreases(Cage& cage, const CageFaces& faces, CageReport& report);

// The direction that a face of the cage faces, by Newell's method; of twice its area's length. Corners `first` to `first` + `size` - 1.
[[nodiscard]] glm::dvec3 newellNormal(const Cage& cage, std::size_t first, std::size_t size);

// A cage's faces once it is clean.
[[nodiscard]] CageFaces facesOf(const Cage& cage);

// Notes "COUNT thing rest" where there are any; with an s where there are several.
void noteCount(CageReport& report, std::size_t count, std::string_view thing, const std::string& rest);

}  // namespace tessera::subdivision
