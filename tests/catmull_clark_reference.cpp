// Catmull-Clark by nothing but subdivision: of the faces around one face, then of those around one of its quarters, and so on.
#include "catmull_clark_reference.h"

#include "vertex_ring.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace tessera::test {

namespace {

constexpr float kForEver = 10.0F;

using Face = std::vector<std::size_t>;
using Ends = std::pair<std::size_t, std::size_t>;  // lower first

Ends endsOf(std::size_t a, std::size_t b) { return {std::min(a, b), std::max(a, b)}; }

struct Edge {
    float sharpness = 0.0F;
    std::size_t number = 0;
    std::vector<std::size_t> faces{};
};

// Where a point of the next level comes from.
struct Origin {
    enum Kind { vertex, edge, face } kind = vertex;
    std::size_t number = 0;
    bool operator==(const Origin& other) const { return kind == other.kind && number == other.number; }
    bool operator<(const Origin& other) const { return kind != other.kind ? kind < other.kind : number < other.number; }
};

// The faces that share a vertex with face 0, and of all else that belongs to them at least what face 0's quarters need.
struct Patchwork {
    std::vector<glm::dvec3> points;
    std::vector<float> sharpness;  // of vertices
    std::vector<Face> faces;
    std::map<Ends, Edge> edges;

    void link() {
        std::size_t number = 0;
        for (auto& [ends, edge] : edges) edge.faces.clear();
        for (std::size_t f = 0; f < faces.size(); ++f)
            for (std::size_t k = 0; k < faces[f].size(); ++k)
                edges[endsOf(faces[f][k], faces[f][(k + 1) % faces[f].size()])].faces.push_back(f);
        for (auto& [ends, edge] : edges) edge.number = number++;
    }

    [[nodiscard]] glm::dvec3 facePoint(std::size_t face) const {
        glm::dvec3 sum(0.0);
        for (const std::size_t vertex : faces[face]) sum += points[vertex];
        return sum / static_cast<double>(faces[face].size());
    }

    [[nodiscard]] glm::dvec3 edgePoint(const Ends& ends, const Edge& edge) const {
        const glm::dvec3 middle = 0.5 * (points[ends.first] + points[ends.second]);
        const double share = creaseShare(edge.sharpness);
        if (share == 1.0) return middle;
        return share * middle + (1.0 - share) * (0.5 * middle + 0.25 * (facePoint(edge.faces.at(0)) + facePoint(edge.faces.at(1))));
    }

    [[nodiscard]] glm::dvec3 vertexPoint(std::size_t vertex) const {
        VertexRule rule{points[vertex], sharpness[vertex], {}, {}};
        for (const Face& face : faces) {
            const auto at = std::find(face.begin(), face.end(), vertex);
            if (at != face.end()) rule.facePoints.push_back(facePoint(static_cast<std::size_t>(&face - faces.data())));
        }
        for (const auto& [ends, edge] : edges) {
            if (ends.first != vertex && ends.second != vertex) continue;
            rule.edges.push_back(points[ends.first == vertex ? ends.second : ends.first]);
            rule.edgeSharpness.push_back(edge.sharpness);
        }
        return rule.next();
    }

    [[nodiscard]] const Edge& edgeBetween(std::size_t a, std::size_t b) const { return edges.at(endsOf(a, b)); }

    // The quarter of face `f` at its corner k: the corner, the middle of the next edge, the face's, the middle of the edge before.
    [[nodiscard]] std::array<Origin, 4> quarter(std::size_t f, std::size_t k) const {
        const Face& face = faces[f];
        const std::size_t next = face[(k + 1) % face.size()], last = face[(k + face.size() - 1) % face.size()];
        return {Origin{Origin::vertex, face[k]}, Origin{Origin::edge, edgeBetween(face[k], next).number}, Origin{Origin::face, f},
                Origin{Origin::edge, edgeBetween(last, face[k]).number}};
    }

    [[nodiscard]] Patchwork around(std::size_t face) const;
    [[nodiscard]] Patchwork refined(std::size_t corner, std::size_t turn) const;
    [[nodiscard]] VertexRing ring(std::size_t corner, std::size_t& quad) const;
};

// Numbers what is used in the order of its use.
class Numbers {
public:
    explicit Numbers(Patchwork& to) : to_(to) {}
    template <typename Make>
    std::size_t of(const Origin& origin, const Make& make) {
        const auto [at, isNew] = numbers_.emplace(origin, to_.points.size());
        if (isNew) {
            const auto [point, sharpness] = make();
            to_.points.push_back(point);
            to_.sharpness.push_back(sharpness);
        }
        return at->second;
    }
    [[nodiscard]] std::optional<std::size_t> find(const Origin& origin) const {
        const auto at = numbers_.find(origin);
        return at == numbers_.end() ? std::nullopt : std::optional(at->second);
    }

private:
    Patchwork& to_;
    std::map<Origin, std::size_t> numbers_;
};

Patchwork Patchwork::around(std::size_t face) const {
    Patchwork part;
    Numbers numbers(part);
    const auto take = [&](const Face& from) {
        part.faces.emplace_back();
        for (const std::size_t vertex : from)
            part.faces.back().push_back(numbers.of({Origin::vertex, vertex}, [&] { return std::pair(points[vertex], sharpness[vertex]); }));
    };
    take(faces[face]);
    const auto touches = [&](std::size_t vertex) { return std::find(faces[face].begin(), faces[face].end(), vertex) != faces[face].end(); };
    for (std::size_t f = 0; f < faces.size(); ++f)
        if (f != face && std::any_of(faces[f].begin(), faces[f].end(), touches)) take(faces[f]);
    for (const auto& [ends, edge] : edges) {
        const auto a = numbers.find({Origin::vertex, ends.first}), b = numbers.find({Origin::vertex, ends.second});
        if (a && b) part.edges[endsOf(*a, *b)].sharpness = edge.sharpness;
    }
    // Edges between vertices of the part that none of its faces has.
    part.link();
    std::erase_if(part.edges, [](const auto& item) { return item.second.faces.empty(); });
    part.link();
    return part;
}

// The quarter of face 0 at `corner` and all around it; its corner `turn` becomes the first.
Patchwork Patchwork::refined(std::size_t corner, std::size_t turn) const {
    std::array<Origin, 4> middle = quarter(0, corner);
    std::rotate(middle.begin(), middle.begin() + static_cast<std::ptrdiff_t>(turn), middle.end());
    std::vector<std::array<Origin, 4>> quads{middle};
    const auto touches = [&](const Origin& origin) { return std::find(middle.begin(), middle.end(), origin) != middle.end(); };
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (std::size_t k = 0; k < faces[f].size(); ++k) {
            if (f == 0 && k == corner) continue;
            const std::array<Origin, 4> quad = quarter(f, k);
            if (std::any_of(quad.begin(), quad.end(), touches)) quads.push_back(quad);
        }
    }
    std::vector<const std::pair<const Ends, Edge>*> byNumber(edges.size());
    for (const auto& item : edges) byNumber[item.second.number] = &item;

    Patchwork part;
    Numbers numbers(part);
    const auto make = [&](const Origin& origin) {
        if (origin.kind == Origin::vertex) return std::pair(vertexPoint(origin.number), lessSharp(sharpness[origin.number]));
        if (origin.kind == Origin::face) return std::pair(facePoint(origin.number), 0.0F);
        return std::pair(edgePoint(byNumber[origin.number]->first, byNumber[origin.number]->second), 0.0F);
    };
    for (const std::array<Origin, 4>& quad : quads) {
        part.faces.emplace_back();
        for (const Origin& origin : quad) part.faces.back().push_back(numbers.of(origin, [&] { return make(origin); }));
        for (std::size_t k = 0; k < 4; ++k) {
            const Origin &a = quad[k], &b = quad[(k + 1) % 4];
            if (a.kind == Origin::face || b.kind == Origin::face) continue;
            const std::size_t edge = a.kind == Origin::edge ? a.number : b.number;
            part.edges[endsOf(part.faces.back()[k], part.faces.back()[(k + 1) % 4])].sharpness =
                lessSharp(byNumber[edge]->second.sharpness);
        }
    }
    part.link();
    return part;
}

// Around a corner of face 0, quadrilaterals all; `quad` is told which of them face 0 is.
VertexRing Patchwork::ring(std::size_t corner, std::size_t& quad) const {
    const std::size_t centre = faces[0][corner];
    const auto step = [&](std::size_t face, std::size_t by) {
        const auto at = std::find(faces[face].begin(), faces[face].end(), centre) - faces[face].begin();
        return faces[face][(static_cast<std::size_t>(at) + by) % 4];
    };
    // The face on the other side of the edge from the centre to what follows it in `face` by so many steps.
    const auto beyond = [&](std::size_t face, std::size_t by) -> std::optional<std::size_t> {
        for (const std::size_t other : edgeBetween(centre, step(face, by)).faces)
            if (other != face) return other;
        return std::nullopt;
    };
    std::size_t first = 0;
    for (auto before = beyond(0, 1); before && *before != 0; before = beyond(first, 1)) first = *before;
    const bool open = !beyond(first, 1);
    if (!open) first = 0;

    VertexRing ring;
    ring.vertex = points[centre];
    ring.sharpness = sharpness[centre];
    const auto addEdge = [&](std::size_t end) {
        ring.edges.push_back(points[end]);
        ring.edgeSharpness.push_back(edgeBetween(centre, end).sharpness);
    };
    std::optional<std::size_t> face = first;
    std::size_t last = first;
    do {
        last = *face;
        if (last == 0) quad = ring.across.size();
        addEdge(step(last, 1));
        ring.across.push_back(points[step(last, 2)]);
        face = beyond(last, 3);
    } while (face && *face != first);
    if (open) addEdge(step(last, 3));
    return ring;
}

void requireCage(const Cage& cage) {
    std::size_t corners = 0;
    for (const std::uint32_t size : cage.faceSizes) corners += size;
    if (corners != cage.faceVertices.size()) throw std::invalid_argument("face sizes don't add up");
}

}  // namespace

struct CatmullClarkReference::Net {
    Patchwork whole;
    // Made when first asked for: most tests ask for many points of a face.
    mutable std::map<std::size_t, Patchwork> parts;

    [[nodiscard]] const Patchwork& part(std::size_t face) const {
        const auto at = parts.find(face);
        return at != parts.end() ? at->second : parts.emplace(face, whole.around(face)).first->second;
    }
};

CatmullClarkReference::CatmullClarkReference(const Cage& cage) : net_(std::make_unique<Net>()) {
    requireCage(cage);
    Patchwork& whole = net_->whole;
    whole.points.assign(cage.points.begin(), cage.points.end());
    whole.sharpness.assign(cage.points.size(), 0.0F);
    std::vector<int> facesAt(cage.points.size());
    std::size_t at = 0;
    for (const std::uint32_t size : cage.faceSizes) {
        whole.faces.emplace_back();
        for (std::uint32_t k = 0; k < size; ++k) whole.faces.back().push_back(cage.faceVertices[at++]);
        for (const std::size_t vertex : whole.faces.back()) ++facesAt.at(vertex);
    }
    whole.link();
    for (const Crease& crease : cage.creases) whole.edges.at(endsOf(crease.a, crease.b)).sharpness = std::min(crease.sharpness, kForEver);
    for (const Corner& corner : cage.corners) whole.sharpness.at(corner.vertex) = std::min(corner.sharpness, kForEver);
    for (auto& [ends, edge] : whole.edges) {
        if (edge.faces.size() != 1) continue;
        edge.sharpness = kForEver;
        for (const std::size_t vertex : {ends.first, ends.second})
            if (cage.boundary == BoundaryRule::edgeAndCorner && facesAt[vertex] == 1) whole.sharpness[vertex] = kForEver;
    }
}

CatmullClarkReference::~CatmullClarkReference() = default;
CatmullClarkReference::CatmullClarkReference(CatmullClarkReference&&) noexcept = default;
CatmullClarkReference& CatmullClarkReference::operator=(CatmullClarkReference&&) noexcept = default;

LimitPoint CatmullClarkReference::at(std::uint32_t face, std::uint32_t subFace, double u, double v) const {
    // Quarters of a quadrilateral by (u, v): its corner, and which corner of the quarter has the least of both.
    const auto half = [](double& t) {
        const bool upper = t >= 0.5;
        t = upper ? 2.0 * t - 1.0 : 2.0 * t;
        return upper;
    };
    const auto quarterOf = [&](double& s, double& t) {
        const bool right = half(s), above = half(t);
        return static_cast<std::size_t>(above ? (right ? 2 : 3) : (right ? 1 : 0));
    };
    const auto isEnd = [](double t) { return t == 0.0 || t == 1.0; };
    const Patchwork& part = net_->part(face);
    const bool quad = part.faces[0].size() == 4;
    const std::size_t first = quad ? quarterOf(u, v) : subFace;
    // Counting from the corner of the parent that a quarter has, its corner (0, 0) comes as many places back.
    Patchwork local = part.refined(first, quad ? (4 - first) % 4 : 0);
    while (!isEnd(u) || !isEnd(v)) {
        const std::size_t corner = quarterOf(u, v);
        local = local.refined(corner, (4 - corner) % 4);
    }
    std::size_t inRing = 0;
    const VertexRing ring = local.ring(v == 0.0 ? (u == 0.0 ? 0U : 1U) : (u == 0.0 ? 3U : 2U), inRing);
    return ring.limit(inRing);
}

}  // namespace tessera::test
