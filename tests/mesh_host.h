// Tessellations made on the host, for tests of what takes a mesh: patterns with rates of sides that come from the sides' curves alone,
// vertices by the kernels' own vertex.clh, triangles as pattern.clh numbers them, cut into pieces at will.
#pragma once

#include "mesh/mesh_shared.h"
#include "tessera/mesh_sink.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tessera::test {

class HostMesh {
public:
    // `density`: segments per length of a side's control polygon; `cells`: of the inner grids, two at least, drawn by chance up to this.
    HostMesh(Scene scene, double density, std::uint32_t cells, bool positionsOnly = false);

    // All patches of these; to be changed before finish().
    std::vector<mesh_pattern> patterns;

    // Sizes, after changes of patterns.
    void finish();

    [[nodiscard]] MeshOutline outline() const;

    // Hands all units to the sink, after begin(), as many a piece as `unitsOf` says of the piece's number.
    void stream(MeshSink& sink, const std::function<std::size_t(std::size_t)>& unitsOf) const;

    // The vertices of a unit, in its order, and its triangles, numbers of those.
    struct Unit {
        std::vector<MeshVertex> vertices;
        std::vector<std::uint32_t> indices;
    };
    [[nodiscard]] Unit unit(std::size_t patch, std::uint32_t unit) const;

    // Vertex `number` of a patch's pattern.
    [[nodiscard]] MeshVertex vertex(std::size_t patch, std::uint64_t number) const;

    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] const std::vector<MeshPatch>& patches() const { return patches_; }

private:
    Scene scene_;
    bool positionsOnly_ = false;
    std::vector<MeshPatch> patches_;
    MeshSizes sizes_;
};

}  // namespace tessera::test
