// The quadrilaterals that a cage's patches lie in.
#include "subdivision/quad_domains.h"

#include <utility>

namespace tessera::subdivision {

namespace {

namespace Far = OpenSubdiv::Far;

class DomainMaker {
public:
    explicit DomainMaker(const Refiner& refiner) : level_(refiner.GetLevel(0)) {
        vertices_ = static_cast<std::uint32_t>(level_.GetNumVertices());
        edges_ = static_cast<std::uint32_t>(level_.GetNumEdges());
        made_.vertices = vertices_;
        made_.edges = edges_;
        made_.lines = edges_;
        made_.points = vertices_ + edges_ + static_cast<std::uint32_t>(level_.GetNumFaces());
    }

    QuadDomains make() {
        for (int face = 0; face < level_.GetNumFaces(); ++face) {
            const int size = level_.GetFaceVertices(face).size();
            if (!level_.IsFaceHole(face)) {
                if (size == 4) {
                    addQuad(face);
                } else {
                    for (int corner = 0; corner < size; ++corner) addSubFace(face, corner, size);
                }
            }
            // Ways to the middle have their numbers whether they are drawn or not.
            if (size != 4) made_.lines += static_cast<std::uint32_t>(size);
        }
        return std::move(made_);
    }

private:
    // Whether the face's edge `k`, from its corner k to the next, runs against OpenSubdiv's own direction.
    [[nodiscard]] bool runsBack(int face, int k) const {
        return level_.GetEdgeVertices(level_.GetFaceEdges(face)[k])[0] != level_.GetFaceVertices(face)[k];
    }
    [[nodiscard]] std::uint32_t edge(int face, int k) const { return static_cast<std::uint32_t>(level_.GetFaceEdges(face)[k]); }
    [[nodiscard]] std::uint32_t vertex(int face, int k) const { return static_cast<std::uint32_t>(level_.GetFaceVertices(face)[k]); }

    void addQuad(int face) {
        QuadDomain domain;
        domain.face = static_cast<std::uint32_t>(face);
        for (int k = 0; k < 4; ++k) {
            domain.corners[static_cast<std::size_t>(k)] = vertex(face, k);
            // The last two edges go round against the parameters.
            const bool against = k >= 2;
            domain.sides[static_cast<std::size_t>(k)] = {edge(face, k), false, 0, runsBack(face, k) != against};
        }
        made_.domains.push_back(domain);
    }

    void addSubFace(int face, int corner, int size) {
        const int before = (corner + size - 1) % size;
        const std::uint32_t next = edge(face, corner), last = edge(face, before);
        const bool nextBack = runsBack(face, corner), lastBack = runsBack(face, before);
        QuadDomain domain;
        domain.face = static_cast<std::uint32_t>(face);
        domain.subFace = corner;
        domain.corners = {vertex(face, corner), vertices_ + next, vertices_ + edges_ + domain.face, vertices_ + last};
        const std::uint32_t way = made_.lines;
        domain.sides[0] = {next, true, nextBack ? 1U : 0U, nextBack};
        domain.sides[1] = {way + static_cast<std::uint32_t>(corner), false, 0, false};
        domain.sides[2] = {way + static_cast<std::uint32_t>(before), false, 0, false};
        // From the corner back along the edge before it.
        domain.sides[3] = {last, true, lastBack ? 0U : 1U, !lastBack};
        made_.domains.push_back(domain);
    }

    const Far::TopologyLevel& level_;
    std::uint32_t vertices_ = 0, edges_ = 0;
    QuadDomains made_;
};

}  // namespace

QuadDomains makeDomains(const Refiner& refiner) { return DomainMaker(refiner).make(); }

}  // namespace tessera::subdivision
