// Pieces of patches over a sub-rectangle of (u, v), with boxes that are proven to hold the surface over it.
//
// A Bezier piece has an exact net of its own, whose hull holds it. So has a rational piece, in homogeneous coordinates; and as all its
// weights are above 0, the hull of its net divided by them holds it too. A pn triangle is the bicubic patch of its polynomial, of
// which the part beyond u + v = 1 is not the triangle's: who uses a piece must leave that out. A Gregory patch is the bicubic patch through
// the means of its face points plus, for each corner k, (f+k - f-k) G(u, v) with G = B (plus - 1/2), B the Bernstein weight of the blended
// point. G has second derivatives bounded by 18 (at the corner; G is smooth elsewhere), so over a piece it is its tangent at the middle,
// which goes into the net, and a rest bounded by the square of the piece's width, which widens the box.
#pragma once

#include "patch_eval.h"

#include <array>
#include <utility>
#include <vector>

namespace tessera::reference {

// A patch in some coordinate system, as pieces need it.
struct PatchShape {
    PatchKind kind = PatchKind::bezier;
    std::vector<glm::dvec3> points;
    std::vector<double> weights{};      // rational: one a point, else empty
    std::array<glm::dvec3, 4> apart{};  // f+k - f-k; zero but for Gregory
    bool blended = false;               // whether any of `apart` is not zero
};

// Of a pn triangle it keeps the positions alone.
[[nodiscard]] PatchShape makeShape(PatchKind kind, std::vector<glm::dvec3> points, std::vector<double> weights = {});

// The shape after x -> linear (x - origin).
[[nodiscard]] PatchShape transformed(const PatchShape& shape, const glm::dmat3& linear, const glm::dvec3& origin);

struct Rectangle {
    glm::dvec2 lower{0.0};  // (u, v)
    glm::dvec2 upper{1.0};

    [[nodiscard]] glm::dvec2 middle() const { return 0.5 * (lower + upper); }
    [[nodiscard]] glm::dvec2 width() const { return upper - lower; }
};

using NetWeights = std::array<double, 16>;

struct Piece {
    Rectangle rectangle;
    Net net{};              // the bicubic part (face points at their means), over `rectangle`; rational: times the weights
    NetWeights weights{};   // rational: their net
    bool rational = false;  // whether `weights` mean anything
};

[[nodiscard]] Piece wholePiece(const PatchShape& shape);

// The piece of the shape after x -> linear (x - origin).
[[nodiscard]] Piece transformed(const Piece& piece, const glm::dmat3& linear, const glm::dvec3& origin);

// The two halves of a piece, cut across u or across v.
[[nodiscard]] std::pair<Piece, Piece> halves(const Piece& piece, bool alongU);

// The surface over a piece lies within `pad`, coordinate by coordinate, of a point in the hull of `net`. Its derivatives by
// the piece's own parameters (0 to 1 over the rectangle) lie within `slopePad` of a point in the hull of 3 x the net's differences.
// Of a rational piece all this is said of position times weight.
struct Enclosure {
    Net net{};
    NetWeights weights{};
    bool rational = false;
    glm::dvec3 pad{0.0};
    glm::dvec3 slopePadU{0.0};
    glm::dvec3 slopePadV{0.0};
};

[[nodiscard]] Enclosure enclose(const PatchShape& shape, const Piece& piece);

struct Box {
    glm::dvec3 lower{0.0};
    glm::dvec3 upper{0.0};
};

// Holds the surface itself, rational or not.
[[nodiscard]] Box boxOf(const Enclosure& enclosure);

[[nodiscard]] double greatestWeight(const Enclosure& enclosure);  // 1 unless rational

}  // namespace tessera::reference
