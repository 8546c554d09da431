// Walks over edges, from face to face: the order in which OpenSubdiv lists a vertex's faces does not matter.
#include "subdivision/table_ring.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace tessera::subdivision {
namespace {

// A face as a vertex sees it: `corner` is the vertex's place in it.
struct Spoke {
    int face = 0;
    int corner = 0;
};

struct Spokes {
    std::vector<Spoke> list;  // counter-clockwise
    std::uint32_t own = 0;
    bool closed = true;
};

// The face on the other side of the edge that leads to (ahead: from) the vertex; none: a face of -1.
Spoke across(const Level& level, Spoke at, int vertex, bool ahead) {
    const int edge = level.GetFaceEdges(at.face)[ahead ? (at.corner + 3) % 4 : at.corner];
    const auto faces = level.GetEdgeFaces(edge);
    for (const int face : faces) {
        if (face == at.face) continue;
        const auto vertices = level.GetFaceVertices(face), edges = level.GetFaceEdges(face);
        for (int c = 0; c < 4; ++c) {
            if (vertices[c] == vertex && edges[ahead ? c : (c + 3) % 4] == edge) return {face, c};
        }
    }
    return {-1, 0};
}

Spokes spokesOf(const Level& level, Spoke first) {
    const int vertex = level.GetFaceVertices(first.face)[first.corner];
    Spokes spokes;
    spokes.list.push_back(first);
    for (Spoke at = across(level, first, vertex, true); at.face != first.face; at = across(level, at, vertex, true)) {
        if (at.face < 0) {
            spokes.closed = false;
            break;
        }
        spokes.list.push_back(at);
    }
    if (spokes.closed) return spokes;
    std::vector<Spoke> behind;
    for (Spoke at = across(level, first, vertex, false); at.face >= 0; at = across(level, at, vertex, false)) behind.push_back(at);
    std::reverse(behind.begin(), behind.end());
    spokes.own = static_cast<std::uint32_t>(behind.size());
    spokes.list.insert(spokes.list.begin(), behind.begin(), behind.end());
    return spokes;
}

// A ring's positions while it is walked.
class RingMaker {
public:
    RingMaker(const Level& level, int face, std::uint32_t turn) : level_(level) {
        ring_.turn = turn;
        for (std::uint32_t c = 0; c < 4; ++c) {
            const int corner = static_cast<int>((c + turn) % 4);
            spokes_[c] = spokesOf(level, {face, corner});
            ring_.vertices.push_back(static_cast<std::uint32_t>(level.GetFaceVertices(face)[corner]));
        }
    }

    FaceRing make() {
        for (std::uint32_t c = 0; c < 4; ++c) walkEnds(c);
        for (std::uint32_t c = 0; c < 4; ++c) walkDiagonals(c);
        for (std::uint32_t c = 0; c < 4; ++c) joinAtTwo(c);
        return std::move(ring_);
    }

private:
    std::uint32_t add(const Spoke& spoke, int step) {
        ring_.vertices.push_back(static_cast<std::uint32_t>(level_.GetFaceVertices(spoke.face)[(spoke.corner + step) % 4]));
        return static_cast<std::uint32_t>(ring_.vertices.size() - 1);
    }

    void walkEnds(std::uint32_t c) {
        const Spokes& spokes = spokes_[c];
        CornerRing& corner = ring_.corners[c];
        const auto faces = static_cast<std::uint32_t>(spokes.list.size());
        const std::uint32_t ends = spokes.closed ? faces : faces + 1;
        corner.closed = spokes.closed;
        corner.own = spokes.own;
        corner.sharpness = level_.GetVertexSharpness(static_cast<int>(ring_.vertices[c]));
        for (std::uint32_t k = 0; k < ends; ++k) {
            const bool last = k == faces;
            const Spoke spoke = spokes.list[last ? k - 1 : k];
            corner.edgeSharpness.push_back(level_.GetEdgeSharpness(level_.GetFaceEdges(spoke.face)[(spoke.corner + (last ? 3 : 0)) % 4]));
            if (k == spokes.own)
                corner.ends.push_back((c + 1) % 4);
            else if (k == (spokes.own + 1) % ends)
                corner.ends.push_back((c + 3) % 4);
            else
                corner.ends.push_back(add(spoke, last ? 3 : 1));
        }
    }

    // The faces beside the ring's own are beside its neighbouring corners too.
    void walkDiagonals(std::uint32_t c) {
        CornerRing& corner = ring_.corners[c];
        const auto faces = static_cast<std::uint32_t>(spokes_[c].list.size());
        for (std::uint32_t k = 0; k < faces; ++k) {
            const CornerRing &next = ring_.corners[(c + 1) % 4], &before = ring_.corners[(c + 3) % 4];
            if (k == corner.own)
                corner.diagonals.push_back((c + 2) % 4);
            else if (k == corner.own + 1)
                corner.diagonals.push_back(before.ends[before.edge(before.own, -1)]);
            else if (k + 1 == corner.own || (corner.closed && k + 1 == faces))
                corner.diagonals.push_back(next.ends[next.edge(next.own, 2)]);
            else
                corner.diagonals.push_back(add(spokes_[c].list[k], 2));
        }
    }

    // Where two faces are all there are around a corner, the other one's fourth corner has been reached from both sides.
    void joinAtTwo(std::uint32_t c) {
        if (!ring_.corners[c].closed || ring_.corners[c].faces() != 2) return;
        const CornerRing &next = ring_.corners[(c + 1) % 4], &before = ring_.corners[(c + 3) % 4];
        const std::uint32_t a = before.ends[before.edge(before.own, -1)], b = next.ends[next.edge(next.own, 2)];
        if (a == b) return;
        const std::uint32_t kept = std::min(a, b), gone = std::max(a, b);
        const auto join = [&](std::uint32_t& p) { p = p == gone ? kept : p > gone ? p - 1 : p; };
        for (CornerRing& corner : ring_.corners) {
            std::for_each(corner.ends.begin(), corner.ends.end(), join);
            std::for_each(corner.diagonals.begin(), corner.diagonals.end(), join);
        }
        ring_.vertices.erase(ring_.vertices.begin() + gone);
    }

    const Level& level_;
    FaceRing ring_;
    std::array<Spokes, 4> spokes_;
};

Key keyFrom(const FaceRing& ring, std::uint32_t turn) {
    Key key;
    for (std::uint32_t c = 0; c < 4; ++c) {
        const CornerRing& corner = ring.corners[(c + turn) % 4];
        key.insert(key.end(), {corner.closed ? 1U : 0U, corner.faces(), corner.own, std::bit_cast<std::uint32_t>(corner.sharpness)});
        for (const float sharpness : corner.edgeSharpness) key.push_back(std::bit_cast<std::uint32_t>(sharpness));
    }
    return key;
}

}  // namespace

std::uint32_t CornerRing::edge(std::uint32_t from, std::int32_t steps) const {
    const auto count = static_cast<std::int32_t>(ends.size());
    return static_cast<std::uint32_t>((static_cast<std::int32_t>(from) + steps % count + count) % count);
}

FaceRing walkRing(const Level& level, int face, std::uint32_t turn) { return RingMaker(level, face, turn).make(); }

FaceRing canonicalRing(const Level& level, int face) {
    FaceRing ring = walkRing(level, face, 0);
    Key least = keyFrom(ring, 0);
    std::uint32_t turn = 0;
    for (std::uint32_t t = 1; t < 4; ++t) {
        Key key = keyFrom(ring, t);
        if (key >= least) continue;
        least = std::move(key);
        turn = t;
    }
    return turn == 0 ? ring : walkRing(level, face, turn);
}

Key ringKey(const FaceRing& ring) { return keyFrom(ring, 0); }

Key repeatsOf(const FaceRing& ring) {
    std::vector<std::uint32_t> order(ring.vertices.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return ring.vertices[a] != ring.vertices[b] ? ring.vertices[a] < ring.vertices[b] : a < b;
    });
    Key first(order.size());
    bool any = false;
    for (std::size_t k = 0; k < order.size(); ++k) {
        const bool repeated = k > 0 && ring.vertices[order[k]] == ring.vertices[order[k - 1]];
        first[order[k]] = repeated ? first[order[k - 1]] : order[k];
        any = any || repeated;
    }
    return any ? first : Key();
}

}  // namespace tessera::subdivision
