// Mesh files of every format against the mesh that they were made of, and as Assimp reads them.
#include "formats/mesh_writer.h"

#include "closed_models.h"
#include "mesh/pattern.h"
#include "output_folder.h"
#include "tessera/texture.h"
#include "tessera/weld.h"
#include "written_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

using Positions = std::set<std::array<float, 3>>;

Positions positionsOf(const std::vector<Face>& faces) {
    Positions positions;
    for (const Face& face : faces)
        for (const Corner& corner : face.corners) positions.insert(corner.position);
    return positions;
}

// A closed solid of three objects of several kinds, with records, of one place; two patches of it in parts; names that are no words. Its
// patches lie any way round, so that neighbours may turn against each other. `textured`: all but the first mesh have texture nets.
HostMesh solid(bool positionsOnly = false, bool textured = false) {
    const std::vector<PatchKind> kinds{PatchKind::bezier, PatchKind::pn, PatchKind::rational};
    Scene scene = placedAnyhow(mixedSolid(3, 2, kinds), 5);
    static_cast<void>(weld(scene, 1e-5));
    std::mt19937 random(3);
    std::uniform_real_distribution<float> coordinate(-2.0F, 3.0F);
    for (std::size_t m = 1; m < scene.meshes.size() && textured; ++m) {
        Mesh& mesh = scene.meshes[m];
        for (std::size_t k = 0; k < 16 * mesh.patchCount(); ++k) mesh.textureNets.emplace_back(coordinate(random), coordinate(random));
    }
    scene.objects[0].name = "first \"part\"\\\n\xC3\xA4";
    scene.objects[1].name = "";
    HostMesh mesh(scene, 5.0, 4, positionsOnly);
    const auto cut = [&](std::uint32_t form, std::uint32_t cells) {
        mesh_pattern& pattern = *std::find_if(mesh.patterns.begin(), mesh.patterns.end(), [&](const auto& p) { return p.form == form; });
        pattern.cells_u = cells;
        pattern.cells_v = form == MESH_RING ? cells - 5 : 0;
        constexpr std::uint32_t one = 1U << 24U, rim = one / 100;
        pattern.low_u = pattern.low_v = rim;
        pattern.high_u = pattern.high_v = one - rim;
    };
    cut(MESH_RING, 90);
    cut(MESH_TRIANGLE_RING, 110);
    mesh.finish();
    return mesh;
}

class MeshFiles : public OutputFolder {
protected:
    // Writes the mesh in pieces of so many units.
    std::filesystem::path write(const HostMesh& mesh, const std::string& name, const MeshFileOptions& options, std::size_t units = 3) {
        std::filesystem::path path = file(name);
        std::filesystem::remove(path);
        const auto writer = makeMeshWriter(path, options);
        writer->begin(mesh.outline());
        mesh.stream(*writer, [units](std::size_t) { return units; });
        EXPECT_FALSE(std::filesystem::exists(path));
        writer->finish();
        EXPECT_EQ(writer->bytes(), std::filesystem::file_size(path));
        vertices_ = writer->vertices();
        triangles_ = writer->triangles();
        quads_ = writer->quads();
        return path;
    }

    void expectCounts(const WrittenMesh& mesh) const {
        EXPECT_EQ(vertices_, mesh.vertices);
        EXPECT_EQ(triangles_ + quads_, mesh.faces.size());
        const auto four = std::count_if(mesh.faces.begin(), mesh.faces.end(), [](const Face& face) { return face.corners.size() == 4; });
        EXPECT_EQ(quads_, static_cast<std::uint64_t>(four));
    }

    std::uint64_t vertices_ = 0, triangles_ = 0, quads_ = 0;
};

std::vector<Face> sorted(std::vector<Face> faces) {
    std::sort(faces.begin(), faces.end());
    return faces;
}

TEST_F(MeshFiles, WeldedPlyIsClosedAndHoldsEveryCorner) {
    const HostMesh mesh = solid();
    const WrittenMesh read = readPly(write(mesh, "a.PLY", {}));
    expectCounts(read);
    EXPECT_TRUE(read.faces == facesOf(mesh, false, true, true));
    EXPECT_EQ(openEdges(read.faces), 0U);
    EXPECT_EQ(read.vertices, positionsOf(read.faces).size());
}

TEST_F(MeshFiles, NeighboursTurnAlikeInEveryFormat) {
    std::size_t checked = 0;
    for (const ClosedModel& model : closedModels()) {
        if (model.name != "sphere" && model.name != "torus" && model.name != "pn_creased") continue;
        const HostMesh mesh(model.scene, 6.0, 5);
        ++checked;
        EXPECT_EQ(openOrTurnedEdges(readPly(write(mesh, "a.ply", {})).faces), 0U);
        EXPECT_EQ(openOrTurnedEdges(readObj(write(mesh, "a.obj", {.positionsOnly = true})).faces), 0U);
        EXPECT_EQ(openOrTurnedEdges(readWithAssimp(write(mesh, "a.stl", {})).faces), 0U);
        EXPECT_EQ(openOrTurnedEdges(readWithAssimp(write(mesh, "a.glb", {})).faces), 0U);
        EXPECT_EQ(openOrTurnedEdges(readPly(write(mesh, "a.ply", {.quads = true})).faces), 0U);
    }
    EXPECT_EQ(checked, 3U);
}

TEST_F(MeshFiles, QuadsAreTheCellsInPlyAndObj) {
    const HostMesh mesh = solid();
    const std::vector<Face> expected = facesOf(mesh, true, true, true);
    const WrittenMesh ply = readPly(write(mesh, "a.ply", {.quads = true}));
    expectCounts(ply);
    EXPECT_GT(quads_, 88U * 83U - 1);
    EXPECT_TRUE(ply.faces == expected);
    EXPECT_EQ(openEdges(ply.faces), 0U);
    const WrittenMesh obj = readObj(write(mesh, "a.obj", {.quads = true}));
    expectCounts(obj);
    EXPECT_TRUE(sorted(obj.faces) == sorted(expected));
}

TEST_F(MeshFiles, PlyWithoutWeldingHoldsAllOfAVertex) {
    const HostMesh mesh = solid();
    const WrittenMesh read = readPly(write(mesh, "a.ply", {.weld = false}));
    expectCounts(read);
    EXPECT_TRUE(read.faces == facesOf(mesh, false, true, true));
    EXPECT_EQ(read.vertices, mesh.outline().sizes.distinctVertices);
}

TEST_F(MeshFiles, ObjSharesPositionsAndNamesNothingBeforeItStandsThere) {
    const HostMesh mesh = solid();
    for (const bool weld : {true, false}) {
        const WrittenMesh read = readObj(write(mesh, "a.obj", {.weld = weld}));
        expectCounts(read);
        EXPECT_TRUE(sorted(read.faces) == sorted(facesOf(mesh, false, true, true)));
        EXPECT_EQ(read.vertices, weld ? positionsOf(read.faces).size() : mesh.outline().sizes.distinctVertices);
    }
    const std::string text = bytesOf(file("a.obj"));
    EXPECT_NE(text.find("\no first_\"part\"__\xC3\xA4\n"), std::string::npos);
    EXPECT_NE(text.find("\no object_1\n"), std::string::npos);
}

TEST_F(MeshFiles, StlHoldsTheTrianglesWithTheirOwnNormals) {
    for (const bool positionsOnly : {false, true}) {
        const HostMesh mesh = solid(positionsOnly);
        WrittenMesh read = readStl(write(mesh, "a.stl", {}));
        expectCounts(read);
        std::size_t wrong = 0;
        for (Face& face : read.faces) {
            std::array<glm::dvec3, 3> p{};
            for (std::size_t c = 0; c < 3; ++c)
                p[c] = {face.corners[c].position[0], face.corners[c].position[1], face.corners[c].position[2]};
            const glm::dvec3 n = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
            const std::array<float, 3>& stored = face.corners[0].normal;
            if (!(glm::length(n - glm::dvec3(stored[0], stored[1], stored[2])) < 1e-6)) ++wrong;
            for (Corner& corner : face.corners) corner.normal = {};
        }
        EXPECT_EQ(wrong, 0U);
        EXPECT_TRUE(read.faces == facesOf(mesh, false, false, false));
    }
}

TEST_F(MeshFiles, GlbKeepsSeamsAndIsValid) {
    const HostMesh mesh = solid();
    const WrittenMesh read = readGlb(write(mesh, "a.glb", {}));
    expectCounts(read);
    EXPECT_TRUE(read.faces == facesOf(mesh, false, true, true));
    EXPECT_EQ(read.vertices, mesh.outline().sizes.distinctVertices);
}

TEST_F(MeshFiles, PositionsOnlyWeldsGlbByObject) {
    for (const bool madeSo : {false, true}) {
        const HostMesh mesh = solid(madeSo);
        const WrittenMesh read = readGlb(write(mesh, "a.glb", {.positionsOnly = true}));
        expectCounts(read);
        const std::vector<Face> expected = facesOf(mesh, false, false, true);
        EXPECT_TRUE(read.faces == expected);
        std::size_t shared = 0;
        for (std::uint32_t object = 0; object < mesh.scene().objects.size(); ++object) {
            std::vector<Face> own;
            std::copy_if(expected.begin(), expected.end(), std::back_inserter(own), [&](const Face& f) { return f.object == object; });
            shared += positionsOf(own).size();
        }
        EXPECT_EQ(read.vertices, shared);
    }
}

TEST_F(MeshFiles, PositionsOnlyLeavesOutTheRest) {
    for (const bool madeSo : {false, true}) {
        const HostMesh mesh = solid(madeSo);
        const std::vector<Face> expected = facesOf(mesh, false, false, false);
        EXPECT_TRUE(readPly(write(mesh, "a.ply", {.positionsOnly = true})).faces == expected);
        std::vector<Face> obj = readObj(write(mesh, "a.obj", {.positionsOnly = true})).faces;
        for (Face& face : obj) face.object = 0;
        EXPECT_TRUE(sorted(obj) == sorted(expected));
        EXPECT_EQ(bytesOf(file("a.obj")).find("vn"), std::string::npos);
    }
}

TEST_F(MeshFiles, PiecesOfAnyCutGiveTheSameBytes) {
    const HostMesh mesh = solid();
    for (const std::string name : {"a.ply", "a.obj", "a.stl", "a.glb"}) {
        for (const bool weld : {true, false}) {
            const std::string whole = bytesOf(write(mesh, name, {.weld = weld}, 1000000));
            EXPECT_TRUE(bytesOf(write(mesh, name, {.weld = weld}, 1)) == whole) << name;
            EXPECT_TRUE(bytesOf(write(mesh, name, {.weld = weld}, 7)) == whole) << name;
        }
    }
}

TEST_F(MeshFiles, ObjectsOutsideTheViewHaveANodeAndNoMesh) {
    HostMesh mesh = solid();
    for (std::size_t patch = 0; patch < mesh.patterns.size(); ++patch)
        if (mesh.patches()[patch].object == 1) mesh.patterns[patch] = {};
    mesh.finish();
    EXPECT_TRUE(readGlb(write(mesh, "a.glb", {})).faces == facesOf(mesh, false, true, true));
    EXPECT_TRUE(readPly(write(mesh, "a.ply", {})).faces == facesOf(mesh, false, true, true));
}

TEST_F(MeshFiles, TextureNetsGiveTheCoordinates) {
    const HostMesh mesh = solid(false, true);
    for (const bool weld : {true, false}) {
        for (const std::string name : {"a.ply", "a.obj", "a.glb"}) {
            std::vector<Face> expected = facesOf(mesh, false, true, true);
            std::size_t changed = 0;
            for (Face& face : expected) {
                const Mesh& own = *mesh.scene().findMesh(mesh.scene().objects[face.object].mesh);
                if (own.textureNets.empty()) continue;
                ++changed;
                for (Corner& corner : face.corners) {
                    const glm::vec2 texture = textureAt(own, face.patch, corner.uv[0], corner.uv[1]);
                    // Pictures of this format begin at their upper left.
                    corner.uv = {texture.x, name == "a.glb" ? 1.0F - texture.y : texture.y};
                }
            }
            EXPECT_GT(changed, 100U);
            EXPECT_LT(changed, expected.size());
            const std::filesystem::path path = write(mesh, name, {.weld = weld});
            const WrittenMesh read = name == "a.ply" ? readPly(path) : name == "a.obj" ? readObj(path) : readGlb(path);
            EXPECT_TRUE(sorted(read.faces) == sorted(expected)) << name;
        }
    }
}

TEST_F(MeshFiles, AMeshOfNothingIsAFileOfNothing) {
    HostMesh mesh = solid();
    for (mesh_pattern& pattern : mesh.patterns) pattern = {};
    mesh.finish();
    EXPECT_TRUE(readPly(write(mesh, "a.ply", {})).faces.empty());
    EXPECT_TRUE(readObj(write(mesh, "a.obj", {})).faces.empty());
    EXPECT_TRUE(readStl(write(mesh, "a.stl", {})).faces.empty());
    EXPECT_TRUE(readGlb(write(mesh, "a.glb", {})).faces.empty());
}

TEST_F(MeshFiles, NormalsOfZeroAreUnitVectorsInGlb) {
    const HostMesh mesh(placedAnyhow({polarSolid(4, 4, 3)}, 5), 4.0, 4);
    HostMesh::Unit unit = mesh.unit(0, 0);
    for (MeshVertex& vertex : unit.vertices) std::fill_n(vertex.normal, 3, 0.0F);
    MeshOutline outline = mesh.outline();
    outline.patches = outline.patches.first(1);
    outline.patterns = outline.patterns.first(1);
    outline.sizes = {1, 0, 1, unit.vertices.size(), unit.vertices.size(), unit.indices.size() / 3, 0, 0};
    const auto writer = makeMeshWriter(file("a.glb"), {});
    writer->begin(outline);
    const MeshUnit all{0, 0, 0, unit.vertices.size(), 0, unit.indices.size() / 3};
    writer->take({{&all, 1}, unit.vertices, {}, unit.indices});
    writer->finish();
    for (const Face& face : readGlb(file("a.glb")).faces)
        for (const Corner& corner : face.corners) EXPECT_EQ(corner.normal, (std::array<float, 3>{0.0F, 0.0F, 1.0F}));
}

TEST_F(MeshFiles, AssimpReadsEveryFormat) {
    const HostMesh mesh = solid();
    const std::vector<Face> expected = facesOf(mesh, false, true, false);
    for (const std::string name : {"a.ply", "a.obj", "a.stl", "a.glb"}) {
        std::vector<Face> faces = readWithAssimp(write(mesh, name, {.weld = name != "a.ply"})).faces;
        ASSERT_EQ(faces.size(), expected.size()) << name;
        std::vector<Face> own = expected;
        for (std::size_t f = 0; f < faces.size(); ++f) {
            own[f].patch = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                Corner& read = faces[f].corners[c];
                if (name == "a.stl") own[f].corners[c].normal = read.normal = {};
                if (name == "a.stl") own[f].corners[c].uv = read.uv = {};
                // Assimp turns glTF's v about.
                if (name == "a.glb") own[f].corners[c].uv[1] = 1.0F - own[f].corners[c].uv[1];
            }
        }
        EXPECT_EQ(openEdges(faces), 0U) << name;
        // Its own reading of decimals is off by some last places.
        if (name == "a.obj") continue;
        EXPECT_TRUE(sorted(faces) == sorted(own)) << name;
    }
}

TEST_F(MeshFiles, AssimpReadsWeldedPlyAndObjWithTheirShapes) {
    const HostMesh mesh = solid();
    const std::vector<Face> expected = facesOf(mesh, false, true, false);
    const WrittenMesh ply = readWithAssimp(write(mesh, "a.ply", {}));
    ASSERT_EQ(ply.faces.size(), expected.size());
    EXPECT_EQ(openEdges(ply.faces), 0U);
    for (std::size_t f = 0; f < expected.size(); ++f)
        for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(ply.faces[f].corners[c].position, expected[f].corners[c].position);
    // Faces of patches in parts are elsewhere in OBJ; sums of all do not mind.
    const std::vector<Face> obj = readWithAssimp(write(mesh, "a.obj", {})).faces;
    ASSERT_EQ(obj.size(), expected.size());
    std::array<double, 8> difference{};
    for (std::size_t f = 0; f < expected.size(); ++f) {
        for (std::size_t c = 0; c < 3; ++c) {
            const Corner &a = obj[f].corners[c], &b = expected[f].corners[c];
            for (std::size_t k = 0; k < 3; ++k) difference[k] += double{a.position[k]} - double{b.position[k]};
            for (std::size_t k = 0; k < 3; ++k) difference[3 + k] += double{a.normal[k]} - double{b.normal[k]};
            for (std::size_t k = 0; k < 2; ++k) difference[6 + k] += double{a.uv[k]} - double{b.uv[k]};
        }
    }
    for (const double d : difference) EXPECT_NEAR(d, 0.0, 1e-6 * static_cast<double>(expected.size()));
}

}  // namespace
}  // namespace tessera::test
