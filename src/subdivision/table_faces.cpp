// From OpenSubdiv's refined topology to lists for the device.
#include "subdivision/table_faces.h"

#include <opensubdiv/far/stencilTable.h>
#include <opensubdiv/far/stencilTableFactory.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>

#include "tessera/error.h"

namespace tessera::subdivision {
namespace {

namespace Far = OpenSubdiv::Far;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

void addStencils(const Refiner& refiner, int steps, TableFaces& out) {
    using Factory = Far::StencilTableFactoryReal<double>;
    Factory::Options options;
    options.generateOffsets = true;
    options.generateIntermediateLevels = false;
    options.maxLevel = static_cast<unsigned>(steps) & 0xFU;
    const std::unique_ptr<const Far::StencilTableReal<double>> table(Factory::Create(refiner, options));
    const std::vector<int>&sizes = table->GetSizes(), &sources = table->GetControlIndices();
    out.starts.push_back(0);
    for (const int size : sizes) out.starts.push_back(out.starts.back() + static_cast<std::uint32_t>(size));
    out.sources.assign(sources.begin(), sources.end());
    out.weights.assign(table->GetWeights().begin(), table->GetWeights().end());
}

// A drawn face before faces are sorted by table.
struct Drawn {
    int face = 0;
    FaceRing ring;
    std::uint32_t table = 0;
    std::uint32_t number = 0;
};

std::vector<Drawn> drawnFaces(const Level& level, TableStore& store) {
    std::vector<Drawn> drawn;
    for (int face = 0; face < level.GetNumFaces(); ++face) {
        if (level.IsFaceHole(face)) continue;
        FaceRing ring = canonicalRing(level, face);
        if (ring.vertices.size() > std::numeric_limits<std::uint16_t>::max())
            throw Error("a face has " + std::to_string(ring.vertices.size()) + " control points around it, more than tables take: 65535");
        const std::uint32_t table = store.tableOf(ring);
        drawn.push_back({face, std::move(ring), table, static_cast<std::uint32_t>(drawn.size())});
    }
    std::stable_sort(drawn.begin(), drawn.end(), [](const Drawn& a, const Drawn& b) { return a.table < b.table; });
    return drawn;
}

// Control points, each once, as the table's rows have them; then by their numbers.
void addEntries(const FaceRing& ring, TableFaces& out) {
    const Key repeats = repeatsOf(ring);
    std::vector<std::uint32_t> points;
    for (std::uint32_t k = 0; k < ring.vertices.size(); ++k)
        if (repeats.empty() || repeats[k] == k) points.push_back(ring.vertices[k]);
    std::vector<std::uint16_t> order(points.size());
    std::iota(order.begin(), order.end(), std::uint16_t{0});
    std::sort(order.begin(), order.end(), [&](std::uint16_t a, std::uint16_t b) { return points[a] < points[b]; });
    out.byRow.insert(out.byRow.end(), points.begin(), points.end());
    out.rowOf.insert(out.rowOf.end(), order.begin(), order.end());
    for (const std::uint16_t row : order) out.byNumber.push_back(points[row]);
}

}  // namespace

bool needsStep(const Refiner& refiner) {
    const Level& level = refiner.GetLevel(0);
    for (int face = 0; face < level.GetNumFaces(); ++face)
        if (level.GetFaceVertices(face).size() != 4) return true;
    return false;
}

TableFaces makeTableFaces(Refiner& refiner, int steps, TableStore& store) {
    TableFaces out;
    out.steps = steps;
    if (steps > 0) {
        Refiner::UniformOptions options(steps);
        options.fullTopologyInLastLevel = true;
        refiner.RefineUniform(options);
        addStencils(refiner, steps, out);
    }
    const Level& level = refiner.GetLevel(steps);
    out.points = static_cast<std::uint32_t>(level.GetNumVertices());
    out.edges = static_cast<std::uint32_t>(level.GetNumEdges());
    const std::vector<Drawn> drawn = drawnFaces(level, store);
    std::vector<std::uint32_t> placeOf(static_cast<std::size_t>(level.GetNumFaces()), none);
    for (std::uint32_t k = 0; k < drawn.size(); ++k) placeOf[static_cast<std::size_t>(drawn[k].face)] = k;
    for (std::uint32_t k = 0; k < drawn.size(); ++k) {
        const Drawn& d = drawn[k];
        const auto edges = level.GetFaceEdges(d.face);
        table_face face{};
        face.table = d.table;
        face.first_entry = static_cast<std::uint32_t>(out.byRow.size());
        face.number = d.number;
        face.turn = d.ring.turn;
        std::array<FaceSide, 4> sides;
        for (std::uint32_t s = 0; s < 4; ++s) {
            const int edge = edges[static_cast<int>((s + d.ring.turn) % 4)];
            sides[s].edge = static_cast<std::uint32_t>(edge);
            sides[s].reversed = static_cast<std::uint32_t>(level.GetEdgeVertices(edge)[0]) != d.ring.vertices[s];
            face.beside[s] = k;
            for (const int other : level.GetEdgeFaces(edge))
                if (other != d.face && placeOf[static_cast<std::size_t>(other)] != none)
                    face.beside[s] = placeOf[static_cast<std::size_t>(other)];
        }
        addEntries(d.ring, out);
        out.faces.push_back(face);
        out.sides.push_back(sides);
        out.corners.push_back({d.ring.vertices[0], d.ring.vertices[1], d.ring.vertices[2], d.ring.vertices[3]});
    }
    return out;
}

}  // namespace tessera::subdivision
