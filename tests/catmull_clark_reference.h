// Catmull-Clark surfaces in double precision by nothing but subdivision: slow, simple and apart from OpenSubdiv, so that tests have
// something to hold both it and the project's patches against.
//
// Rules: Catmull and Clark 1978 with the semi-sharp creases of DeRose, Kass, Truong 1998. Sharpness falls by 1 a step (10 and above:
// never); an edge's point is that of a crease where it is 1 or more, and a blend below. A vertex takes the rule of what meets there (no or
// one sharp edge: smooth; two: crease; more, or a sharp vertex: corner); where that changes with the step it blends both by the mean of
// what vanishes.
#pragma once

#include "tessera/cage.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>

namespace tessera::test {

struct LimitPoint {
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0};  // unit length, outwards, of the side that the face asked for lies on
    bool hasNormal =
        false;  // false where there is none, or none that is the same from everywhere: darts, most corners, two faces at a vertex
};

class CatmullClarkReference {
public:
    // Requires a cage as cleanCage() leaves it (manifold, every face of three corners or more, neighbours turned the same way); its scheme
    // and holes do not matter.
    explicit CatmullClarkReference(const Cage& cage);
    ~CatmullClarkReference();
    CatmullClarkReference(CatmullClarkReference&&) noexcept;
    CatmullClarkReference& operator=(CatmullClarkReference&&) noexcept;
    CatmullClarkReference(const CatmullClarkReference&) = delete;
    CatmullClarkReference& operator=(const CatmullClarkReference&) = delete;

    // Faces of four corners: u runs from their first corner to the second, v to the fourth; `subFace` means nothing. Others: the square of
    // corner `subFace`, u towards the middle of the edge to the next corner, (1, 1) the face's middle. Requires u and v from 0 to 1,
    // multiples of 2^-30.
    [[nodiscard]] LimitPoint at(std::uint32_t face, std::uint32_t subFace, double u, double v) const;

private:
    struct Net;
    std::unique_ptr<Net> net_;
};

}  // namespace tessera::test
