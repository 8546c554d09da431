// Cages in files: every format gives the same one, tags and all; what is malformed is an Error of one line, of OBJ files with the line.
#include "cage_file_samples.h"
#include "formats/mscene.h"
#include "mscene_samples.h"
#include "output_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tessera {
namespace {

Scene parse(std::string_view text, const std::string& name, std::optional<SubdivisionScheme> scheme = std::nullopt,
            std::vector<std::string>* warnings = nullptr) {
    return parseCageFile(bytesOf(text), name, scheme, warnings);
}

std::string cageComplaint(std::string_view text, const std::string& name, std::optional<SubdivisionScheme> scheme = std::nullopt) {
    try {
        static_cast<void>(parse(text, name, scheme));
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

// Faces as places in space, which do not depend on the points' numbers.
using Place = std::array<float, 3>;
Place placeOf(const Cage& cage, std::uint32_t vertex) { return {cage.points[vertex].x, cage.points[vertex].y, cage.points[vertex].z}; }

std::vector<std::vector<Place>> facesOf(const Cage& cage) {
    std::vector<std::vector<Place>> faces;
    std::size_t corner = 0;
    for (const std::uint32_t size : cage.faceSizes) {
        std::vector<Place>& face = faces.emplace_back();
        for (std::uint32_t k = 0; k < size; ++k) face.push_back(placeOf(cage, cage.faceVertices[corner++]));
    }
    return faces;
}

std::set<std::pair<std::set<Place>, float>> creasesOf(const Cage& cage) {
    std::set<std::pair<std::set<Place>, float>> creases;
    for (const Crease& one : cage.creases) creases.insert({{placeOf(cage, one.a), placeOf(cage, one.b)}, one.sharpness});
    return creases;
}

std::set<std::pair<Place, float>> cornersOf(const Cage& cage) {
    std::set<std::pair<Place, float>> corners;
    for (const Corner& one : cage.corners) corners.insert({placeOf(cage, one.vertex), one.sharpness});
    return corners;
}

void expectFaces(const Cage& read, const Cage& wanted) {
    EXPECT_EQ(read.points.size(), wanted.points.size());
    EXPECT_EQ(facesOf(read), facesOf(wanted));
}

void expectSame(const Cage& read, const Cage& wanted) {
    expectFaces(read, wanted);
    EXPECT_EQ(read.scheme, wanted.scheme);
    EXPECT_EQ(read.boundary, wanted.boundary);
    EXPECT_EQ(creasesOf(read), creasesOf(wanted));
    EXPECT_EQ(cornersOf(read), cornersOf(wanted));
    EXPECT_EQ(read.holes, wanted.holes);
}

TEST(CageFiles, EveryFormatGivesTheSameCage) {
    Scene stored;
    stored.cages.push_back(sampleCage());
    const std::string gltf = cageGltfText(cageExtension());
    const std::vector<std::pair<std::string, Scene>> scenes{{"obj", parse(cageObjText(), "file.obj")},
                                                            {"gltf", parse(gltf, "file.gltf")},
                                                            {"glb", parse(cageGlb(cageExtension()), "file.glb")},
                                                            {"mscene", parseMscene(serializeMscene(stored), "file")}};
    for (const auto& [format, scene] : scenes) {
        SCOPED_TRACE(format);
        ASSERT_EQ(scene.cages.size(), 1U);
        expectSame(scene.cages[0], sampleCage());
        EXPECT_EQ(scene.cages[0].name, "box");
    }
    // Formats without tags: the polygons alone.
    const Scene ply = parse(cagePlyText(), "file.ply", SubdivisionScheme::bilinear);
    ASSERT_EQ(ply.cages.size(), 1U);
    expectFaces(ply.cages[0], sampleCage());
    EXPECT_EQ(ply.cages[0].scheme, SubdivisionScheme::bilinear);
    EXPECT_EQ(ply.objects.size(), 1U);
}

TEST(CageFiles, ObjKeepsTheFilesNumbers) {
    const Scene scene = parse(cageObjText(), "file.obj");
    EXPECT_EQ(scene.cages[0].points, sampleCage().points);
    EXPECT_EQ(scene.cages[0].faceVertices, sampleCage().faceVertices);
    ASSERT_EQ(scene.objects.size(), 1U);
    EXPECT_EQ(scene.objects[0].mesh, "box");
    EXPECT_EQ(scene.objects[0].color, glm::vec3(1.0F));
}

TEST(CageFiles, WithoutSchemeOrTagsPolygonsAreTriangles) {
    for (const auto& [name, text] : meshFileSamples()) {
        const Scene scene = parse(text, name);
        EXPECT_TRUE(scene.cages.empty()) << name;
        EXPECT_EQ(scene.meshes.front().kind, PatchKind::pn) << name;
        const Scene loop = parse(text, name, SubdivisionScheme::loop);
        ASSERT_FALSE(loop.cages.empty()) << name;
        EXPECT_TRUE(loop.meshes.empty()) << name;
        EXPECT_EQ(loop.cages[0].scheme, SubdivisionScheme::loop) << name;
    }
}

TEST(CageFiles, PrimitivesWithoutTheExtensionStayTriangles) {
    const Scene scene = parse(cageGltfText(cageExtension()), "file.gltf");
    ASSERT_EQ(scene.meshes.size(), 1U);
    EXPECT_EQ(scene.meshes[0].name, "plain");
    const Scene all = parse(cageGltfText(cageExtension()), "file.gltf", SubdivisionScheme::loop);
    EXPECT_EQ(all.cages.size(), 2U);
    EXPECT_TRUE(all.meshes.empty());
    for (const Cage& cage : all.cages) EXPECT_EQ(cage.scheme, SubdivisionScheme::loop);
}

// Corners shared by normals alone, or not at all, are one vertex in a cage.
TEST(CageFiles, PointsEqualToTheBitBecomeOne) {
    const Scene scene = parse(cageGltfText(R"("TESSERA_subdivision_surface":{})"), "file.gltf");
    ASSERT_EQ(scene.cages.size(), 1U);
    EXPECT_EQ(scene.cages[0].points.size(), 9U);
    EXPECT_EQ(scene.cages[0].faceCount(), 14U);  // triangles of a glTF without polygon sizes
    EXPECT_TRUE(scene.cages[0].creases.empty());
}

TEST(CageFiles, FbNgonEncodingMakesPolygonsOfTriangles) {
    const std::string text =
        cageGltfText(R"("FB_ngon_encoding":{},"TESSERA_subdivision_surface":{})", R"("extensionsUsed":["FB_ngon_encoding"],)");
    const Scene scene = parse(text, "file.gltf");
    ASSERT_EQ(scene.cages.size(), 1U);
    expectFaces(scene.cages[0], sampleCage());
    // Also without the other extension, where a scheme is asked for.
    const std::string alone = cageGltfText(R"("FB_ngon_encoding":{})");
    EXPECT_TRUE(parse(alone, "file.gltf").cages.empty());
    expectFaces(parse(alone, "file.gltf", SubdivisionScheme::bilinear).cages.at(1), sampleCage());
}

TEST(CageFiles, ScaledAndMirroredNodesKeepTheOutsideOutside) {
    std::string text = cageGltfText(cageExtension());
    text.replace(text.find(R"({"mesh":1,"name":"placed"})"), 26, R"({"mesh":1,"name":"placed","scale":[-2,1,1]})");
    const Scene scene = parse(text, "file.gltf");
    const Cage wanted = sampleCage();
    const Cage& read = scene.cages.at(0);
    const auto read0 = facesOf(read)[3], wanted0 = facesOf(wanted)[3];
    ASSERT_EQ(read0.size(), wanted0.size());
    for (std::size_t k = 0; k < read0.size(); ++k) {
        const Place& other = wanted0[(wanted0.size() - k) % wanted0.size()];
        EXPECT_EQ(read0[k], (Place{-2.0F * other[0] + 0.0F, other[1], other[2]})) << k;
    }
}

TEST(CageFiles, TexturePointsAreThoseOfTheCorners) {
    const std::string text =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nvt 0.25\n"
        "f 1/1 2/2 3/3/1 4/-2\nf 2/5 5/2 6/3 3/4\nt corner 0/0/0\n";
    const Cage cage = parse(text, "file.obj").cages.at(0);
    ASSERT_EQ(cage.faceTexturePoints, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 1, 2, 3}));
    EXPECT_EQ(cage.texturePoints[4], glm::vec2(0.25F, 0.0F));
    std::vector<std::string> warnings;
    std::string partly = text;
    partly.replace(partly.find("2/5"), 3, "2");
    EXPECT_TRUE(parse(partly, "file.obj", std::nullopt, &warnings).cages.at(0).texturePoints.empty());
    EXPECT_EQ(warnings.size(), 1U);
}

TEST(CageFiles, ObjectsOfAnObjTakeTheirOwnVerticesAndTags) {
    const std::string text =
        "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\no b\nv 2 0 0\nv 2 1 0\nf 2 5 6 3\nf 2 6 3\n"
        "t crease 6/3/0 1 2 4 5 0 5 1 2 3\nt corner 2/1/0 4 0 4\nt hole 1/0/0 2\n";
    std::vector<std::string> warnings;
    const Scene scene = parse(text, "file.obj", std::nullopt, &warnings);
    ASSERT_EQ(scene.cages.size(), 2U);
    const Cage &a = scene.cages[0], &b = scene.cages[1];
    EXPECT_EQ(a.points.size(), 4U);
    EXPECT_EQ(b.points.size(), 4U);
    EXPECT_EQ(creasesOf(a), (std::set<std::pair<std::set<Place>, float>>{{{{1, 0, 0}, {1, 1, 0}}, 1.0F}}));
    EXPECT_EQ(creasesOf(b), (std::set<std::pair<std::set<Place>, float>>{{{{1, 0, 0}, {1, 1, 0}}, 1.0F}, {{{2, 0, 0}, {2, 1, 0}}, 2.0F}}));
    EXPECT_EQ(cornersOf(a), (std::set<std::pair<Place, float>>{{{0, 0, 0}, 4.0F}}));
    EXPECT_EQ(cornersOf(b), (std::set<std::pair<Place, float>>{{{2, 0, 0}, 4.0F}}));
    EXPECT_TRUE(a.holes.empty());
    EXPECT_EQ(b.holes, std::vector<std::uint32_t>{1});
    ASSERT_EQ(warnings.size(), 1U);  // the crease from 0 to 5 is on no edge
    EXPECT_NE(warnings[0].find("creases left out"), std::string::npos);
}

TEST(CageFiles, FacesThatCannotBePlacedAreLeftOut) {
    std::vector<std::string> warnings;
    const Scene scene = parse("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 nan 0\nv 0 2 0\nf 1 2 3 4\nf 1 2 3 5\nt hole 2/0/0 0 1\n", "file.obj",
                              std::nullopt, &warnings);
    EXPECT_EQ(scene.cages.at(0).faceSizes, std::vector<std::uint32_t>{4});
    EXPECT_EQ(scene.cages[0].faceVertices, (std::vector<std::uint32_t>{0, 1, 2, 4}));
    EXPECT_EQ(scene.cages[0].holes, std::vector<std::uint32_t>{0});
    EXPECT_EQ(warnings.size(), 1U);
}

class CageFolder : public test::OutputFolder {};

TEST_F(CageFolder, ObjColoursAreThoseOfMostFaces) {
    std::ofstream(file("colors.mtl")) << mtlText();
    std::ofstream(file("file.obj"))
        << "mtllib colors.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl red\nf 1 2 3\nusemtl green\nf 3 2 1\nf 1 3 2\n";
    std::vector<std::string> warnings;
    const Scene scene = readCageFile(file("file.obj"), SubdivisionScheme::loop, &warnings);
    EXPECT_EQ(scene.objects.at(0).color, glm::vec3(0.0F, 0.5F, 0.25F));
    EXPECT_EQ(warnings.size(), 1U);
    std::ofstream(file("outside.obj")) << "mtllib ../colors.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl red\nf 1 2 3\n";
    EXPECT_EQ(readCageFile(file("outside.obj"), SubdivisionScheme::loop).objects.at(0).color, glm::vec3(1.0F));
}

TEST(CageFiles, MalformedObjNamesTheLine) {
    const std::string start = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
    const std::vector<std::pair<std::string, std::string>> texts{
        {"v 0 0\n", "line 4: a vertex has three coordinates"},
        {"v 0 x 0\n", "line 4: 'x' is no number"},
        {"v 0 0 1e999\n", "line 4: '1e999' is no number"},
        {"f\n", "line 4: a face without corners"},
        {"\n\nf 1 2 \\\n0\n", "line 6: '0' is no number of a corner"},
        {"f 1 2 4\n", "line 4: vertex number 3, counted from 0, is none of 3"},
        {"f 1 2 -4\n", "line 4: corner '-4' lies before the first of 3"},
        {"f 1/1 2/1 3/1\n", "line 4: texture point number 0"},
        {"f 1 2 99999999999999999999\n", "line 4: '99999999999999999999'"},
        {"f 1 2 3\nt crease 2/1/0 0 7 1\n", "line 5: vertex number 7"},
        {"f 1 2 3\nt crease 3/1/0 0 1 2 1\n", "line 5: a crease tag has two vertices"},
        {"f 1 2 3\nt crease 2/1/0 0 1\n", "line 5: tag 'crease' announces 2/1/0 values and has 2"},
        {"f 1 2 3\nt crease 9223372036854775807/9223372036854775807/2 0\n", "line 5: tag 'crease' announces"},
        {"f 1 2 3\nt crease 2/1 0 1 2\n", "line 5: '2/1' is no INTS/FLOATS/STRINGS"},
        {"f 1 2 3\nt crease 2/1/0 0 1 -1\n", "line 5: sharpness -1"},
        {"f 1 2 3\nt crease 4/3/0 0 1 1 2 1 1 1\n", "line 5: tag 'crease' has 3 sharpnesses for 2"},
        {"f 1 2 3\nt corner 1/1/0 -1 1\n", "line 5: '-1' is no number in a tag"},
        {"f 1 2 3\nt hole 1/0/0 1\n", "line 5: face number 1"},
        {"f 1 2 3\nt interpolateboundary 1/0/0 3\n", "line 5: interpolateboundary is 0, 1 or 2"},
        {"t\n", "line 4: a tag is"},
        {"", "there is no face in it"},
    };
    for (const auto& [text, said] : texts) {
        const std::string message = cageComplaint(start + text, "file.obj", SubdivisionScheme::catmullClark);
        EXPECT_TRUE(message.starts_with("file.obj: " + said)) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
}

TEST(CageFiles, MalformedExtensionsNameMeshAndMember) {
    const std::vector<std::pair<std::string, std::string>> members{
        {R"("scheme":"doo-sabin")", ".scheme: is none of catmull-clark, loop, bilinear"},
        {R"("boundary":1)", ".boundary: is none of"},
        {R"("creases":{})", ".creases: is no array"},
        {R"("creases":[[0,1]])", ".creases: has an item that is no [a, b, sharpness]"},
        {R"("creases":[[0,18,1]])", ".creases: has a number that is not whole or not within 0 to 17"},
        {R"("creases":[[0,-1,1]])", ".creases: has a number"},
        {R"("creases":[[0,1,-0.5]])", ".creases: has a sharpness"},
        {R"("corners":[[0.5,1]])", ".corners: has a number"},
        {R"("faceSizes":[4],"faceVertices":[0,1,2])", ".faceSizes: sums up to 4, and faceVertices are 3"},
        {R"("faceVertices":[0,1,18])", ".faceVertices: has a number"},
        {R"("holes":["a"])", ".holes: has a number"},
    };
    for (const auto& [member, said] : members) {
        const std::string message = cageComplaint(cageGltfText(R"("TESSERA_subdivision_surface":{)" + member + "}"), "file.gltf");
        EXPECT_TRUE(message.starts_with("file.gltf: mesh number 1, primitive 0, TESSERA_subdivision_surface" + said)) << message;
    }
    EXPECT_NE(cageComplaint(cageGltfText(R"("TESSERA_subdivision_surface":{"holes":[14]})"), "file.gltf").find("hole 14 is none of its 14"),
              std::string::npos);
    const std::string deep = R"({"TESSERA_subdivision_surface":)" + std::string(100000, '[') + std::string(100000, ']') + "}";
    EXPECT_NE(cageComplaint(deep, "file.gltf").find("nested"), std::string::npos);
}

TEST(CageFiles, MsceneKeepsEveryFieldAndRefusesWhatIsNone) {
    Scene scene = richScene();
    for (const auto scheme :
         {SubdivisionScheme::catmullClark, SubdivisionScheme::loop, SubdivisionScheme::bilinear, SubdivisionScheme::none}) {
        Cage cage = sampleCage();
        cage.name = name(scheme);
        cage.scheme = scheme;
        cage.boundary = static_cast<BoundaryRule>(scene.cages.size() % 3);
        cage.texturePoints = {{0.25F, 0.5F}, {1.0F, -2.0F}};
        cage.faceTexturePoints.assign(cage.faceVertices.size(), 1);
        Object object = scene.objects[0];
        object.mesh = cage.name;
        scene.objects.push_back(object);
        scene.cages.push_back(std::move(cage));
    }
    const Scene read = parseMscene(serializeMscene(scene), "file");
    ASSERT_EQ(read.cages.size(), scene.cages.size());
    for (std::size_t i = 0; i < read.cages.size(); ++i) {
        const Cage &a = read.cages[i], &b = scene.cages[i];
        expectSame(a, b);
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.points, b.points);
        EXPECT_EQ(a.faceVertices, b.faceVertices);
        EXPECT_EQ(a.texturePoints, b.texturePoints);
        EXPECT_EQ(a.faceTexturePoints, b.faceTexturePoints);
        EXPECT_EQ(read.objects[scene.objects.size() - 4 + i].mesh, b.name);
    }
    scene.cages[1].points[3].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(contains(complaint(serializeMscene(scene)), "cage 'loop', point 3"));
    scene.cages[1] = scene.cages[0];
    EXPECT_TRUE(contains(complaint(serializeMscene(scene)), "cage 'catmull-clark': the name is used twice"));
}

TEST(CageFiles, DamagedMsceneCagesAreErrorsOrScenes) {
    Scene scene;
    scene.cages.push_back(sampleCage());
    scene.cages[0].texturePoints = {{0.25F, 0.5F}, {1.0F, -2.0F}};
    scene.cages[0].scheme = SubdivisionScheme::loop;
    const Bytes whole = serializeMscene(scene);
    std::string said;
    for (std::size_t at = 0; at < whole.size(); ++at) {
        EXPECT_NE(complaint(std::span(whole).first(at)), "") << at;
        for (unsigned value = 0; value < 256; value += 4) {
            Bytes bytes = whole;
            bytes[at] = std::byte(value);
            const std::string message = complaint(bytes);
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            said += message + "\n";
        }
    }
    for (const std::string part : {"cage 'box': unknown scheme", "cage 'box': unknown boundary rule", "numbers are no multiple of the 3",
                                   "cage 'box', texture: 3 numbers are no multiple of the 2", "cage 'box', crease of vertices 0 and 1"}) {
        EXPECT_TRUE(contains(said, part)) << part;
    }
}

}  // namespace
}  // namespace tessera
