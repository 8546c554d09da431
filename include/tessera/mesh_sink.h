// What takes a mesh that is made piece by piece: a writer of files, say.
#pragma once

#include <cstdint>
#include <span>

#include "tessera/scene.h"
#include "tessera/tessellator.h"

namespace tessera {

struct mesh_pattern;

// A placed patch, and how it is tessellated (mesh/mesh_shared.h, mesh/pattern.h).
struct MeshPatch {
    std::uint32_t object = 0;  // index into Scene::objects
    std::uint32_t patch = 0;   // index into the object's mesh
};

// What is known before the first vertex is made: enough to lay out a file. Spans are valid until the stream's end.
struct MeshOutline {
    const Scene& scene;  // as set; the meshes' points are there
    bool positionsOnly = false;
    MeshSizes sizes;
    std::span<const MeshPatch> patches;      // all placed patches, in the order in which they are made; objects' patches follow each other
    std::span<const mesh_pattern> patterns;  // one each
};

// All of a pattern, or a part of one.
struct MeshUnit {
    std::uint32_t patch = 0;        // index into MeshOutline::patches
    std::uint32_t unit = 0;         // of the pattern, from 0 (mesh/pattern.h)
    std::uint64_t firstVertex = 0;  // in the piece
    std::uint64_t vertices = 0;
    std::uint64_t firstTriangle = 0;  // in the piece
    std::uint64_t triangles = 0;
};

struct MeshPiece {
    std::span<const MeshUnit> units;         // in order; over all pieces each unit comes once, patch after patch
    std::span<const MeshVertex> vertices;    // empty where positionsOnly
    std::span<const float> positions;        // three a vertex; empty unless positionsOnly
    std::span<const std::uint32_t> indices;  // three a triangle, into the piece's vertices
};

// Calls come from the thread that called Tessellator::stream(), begin() first. What they throw ends the stream.
class MeshSink {
public:
    virtual ~MeshSink() = default;
    virtual void begin(const MeshOutline& outline) = 0;
    virtual void take(const MeshPiece& piece) = 0;
};

}  // namespace tessera
