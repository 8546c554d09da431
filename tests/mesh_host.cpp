// A tessellation by the kernels' own headers, compiled as C++.
#include "mesh_host.h"

#include "device/lanes_host.h"
#include "mesh/pattern.h"
#include "render/frame_setup.h"
#include "surface/source_mesh.h"

#include <array>
#include <random>
#include <utility>

// clang-format off
#include "device/kernel_headers_begin.h"
namespace tessera::kernels {
#include "mesh/pattern.clh"
#include "surface/vertex.clh"
}  // namespace tessera::kernels
#include "device/kernel_headers_end.h"
// clang-format on

namespace tessera::test {
namespace {

std::array<glm::vec3, 4> borderCurve(const Mesh& mesh, std::size_t patch, std::size_t side) {
    std::array<glm::vec3, 4> curve{};
    const std::array<std::size_t, 4> border = bordersOf(mesh.kind)[side];
    for (std::size_t k = 0; k < 4; ++k) curve[k] = mesh.points[patch * pointsPerPatch(mesh.kind) + border[k]];
    return curve;
}

std::uint32_t segmentsOf(const std::array<glm::vec3, 4>& c, double density) {
    const float length = (glm::length(c[1] - c[0]) + glm::length(c[3] - c[2])) + glm::length(c[2] - c[1]);
    return length == 0.0F ? 0U : 1U + static_cast<std::uint32_t>(length * density);
}

std::array<std::uint32_t, 4> ratesOf(const Mesh& mesh, std::size_t patch, double density) {
    std::array<std::uint32_t, 4> rates{};
    for (std::size_t side = 0; side < 4; ++side) rates[side] = segmentsOf(borderCurve(mesh, patch, side), density);
    for (const EdgeRecord& edge : mesh.edges) {
        if (edge.patch != patch || rates[edge.side] == 0) continue;
        const std::uint32_t whole = segmentsOf(edge.points, density), least = 1U << edge.cuts;
        rates[edge.side] = ((whole + least - 1) / least * least) >> edge.level;
    }
    return rates;
}

mesh_pattern patternOf(const Mesh& mesh, std::size_t patch, double density, std::uint32_t cells, std::mt19937& random) {
    mesh_pattern p{};
    const std::array<std::uint32_t, 4> rates = ratesOf(mesh, patch, density);
    for (std::size_t side = 0; side < 4; ++side) p.side[side] = rates[side];
    const bool triangle = mesh.kind == PatchKind::pn;
    p.form = triangle ? MESH_TRIANGLE_RING : MESH_RING;
    p.cells_u = triangle ? static_cast<std::uint32_t>(random() % (cells - 1)) : 2 + static_cast<std::uint32_t>(random() % (cells - 1));
    p.cells_v = triangle ? 0 : 2 + static_cast<std::uint32_t>(random() % (cells - 1));
    p.low_u = MESH_ONE / (triangle ? 8 : p.cells_u);
    p.low_v = MESH_ONE / (triangle ? 8 : p.cells_v);
    p.high_u = triangle && p.cells_u == 0 ? p.low_u + p.low_v : MESH_ONE - p.low_u;
    p.high_v = MESH_ONE - p.low_v;
    return p;
}

// A patch in world space, as the device would hold it.
struct WorldPatch {
    std::vector<float> net;
    std::vector<float> curves;
    std::vector<edge_info> records;
    kernels::patch_ref ref{};
};

float row(const float* m, float x, float y, float z, float w) { return m[0] * x + m[1] * y + m[2] * z + m[3] * w; }

void place(const placed_object& object, const glm::vec3& p, float w, std::size_t at, std::size_t count, std::vector<float>& net) {
    for (std::size_t c = 0; c < 3; ++c) net[c * count + at] = row(object.eye_from_object + 4 * c, p.x, p.y, p.z, w);
}

constexpr std::array<std::size_t, 20> kGregoryOrder{0, 4, 9, 1, 8, 12, 13, 5, 7, 15, 14, 10, 3, 11, 6, 2, 16, 17, 18, 19};

std::vector<float> netOf(const Mesh& mesh, const placed_object& object, std::size_t patch) {
    const std::size_t count = pointsPerPatch(mesh.kind);
    const glm::vec3* const points = mesh.points.data() + patch * count;
    std::vector<float> net(mesh.kind == PatchKind::rational ? RATIONAL_FLOATS : 3 * count);
    for (std::size_t k = 0; k < count; ++k) {
        if (mesh.kind == PatchKind::rational) {
            const float w = mesh.weights[patch * count + k];
            place(object, w * points[k], w, k, count, net);
            net[48 + k] = w;
        } else {
            place(object, points[mesh.kind == PatchKind::gregory ? kGregoryOrder[k] : k], 1.0F, k, count, net);
        }
    }
    if (mesh.kind != PatchKind::rational) return net;
    std::vector<float> corners(12);
    for (std::size_t k = 0; k < 4; ++k) place(object, points[std::array<std::size_t, 4>{0, 3, 12, 15}[k]], 1.0F, k, 4, corners);
    std::copy(corners.begin(), corners.end(), net.begin() + 64);
    return net;
}

WorldPatch worldPatch(const Mesh& mesh, const placed_object& object, std::size_t patch) {
    WorldPatch out;
    out.net = netOf(mesh, object, patch);
    out.ref.kind = static_cast<int>(mesh.kind);
    for (std::size_t side = 0; side < 4; ++side) {
        if (mesh.kind == PatchKind::pn && side == 2) continue;
        const std::array<glm::vec3, 4> c = borderCurve(mesh, patch, side);
        if (c[0] == c[1] && c[0] == c[2] && c[0] == c[3]) out.ref.flags |= SIDE_DEGENERATE << side;
    }
    for (const EdgeRecord& edge : mesh.edges) {
        if (edge.patch != patch) continue;
        out.ref.flags |= SIDE_RECORDED << edge.side;
        const bool rational = edge.weights != std::array<float, 4>{1.0F, 1.0F, 1.0F, 1.0F};
        out.records.push_back({0, 0, edge.level, edge.index, edge.reversed ? 1U : 0U, rational ? 1U : 0U, edge.cuts});
        std::vector<float> curve(RECORD_FLOATS);
        for (std::size_t k = 0; k < 4; ++k) {
            place(object, edge.weights[k] * edge.points[k], edge.weights[k], k, 4, curve);
            curve[12 + k] = edge.weights[k];
        }
        out.curves.insert(out.curves.end(), curve.begin(), curve.end());
    }
    out.ref.net = out.net.data();
    out.ref.records = out.records.data();
    out.ref.record_curves = out.curves.data();
    return out;
}

using Place = std::pair<int, int>;  // u, v

Place placeOnLoop(const mesh_pattern& p, bool triangle, std::uint64_t number) {
    auto k = static_cast<std::uint32_t>(number);
    std::uint32_t s = 0;
    for (; k >= p.side[s]; ++s) k -= p.side[s];
    const int along = kernels::mesh_even(static_cast<int>(s < 2 ? k : p.side[s] - k), p.side[s]), one = static_cast<int>(MESH_ONE);
    if (s == 0) return {along, 0};
    if (s == 1) return {triangle ? one - along : one, along};
    return s == 2 ? Place{along, one} : Place{0, along};
}

Place placeOf(const mesh_pattern& p, bool triangle, std::uint64_t number) {
    if (number < kernels::mesh_loop(&p)) return placeOnLoop(p, triangle, number);
    number -= kernels::mesh_loop(&p);
    std::uint32_t j = 0;
    while (number >= kernels::mesh_rows_before(&p, j + 1)) ++j;
    const auto i = static_cast<int>(number - kernels::mesh_rows_before(&p, j));
    return {kernels::mesh_column_place(&p, i), kernels::mesh_row_place(&p, static_cast<int>(j))};
}

// Triangles of a unit; local numbers come from functions of the pattern's.
class Triangles {
public:
    Triangles(const mesh_pattern& pattern, std::uint32_t unit, std::vector<std::uint32_t>& indices)
        : p_(pattern), unit_(kernels::mesh_unit_of(&pattern, unit)), indices_(indices) {}

    void make() {
        const bool ring = p_.form == MESH_RING;
        for (int s = 0; s < 4; ++s)
            if ((unit_.side == -2 || unit_.side == s) && (ring || s != 2)) transition(s);
        if (unit_.side >= 0) return;
        for (std::uint32_t j = unit_.first_row; j < unit_.end_row; ++j) cells(j);
    }

private:
    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) { indices_.insert(indices_.end(), {a, b, c}); }

    [[nodiscard]] std::uint32_t outer(int s, std::uint32_t i) const { return unit_.side >= 0 ? i : kernels::mesh_loop_vertex(&p_, s, i); }
    [[nodiscard]] std::uint32_t beside(int s, std::uint32_t k) const {
        return unit_.side >= 0 ? p_.side[s] + 1 + k : kernels::mesh_beside_vertex(&p_, s, k);
    }
    [[nodiscard]] std::uint32_t inner(std::uint32_t i, std::uint32_t j) const {
        const std::uint32_t vertex = kernels::mesh_inner_vertex(&p_, i, j);
        return unit_.side == -2 ? vertex : vertex - kernels::mesh_inner_vertex(&p_, 0, unit_.first_row);
    }

    void transition(int s) {
        kernels::mesh_zip zip = kernels::mesh_side_zip(&p_, s);
        std::uint32_t i = 0, k = 0;
        while (i < zip.outer || k < zip.inner) {
            const bool isOuter = kernels::mesh_zip_outer(&zip, i, k);
            std::uint32_t a = outer(s, i);
            std::uint32_t b = isOuter ? outer(s, i + 1) : beside(s, k + 1);
            if (s >= 2) std::swap(a, b);
            add(a, b, beside(s, k));
            kernels::mesh_zip_step(&zip, isOuter);
            ++(isOuter ? i : k);
        }
    }

    void cells(std::uint32_t j) {
        const bool triangle = p_.form == MESH_TRIANGLE_RING;
        const std::uint32_t count = kernels::mesh_inner_cells(&p_) - (triangle ? j : 0);
        for (std::uint32_t i = 0; i < count; ++i) {
            if (triangle) {
                add(inner(i, j), inner(i + 1, j), inner(i, j + 1));
                if (i + 1 < count) add(inner(i + 1, j), inner(i + 1, j + 1), inner(i, j + 1));
            } else {
                add(inner(i, j), inner(i + 1, j), inner(i + 1, j + 1));
                add(inner(i, j), inner(i + 1, j + 1), inner(i, j + 1));
            }
        }
    }

    const mesh_pattern& p_;
    kernels::mesh_unit unit_;
    std::vector<std::uint32_t>& indices_;
};

// A vertex inside a recorded side lies where the whole curve's vertex lies: a part's own even places, halved, are rounded otherwise.
kernels::vpoint pointOf(const WorldPatch& patch, const mesh_pattern& p, std::uint64_t number, const Place& place) {
    std::uint64_t first = 0;
    std::size_t record = 0;
    for (std::uint32_t s = 0; s < 4; first += p.side[s], ++s) {
        if ((patch.ref.flags & (SIDE_RECORDED << s)) == 0) continue;
        const edge_info& edge = patch.records[record];
        const float* const curve = patch.curves.data() + RECORD_FLOATS * record;
        ++record;
        if (number <= first || number >= first + p.side[s]) continue;
        const auto k = static_cast<std::uint32_t>(number - first);
        const bool along = (s < 2) == (edge.reversed == 0);
        const auto vertex = static_cast<int>(edge.index * p.side[s] + (along ? k : p.side[s] - k));
        return kernels::record_point(&edge, curve, kernels::mesh_even(vertex, p.side[s] << edge.level));
    }
    return kernels::patch_vertex(patch.ref, place.first, place.second);
}

MeshVertex vertexAt(const WorldPatch& patch, const mesh_pattern& pattern, const MeshPatch& names, std::uint64_t number) {
    const Place place = placeOf(pattern, patch.ref.kind == KIND_PN, number);
    const kernels::vpoint p = pointOf(patch, pattern, number, place);
    const glm::vec3 normal = glm::normalize(glm::vec3(p.x, p.y, p.z) + glm::vec3(0.1F, 5.0F, 0.3F));
    constexpr float unit = 1.0F / 16777216.0F;
    const float u = static_cast<float>(place.first) * unit, v = static_cast<float>(place.second) * unit;
    return {{p.x, p.y, p.z}, {normal.x, normal.y, normal.z}, u, v, names.object, names.patch};
}

}  // namespace

HostMesh::HostMesh(Scene scene, double density, std::uint32_t cells, bool positionsOnly)
    : scene_(std::move(scene)), positionsOnly_(positionsOnly) {
    std::mt19937 random(7);
    for (std::uint32_t object = 0; object < scene_.objects.size(); ++object) {
        const Mesh& mesh = *scene_.findMesh(scene_.objects[object].mesh);
        for (std::uint32_t patch = 0; patch < mesh.patchCount(); ++patch) {
            patches_.push_back({object, patch});
            patterns.push_back(patternOf(mesh, patch, density, cells, random));
        }
    }
    finish();
}

void HostMesh::finish() {
    sizes_ = {};
    sizes_.patches = patches_.size();
    for (const mesh_pattern& pattern : patterns) {
        const mesh_offset all = unitsBefore(pattern, patternUnits(pattern));
        sizes_.units += all.units;
        sizes_.vertices += all.vertices;
        sizes_.triangles += all.triangles;
        sizes_.distinctVertices += patternVertices(pattern);
    }
}

MeshOutline HostMesh::outline() const { return {scene_, positionsOnly_, sizes_, patches_, patterns}; }

MeshVertex HostMesh::vertex(std::size_t patch, std::uint64_t number) const {
    const MeshPatch& names = patches_[patch];
    const Mesh& mesh = *scene_.findMesh(scene_.objects[names.object].mesh);
    const WorldPatch placed = worldPatch(mesh, placeObjects(scene_, glm::dmat4(1.0))[names.object], names.patch);
    return vertexAt(placed, patterns[patch], names, number);
}

HostMesh::Unit HostMesh::unit(std::size_t patch, std::uint32_t unit) const {
    const MeshPatch& names = patches_[patch];
    const Mesh& mesh = *scene_.findMesh(scene_.objects[names.object].mesh);
    const WorldPatch placed = worldPatch(mesh, placeObjects(scene_, glm::dmat4(1.0))[names.object], names.patch);
    Unit out;
    std::vector<std::uint64_t> numbers;
    unitVertexNumbers(patterns[patch], unit, numbers);
    for (const std::uint64_t number : numbers) out.vertices.push_back(vertexAt(placed, patterns[patch], names, number));
    Triangles(patterns[patch], unit, out.indices).make();
    return out;
}

void HostMesh::stream(MeshSink& sink, const std::function<std::size_t(std::size_t)>& unitsOf) const {
    std::vector<MeshUnit> units;
    Unit all;
    std::size_t piece = 0;
    const auto send = [&] {
        std::vector<float> positions;
        for (const MeshVertex& v : all.vertices) positions.insert(positions.end(), v.position, v.position + 3);
        if (!units.empty() && positionsOnly_) sink.take({units, {}, positions, all.indices});
        if (!units.empty() && !positionsOnly_) sink.take({units, all.vertices, {}, all.indices});
        units.clear();
        all = {};
        ++piece;
    };
    for (std::uint32_t patch = 0; patch < patches_.size(); ++patch) {
        for (std::uint32_t k = 0; k < patternUnits(patterns[patch]); ++k) {
            const Unit made = unit(patch, k);
            const auto base = static_cast<std::uint32_t>(all.vertices.size());
            units.push_back({patch, k, base, made.vertices.size(), all.indices.size() / 3, made.indices.size() / 3});
            all.vertices.insert(all.vertices.end(), made.vertices.begin(), made.vertices.end());
            for (const std::uint32_t index : made.indices) all.indices.push_back(base + index);
            if (units.size() >= unitsOf(piece)) send();
        }
    }
    send();
}

}  // namespace tessera::test
