// Files of tessellated meshes: binary PLY, OBJ, binary STL and GLB 2.0, written while the mesh is made and never held in memory.
// All positions are in world space, all faces counter-clockwise seen from where their normals point to.
//     .ply  welded: vertices are positions; per face `vertex_indices`, `texcoord` (u, v a corner), `normals` (x, y, z a corner),
//           `object_id` and `patch_id` (indices into Scene::objects and its mesh). Not welded: all of it per vertex.
//     .obj  an `o` an object, a `g patch_N` a patch; welded positions with normals and (u, v) of their own.
//     .stl  triangles with their own normals; the format has no shared vertices, so welding says nothing.
//     .glb  a node and a mesh an object (no mesh where it has no triangles), POSITION, NORMAL, TEXCOORD_0 and _PATCH_ID. Its vertices have
//           one normal each, so patches keep theirs apart (seams) but for `positionsOnly`, where an object's are welded. A normal of 0,
//           where the surface has none, is written as (0, 0, 1), for the format takes unit vectors alone.
// (u, v) are a patch's own, or where its mesh has texture coordinates these (tessera/texture.h); of GLB these with 1 - v, for its pictures
// begin at the upper left.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "tessera/mesh_sink.h"

namespace tessera {

struct MeshFileOptions {
    bool weld = true;            // share vertices by position (mesh/weld_numbers.h), where the format can
    bool quads = false;          // inner cells of patches as faces of four corners: PLY and OBJ
    bool positionsOnly = false;  // no normals, (u, v) and ids
};

// begin() throws Error, before it leaves anything on the disk, where the format cannot hold so much, where the space is short or the file
// cannot be made, and where the mesh has positions only but the file needs more; take() and finish() where writing fails. Unless finish()
// returned, no file is left behind and an older one stays as it was.
class MeshWriter : public MeshSink {
public:
    // After the stream's end: completes the file and gives it its name.
    virtual void finish() = 0;
    // Whether TessellateOptions::positionsOnly will do for this file.
    [[nodiscard]] virtual bool positionsSuffice() const = 0;

    // Of the file, final after finish().
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    [[nodiscard]] std::uint64_t vertices() const { return vertices_; }    // positions; of STL three a triangle
    [[nodiscard]] std::uint64_t triangles() const { return triangles_; }  // faces of three corners
    [[nodiscard]] std::uint64_t quads() const { return quads_; }          // faces of four

protected:
    std::uint64_t bytes_ = 0;
    std::uint64_t vertices_ = 0;
    std::uint64_t triangles_ = 0;
    std::uint64_t quads_ = 0;
};

// By the path's ending, in upper or lower case. Throws Error on other endings, on quads for STL or GLB, and on a path that cannot be
// written to. Makes no file yet.
[[nodiscard]] std::unique_ptr<MeshWriter> makeMeshWriter(const std::filesystem::path& path, const MeshFileOptions& options);

}  // namespace tessera
