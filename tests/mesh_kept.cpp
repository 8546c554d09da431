// Meshes read back from the device, and their edges and fans counted.
#include "mesh_kept.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <unordered_map>

namespace tessera::test {

namespace {

void readBuffer(const DeviceMesh& mesh, cl_mem buffer, void* to, std::size_t bytes) {
    if (bytes == 0) return;
    if (clEnqueueReadBuffer(mesh.queue, buffer, CL_TRUE, 0, bytes, to, 0, nullptr, nullptr) != CL_SUCCESS)
        throw std::runtime_error("a mesh can't be read back");
}

std::vector<MeshVertex> verticesAt(const std::vector<float>& positions) {
    std::vector<MeshVertex> vertices(positions.size() / 3);
    for (std::size_t k = 0; k < vertices.size(); ++k) std::copy_n(positions.begin() + static_cast<long>(3 * k), 3, vertices[k].position);
    return vertices;
}

using VertexBits = std::array<std::uint32_t, sizeof(MeshVertex) / sizeof(std::uint32_t)>;
VertexBits bitsOf(const MeshVertex& vertex) { return std::bit_cast<VertexBits>(vertex); }

struct PositionHash {
    std::size_t operator()(const std::array<std::uint32_t, 3>& bits) const {
        std::uint64_t h = 0;
        for (const std::uint32_t word : bits) h = (h ^ word) * 0x9e3779b97f4a7c15ULL;
        return h ^ (h >> 29);
    }
};

std::vector<std::uint32_t> weldedIndices(const KeptMesh& mesh, std::size_t& count) {
    std::unordered_map<std::array<std::uint32_t, 3>, std::uint32_t, PositionHash> numbers;
    numbers.reserve(mesh.vertices.size());
    std::vector<std::uint32_t> of;
    of.reserve(mesh.vertices.size());
    for (const MeshVertex& vertex : mesh.vertices) {
        std::array<std::uint32_t, 3> bits{};
        for (std::size_t c = 0; c < 3; ++c) bits[c] = std::bit_cast<std::uint32_t>(vertex.position[c] + 0.0F);
        of.push_back(numbers.emplace(bits, static_cast<std::uint32_t>(numbers.size())).first->second);
    }
    std::vector<std::uint32_t> welded;
    std::vector<bool> used(numbers.size());
    for (const std::uint32_t index : mesh.indices) {
        welded.push_back(of.at(index));
        used[of[index]] = true;
    }
    count = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
    return welded;
}

struct Use {
    std::uint64_t edge = 0;  // the lesser end, then the greater
    bool forward = false;    // from the lesser to the greater
};

void countEdges(std::vector<Use>& uses, Closedness& result) {
    std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.edge < b.edge; });
    for (std::size_t k = 0; k < uses.size();) {
        std::size_t end = k, forward = 0;
        for (; end < uses.size() && uses[end].edge == uses[k].edge; ++end) forward += uses[end].forward ? 1U : 0U;
        ++result.edges;
        if (end - k > 2) ++result.crowdedEdges;
        if (end - k == 1) ++result.openEdges;
        if (end - k == 2 && forward != 1) ++result.crossedEdges;
        k = end;
    }
}

// Of a closed surface the triangles at a vertex are one fan where following them from one around comes to all of them.
std::size_t pinchedVertices(const std::vector<std::uint32_t>& indices) {
    std::unordered_map<std::uint64_t, std::uint32_t> next;                          // (vertex, a) -> b of each triangle (vertex, a, b)
    std::unordered_map<std::uint32_t, std::pair<std::uint32_t, std::size_t>> fans;  // vertex -> some neighbour, triangles
    for (std::size_t t = 0; t < indices.size(); t += 3) {
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t v = indices[t + c], a = indices[t + (c + 1) % 3], b = indices[t + (c + 2) % 3];
            next[(std::uint64_t{v} << 32) | a] = b;
            auto& fan = fans[v];
            fan.first = a;
            ++fan.second;
        }
    }
    std::size_t pinched = 0;
    for (const auto& [v, fan] : fans) {
        std::uint32_t at = fan.first;
        std::size_t steps = 0;
        do {
            const auto found = next.find((std::uint64_t{v} << 32) | at);
            if (found == next.end()) break;
            at = found->second;
            ++steps;
        } while (at != fan.first && steps <= fan.second);
        if (steps != fan.second) ++pinched;
    }
    return pinched;
}

}  // namespace

RendererSettings meshTestSettings() {
    RendererSettings settings;
    if (std::getenv("TESSERA_CACHE") == nullptr) settings.cacheFolder = TESSERA_TEST_CACHE;
    return settings;
}

KeptMesh keep(const DeviceMesh& mesh, bool positionsOnly) {
    KeptMesh kept;
    kept.indices.resize(3 * mesh.sizes.triangles);
    readBuffer(mesh, mesh.indices, kept.indices.data(), mesh.sizes.indexBytes);
    if (positionsOnly) {
        std::vector<float> positions(3 * mesh.sizes.vertices);
        readBuffer(mesh, mesh.vertices, positions.data(), mesh.sizes.vertexBytes);
        kept.vertices = verticesAt(positions);
        return kept;
    }
    kept.vertices.resize(mesh.sizes.vertices);
    readBuffer(mesh, mesh.vertices, kept.vertices.data(), mesh.sizes.vertexBytes);
    return kept;
}

void KeepingSink::begin(const MeshOutline& outline) { sizes = outline.sizes; }

void KeepingSink::take(const MeshPiece& piece) {
    const std::uint64_t firstVertex = mesh.vertices.size(), firstTriangle = mesh.indices.size() / 3;
    mesh.vertices.insert(mesh.vertices.end(), piece.vertices.begin(), piece.vertices.end());
    const std::vector<MeshVertex> bare = verticesAt({piece.positions.begin(), piece.positions.end()});
    mesh.vertices.insert(mesh.vertices.end(), bare.begin(), bare.end());
    for (const std::uint32_t index : piece.indices) mesh.indices.push_back(static_cast<std::uint32_t>(index + firstVertex));
    for (MeshUnit unit : piece.units) {
        unit.firstVertex += firstVertex;
        unit.firstTriangle += firstTriangle;
        units.push_back(unit);
    }
    ++pieces;
}

void expectSameMesh(const KeptMesh& one, const KeptMesh& other) {
    ASSERT_EQ(one.vertices.size(), other.vertices.size());
    ASSERT_EQ(one.indices, other.indices);
    for (std::size_t k = 0; k < one.vertices.size(); ++k) ASSERT_EQ(bitsOf(one.vertices[k]), bitsOf(other.vertices[k])) << "vertex " << k;
}

Closedness closedness(const KeptMesh& mesh) {
    Closedness result;
    result.triangles = mesh.indices.size() / 3;
    const std::vector<std::uint32_t> indices = weldedIndices(mesh, result.vertices);
    std::vector<Use> uses;
    uses.reserve(indices.size());
    for (std::size_t t = 0; t < indices.size(); t += 3) {
        bool degenerate = false;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t a = indices[t + c], b = indices[t + (c + 1) % 3];
            degenerate |= a == b;
            uses.push_back({(std::uint64_t{std::min(a, b)} << 32) | std::max(a, b), a < b});
        }
        if (degenerate) ++result.degenerate;
    }
    countEdges(uses, result);
    result.pinched = result.openEdges + result.crossedEdges + result.crowdedEdges == 0 ? pinchedVertices(indices) : 0;
    return result;
}

std::string Closedness::text() const {
    std::ostringstream out;
    out << vertices << " vertices, " << triangles << " triangles, " << edges << " edges: open " << openEdges << ", crossed " << crossedEdges
        << ", crowded " << crowdedEdges << ", degenerate triangles " << degenerate << ", pinched vertices " << pinched << ", Euler number "
        << euler();
    return out.str();
}

}  // namespace tessera::test
