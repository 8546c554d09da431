// Files that `tessera tessellate` writes, as Assimp reads them, against the mesh that the library makes of the same scene.
#include "closed_models.h"
#include "mesh_kept.h"
#include "program_fixture.h"
#include "tessera/weld.h"
#include "written_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

// What Assimp reads of a file that the program wrote with these options.
struct FileCase {
    std::string file;
    std::vector<std::string> options;
    bool attributes = false;  // normals and (u, v) as well: where a format has them at vertices
    bool exact = true;        // else up to what Assimp loses of decimals
};

// Objects of all kinds, whose borders need records.
Scene solid() {
    Scene scene = placedAnyhow(mixedSolid(9, 2, {PatchKind::bezier, PatchKind::gregory, PatchKind::rational, PatchKind::pn}), 4);
    scene.name = "solid";
    return scene;
}

std::vector<Face> libraryFaces(double tolerance) {
    Scene scene = solid();
    weld(scene);
    Tessellator tessellator(meshTestSettings());
    tessellator.setScene(scene);
    TessellateOptions options;
    options.tolerance = tolerance;
    const KeptMesh mesh = keep(tessellator.tessellate(options));
    std::vector<Face> faces(mesh.indices.size() / 3);
    for (std::size_t k = 0; k < mesh.indices.size(); ++k) {
        const MeshVertex& vertex = mesh.vertices[mesh.indices[k]];
        Corner& corner = faces[k / 3].corners.emplace_back();
        std::copy_n(vertex.position, 3, corner.position.begin());
        std::copy_n(vertex.normal, 3, corner.normal.begin());
        corner.uv = {vertex.u, vertex.v};
    }
    return faces;
}

std::vector<Face> inTriangles(const std::vector<Face>& faces) {
    std::vector<Face> triangles;
    for (const Face& face : faces) {
        for (std::size_t k = 2; k < face.corners.size(); ++k)
            triangles.push_back({{face.corners[0], face.corners[k - 1], face.corners[k]}, 0, 0});
    }
    return triangles;
}

template <std::size_t Count>
double apart(const std::array<float, Count>& one, const std::array<float, Count>& other) {
    double most = 0.0;
    for (std::size_t k = 0; k < Count; ++k) most = std::max(most, std::abs(double{one[k]} - double{other[k]}));
    return most;
}

class ProgramMeshFiles : public Program {
protected:
    void expectMesh(const FileCase& is, const std::vector<Face>& expected) const {
        std::vector<std::string> arguments{"tessellate", "solid.mscene", "-o", is.file, "--tolerance", "0.01", "--quiet"};
        arguments.insert(arguments.end(), is.options.begin(), is.options.end());
        expectSuccess(run(arguments));
        const std::vector<Face> read = readWithAssimp(folder_.path() / is.file).faces;
        const bool quads = std::find(is.options.begin(), is.options.end(), "--quads") != is.options.end();
        EXPECT_EQ(quads, std::any_of(read.begin(), read.end(), [](const Face& face) { return face.corners.size() == 4; }));
        const std::vector<Face> triangles = inTriangles(read);
        ASSERT_EQ(triangles.size(), expected.size());
        double positions = 0.0, normals = 0.0, places = 0.0;
        for (std::size_t f = 0; f < expected.size(); ++f) {
            for (std::size_t c = 0; c < 3; ++c) {
                Corner corner = triangles[f].corners[c];
                // Assimp turns glTF's v about.
                if (is.file.ends_with("glb")) corner.uv[1] = 1.0F - corner.uv[1];
                const Corner& own = expected[f].corners[c];
                positions = std::max(positions, apart(corner.position, own.position));
                normals = std::max(normals, apart(corner.normal, own.normal));
                places = std::max(places, apart(corner.uv, own.uv));
            }
        }
        EXPECT_LE(positions, is.exact ? 0.0 : 2e-6);
        if (!is.attributes) return;
        EXPECT_LE(normals, is.exact ? 0.0 : 1e-6);
        // Twice taken from 1.
        EXPECT_LE(places, 1e-6);
    }
};

TEST_F(ProgramMeshFiles, HoldTheLibrarysMeshInEveryFormat) {
    const std::vector<FileCase> cases{{"k.ply", {}},
                                      {"k.ply", {"--no-weld"}, true},
                                      {"k.ply", {"--quads"}},
                                      {"k.ply", {"--positions-only"}},
                                      {"k.obj", {}, true, false},
                                      {"k.obj", {"--no-weld"}, true, false},
                                      {"k.obj", {"--quads"}, true, false},
                                      {"k.obj", {"--positions-only"}, false, false},
                                      {"k.stl", {}},
                                      {"k.stl", {"--positions-only"}},
                                      {"k.glb", {}, true},
                                      {"k.glb", {"--positions-only"}}};
    write("solid.mscene", solid());
    const std::vector<Face> expected = libraryFaces(0.01);
    ASSERT_GT(expected.size(), 2000U);
    for (const FileCase& is : cases) {
        SCOPED_TRACE(is.file + (is.options.empty() ? "" : " " + is.options.front()));
        expectMesh(is, expected);
    }
}

}  // namespace
}  // namespace tessera::test
