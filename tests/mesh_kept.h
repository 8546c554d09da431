// Meshes that tests keep, and whether they are closed.
#pragma once

#include "tessera/mesh_sink.h"
#include "tessera/tessellator.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tessera::test {

struct KeptMesh {
    std::vector<MeshVertex> vertices;
    std::vector<std::uint32_t> indices;  // three a triangle
};

// A mesh of whole vertices or of positions, the rest of whose vertices is 0 then.
[[nodiscard]] KeptMesh keep(const DeviceMesh& mesh, bool positionsOnly = false);

// Puts pieces together as one mesh, as a DeviceMesh would be.
class KeepingSink : public MeshSink {
public:
    void begin(const MeshOutline& outline) override;
    void take(const MeshPiece& piece) override;

    KeptMesh mesh;
    MeshSizes sizes;
    std::vector<MeshUnit> units;  // as handed, counting from the whole mesh's first vertex and triangle
    std::size_t pieces = 0;
};

// The default device, kernels kept in $TESSERA_CACHE or, without it, in the build folder.
[[nodiscard]] RendererSettings meshTestSettings();

// Expects the same bits everywhere.
void expectSameMesh(const KeptMesh& one, const KeptMesh& other);

// What is wrong with a mesh whose vertices are welded by position, to the bit (-0 is 0).
struct Closedness {
    std::size_t vertices = 0;  // after welding
    std::size_t triangles = 0;
    std::size_t edges = 0;
    std::size_t openEdges = 0;     // used by just one triangle
    std::size_t crossedEdges = 0;  // used by two triangles the same way round
    std::size_t crowdedEdges = 0;  // used by three triangles or more
    std::size_t degenerate = 0;    // triangles with two corners in one place
    std::size_t pinched = 0;       // vertices whose triangles are more than one fan

    [[nodiscard]] bool closed() const { return openEdges + crossedEdges + crowdedEdges + degenerate + pinched == 0; }
    [[nodiscard]] long euler() const { return static_cast<long>(vertices) - static_cast<long>(edges) + static_cast<long>(triangles); }
    [[nodiscard]] std::string text() const;
};

[[nodiscard]] Closedness closedness(const KeptMesh& mesh);

}  // namespace tessera::test
